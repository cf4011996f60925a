// lamina printers and lamina materials: what the program knows of them.

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kPrintersHelp =
    R"(Usage: lamina printers

Lists the resin printers that lamina knows: the names for --printer, what they
build, the pixels of their panels, the seconds that a layer takes besides its
exposure, the format that they read, and the source of these figures. --printer
takes a profile of your own as well (see docs/formats.md).

  -h, --help  print this help
)";

constexpr std::string_view kMaterialsHelp =
    R"(Usage: lamina materials

Lists the resins and metals that lamina knows: the names for --material, their
density, of resins the exposure of a layer and of the first one, and the source of
these figures. --material takes a profile of your own as well, with the price
that you pay (see docs/formats.md).

  -h, --help  print this help
)";

std::string known(double value, const std::string& text) {
  return value > 0 && std::isfinite(value) ? text : "-";
}

class PrintersCommand : public Command {
 public:
  std::string_view help() const override { return kPrintersHelp; }
  void add_options(OptionList& /*options*/) override {}
  int run(const Context& /*context*/) override {
    std::string text = fmt::format(
        "{:<26} {:>26} {:>13} {:>15} {:>7}  {:<13} {}\n", "printer",
        "builds mm", "pixels", "of mm", "move s", "reads", "source");
    for (const slicer::Printer& printer : slicer::known_printers()) {
      const Vec3 volume = printer.build_volume();
      text += fmt::format(
          "{:<26} {:>26} {:>13} {:>15} {:>7}  {:<13} {}\n", printer.name,
          fmt::format("{:.5g} x {:.5g} x {}", volume.x, volume.y,
                      known(volume.z, fmt::format("{:g}", volume.z))),
          fmt::format("{} x {}", printer.width, printer.height),
          printer.pixel.x == printer.pixel.y
              ? fmt::format("{:g}", printer.pixel.x)
              : fmt::format("{:g} x {:g}", printer.pixel.x, printer.pixel.y),
          known(printer.move_seconds,
                fmt::format("{:g}", printer.move_seconds)),
          printer.reads.empty() ? "-" : "." + printer.reads.front(),
          printer.source);
    }
    print_out(text);
    return kDone;
  }
};

class MaterialsCommand : public Command {
 public:
  std::string_view help() const override { return kMaterialsHelp; }
  void add_options(OptionList& /*options*/) override {}
  int run(const Context& /*context*/) override {
    std::string text =
        fmt::format("{:<30} {:>7} {:>11} {:>8}  {:<12} {}\n", "material",
                    "g/cm³", "exposure s", "first s", "for", "source");
    for (const slicer::Material& material : slicer::known_materials()) {
      text += fmt::format(
          "{:<30} {:>7} {:>11} {:>8}  {:<12} {}\n", material.name,
          material.density,
          known(material.exposure, fmt::format("{:g}", material.exposure)),
          known(material.first_exposure,
                fmt::format("{:g}", material.first_exposure)),
          material.printer.empty() ? "-" : material.printer, material.source);
    }
    print_out(text);
    return kDone;
  }
};

}  // namespace

std::unique_ptr<Command> make_printers_command() {
  return std::make_unique<PrintersCommand>();
}

std::unique_ptr<Command> make_materials_command() {
  return std::make_unique<MaterialsCommand>();
}

}  // namespace lamina::cli
