#include "compiler/request.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/text.h"
#include "csg/import/mesh_file.h"
#include "slicer/formats/output_format.h"

namespace lamina::compiler {
namespace {

std::string import_statement(const std::string& path, const std::string& part) {
  const std::string of = part.empty() ? "" : ", part = " + in_quotes(part);
  return "import(" + in_quotes(path) + of + ");\n";
}

}  // namespace

Request as_drawn(Request request) {
  GeometryRequest geometry;
  geometry.chordal_error = request.geometry.chordal_error;
  geometry.decimation = request.geometry.decimation;
  request.geometry = geometry;
  request.hollow.reset();
  request.supports.reset();
  request.compensation = {0, slicer::Foot(), 0};
  return request;
}

bool is_design(const std::string& path) {
  return slicer::is_named(path, ".scad") || slicer::is_named(path, ".csg");
}

bool is_imported(const std::string& path) {
  constexpr std::array<std::string_view, 14> kExtensions = {
      ".stl",   ".off",  ".obj", ".ply",  ".amf", ".3mf",  ".dxf",
      ".fcstd", ".step", ".stp", ".iges", ".igs", ".brep", ".brp"};
  return std::any_of(kExtensions.begin(), kExtensions.end(),
                     [&](std::string_view extension) {
                       return slicer::is_named(path, extension);
                     });
}

bool has_parts(const std::string& path) {
  return csg::has_parts(csg::import_format_of_file(path));
}

std::string import_of(const std::string& path, const std::string& part) {
  return import_statement(std::filesystem::path(path).filename().string(),
                          part);
}

std::string design_that_takes(const DesignRequest& design,
                              const std::string& folder) {
  const std::string path = relative_path(design.path, folder);
  if (is_imported(design.path)) return import_statement(path, design.part);
  return fmt::format("include <{}>\n{}", path, design.definitions);
}

}  // namespace lamina::compiler
