#include "compiler/machine.h"

#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include "slicer/plan/orientation.h"

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

std::string usual_printer(OutputFormat format) {
  if (!slicer::is_of_images(format)) return {};
  if (format == OutputFormat::kSl1) return "prusa-sl1";
  if (format == OutputFormat::kGoo) return "elegoo-mars-4";
  if (format == OutputFormat::kCtb) return "elegoo-saturn";
  return format == OutputFormat::kNanoDlp ? "wanhao-d7" : "plain";
}

// Formats that printers of one kind read, and no programs that convert.
bool is_for_printers(OutputFormat format) {
  return format == OutputFormat::kGoo || format == OutputFormat::kCtb;
}

// The metal of --metal.
slicer::Material find_metal(const std::string& name, const FileAccess& access) {
  slicer::Material metal = slicer::find_material(name, access);
  if (metal.is_metal()) return metal;
  throw FileError(fmt::format("Can't use metal '{}': {} is not a metal", name,
                              metal.title));
}

// The options with which a part that is too large would fit; empty where none
// help.
std::string options_that_fit(const slicer::Printer& printer,
                             const GeometryRequest& geometry, Vec3 size) {
  // A box that is turned by other angles is not the part's.
  if (geometry.axis == kAutomaticAxis || geometry.up ||
      std::fmod(geometry.turn, 90) != 0) {
    return {};
  }
  const auto turned = [](std::string_view axis, double turn) {
    const Affine matrix = slicer::turn_to_axis(axis, turn);
    return glm::dmat3(glm::abs(matrix[0]), glm::abs(matrix[1]),
                      glm::abs(matrix[2]));
  };
  const Vec3 design =
      glm::transpose(turned(geometry.axis, geometry.turn)) * size;
  for (const std::string_view axis :
       {std::string_view(geometry.axis), slicer::kAxes[0], slicer::kAxes[1],
        slicer::kAxes[2]}) {
    for (const double turn : {0.0, 90.0}) {
      if (!slicer::fits(printer, turned(axis, turn) * design)) continue;
      return fmt::format("--axis {}{}", axis, turn != 0 ? " --turn 90" : "");
    }
  }
  return {};
}

}  // namespace

bool is_price_of_metal(const slicer::Price& price, bool has_material,
                       bool has_metal) {
  return has_metal &&
         (!has_material || price.unit == "g" || price.unit == "oz");
}

std::string too_large_text(const slicer::Printer& printer,
                           const GeometryRequest& geometry, Vec3 size) {
  const std::string options = options_that_fit(printer, geometry, size);
  return options.empty()
             ? slicer::TooLarge(printer, size).what()
             : fmt::format("{}; with {} it fits",
                           slicer::too_large_text(printer, size), options);
}

Machine choose_machine(const OutputRequest& request, const FileAccess& access) {
  Machine machine;
  const std::string name =
      request.printer.empty() ? usual_printer(request.format) : request.printer;
  if (!name.empty()) {
    slicer::Printer& printer =
        machine.printer.emplace(slicer::find_printer(name, access));
    const std::string complaint =
        slicer::complaint_of_printer(printer.title, printer.reads);
    if (!complaint.empty() && is_for_printers(request.format)) {
      throw FileError(complaint);
    }
    if (!printer.has_panel() && slicer::is_of_images(request.format)) {
      throw FileError(
          fmt::format("{} has no panel to show images on", printer.title));
    }
    if (request.mirrors_x) printer.right = -printer.right;
    if (request.mirrors_y) printer.up = -printer.up;
  }
  if (!request.material.empty()) {
    slicer::Material material = slicer::find_material(request.material, access);
    (material.is_metal() ? machine.metal : machine.material) =
        std::move(material);
  }
  if (!request.metal.empty()) {
    if (machine.metal) {
      throw FileError(fmt::format("'{}' and '{}' are both metals",
                                  request.material, request.metal));
    }
    machine.metal = find_metal(request.metal, access);
  }
  for (const slicer::Price& price : request.prices) {
    const bool is_metals = is_price_of_metal(
        price, machine.material.has_value(), machine.metal.has_value());
    (is_metals ? machine.metal : machine.material)->price = price;
  }
  return machine;
}

}  // namespace lamina::compiler
