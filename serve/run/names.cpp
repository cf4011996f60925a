#include "serve/run/names.h"

#include <algorithm>

#include <fmt/format.h>

#include "slicer/formats/output_format.h"
#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"

namespace lamina::serve {
namespace {

// Puts a name in front of a list that does not have it.
void add_name(std::vector<std::string>& names, const std::string& name) {
  if (name.empty() || std::ranges::find(names, name) != names.end()) return;
  names.insert(names.begin(), name);
}

}  // namespace

const std::string& Names::own_name(const std::string& name) const {
  const auto found = own_names.find(name);
  return found == own_names.end() ? name : found->second;
}

Names known_names(const compiler::Request& request,
                  std::vector<std::string> designs) {
  Names names;
  names.designs = std::move(designs);
  for (const slicer::Printer& printer : slicer::known_printers()) {
    names.printers.push_back(printer.name);
  }
  for (const slicer::Material& material : slicer::known_materials()) {
    (material.is_metal() ? names.metals : names.materials)
        .push_back(material.name);
    for (const std::string& other : material.also) {
      names.own_names.emplace(other, material.name);
    }
  }
  add_name(names.printers, request.output.printer);
  add_name(names.materials, request.output.material);
  add_name(names.metals, request.output.metal);
  // A folder is not one file.
  for (std::string& extension : slicer::written_extensions()) {
    if (extension != "png") names.formats.push_back(std::move(extension));
  }
  return names;
}

compiler::Request with_known_names(compiler::Request request,
                                   const FileAccess& access) {
  compiler::OutputRequest& output = request.output;
  const auto is_name = [&](const std::string& text) {
    return !text.empty() && !access.is_file(text);
  };
  if (is_name(output.printer)) {
    output.printer = slicer::find_printer(output.printer, access).name;
  }
  for (std::string* material : {&output.material, &output.metal}) {
    if (is_name(*material)) {
      *material = slicer::find_material(*material, access).name;
    }
  }
  return request;
}

void require_name(const std::vector<std::string>& names,
                  const std::string& name, const char* what) {
  if (name.empty() || std::ranges::find(names, name) != names.end()) return;
  throw NameError(fmt::format("there is no {} '{}'", what, name));
}

}  // namespace lamina::serve
