#include "compiler/machine.h"

#include <string>

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

}  // namespace

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
    if (request.mirrors_x) printer.right = -printer.right;
    if (request.mirrors_y) printer.up = -printer.up;
  }
  if (!request.material.empty()) {
    machine.material = slicer::find_material(request.material, access);
  }
  return machine;
}

}  // namespace lamina::compiler
