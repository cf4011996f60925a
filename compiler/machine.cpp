#include "compiler/machine.h"

#include <string>

namespace lamina::compiler {
namespace {

using slicer::OutputFormat;

std::string usual_printer(OutputFormat format) {
  if (!slicer::is_of_images(format)) return {};
  if (format == OutputFormat::kSl1) return "prusa-sl1";
  return format == OutputFormat::kNanoDlp ? "wanhao-d7" : "plain";
}

}  // namespace

Machine choose_machine(const OutputRequest& request, const FileAccess& access) {
  Machine machine;
  const std::string name =
      request.printer.empty() ? usual_printer(request.format) : request.printer;
  if (!name.empty()) {
    slicer::Printer& printer =
        machine.printer.emplace(slicer::find_printer(name, access));
    if (request.mirrors_x) printer.right = -printer.right;
    if (request.mirrors_y) printer.up = -printer.up;
  }
  if (!request.material.empty()) {
    machine.material = slicer::find_material(request.material, access);
  }
  return machine;
}

}  // namespace lamina::compiler
