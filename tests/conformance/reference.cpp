#include "tests/conformance/reference.h"

#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "tests/oracle/openscad.h"
#include "tests/support/openscad_cache.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

using support::OpenScadResult;

// A design beside the link of `design` that extrudes its outline: the whole
// text as a module, but for its `use` lines, which may stand outside only.
fs::path write_extruder(const fs::path& root, const fs::path& design) {
  const fs::path link = link_of(root, design);
  fs::path path =
      link.parent_path() / (link.stem().string() + ".extruded.scad");
  std::string uses;
  std::string body;
  std::istringstream lines(support::read_file(design.string()));
  for (std::string line; std::getline(lines, line);) {
    (line.starts_with("use <") ? uses : body) += line + '\n';
  }
  // Others may read it meanwhile.
  const support::TemporaryFolder beside(support::cache_folder());
  fs::rename(beside.write("extruded.scad",
                          fmt::format("{}module whole() {{\n{}\n}}\n"
                                      "linear_extrude(height = 1) whole();\n",
                                      uses, body)),
             path);
  return path;
}

OpenScadResult render(const fs::path& design) {
  return support::ask_openscad(design, "stl", {"--export-format", "binstl"});
}

ReferenceKind kind_of(const OpenScadResult& rendered) {
  const auto says = [&](std::string_view words) {
    return rendered.words.find(words) != std::string::npos;
  };
  if (!rendered.output.empty()) return ReferenceKind::kSolid;
  if (says("object is not a 3D object")) return ReferenceKind::kOutline;
  if (says("object is empty")) return ReferenceKind::kEmpty;
  throw std::runtime_error("openscad fails: " + rendered.words);
}

}  // namespace

fs::path link_of(const fs::path& root, const fs::path& design) {
  const fs::path links = support::cache_folder() / "links";
  if (!fs::exists(links)) {
    const support::TemporaryFolder beside(support::cache_folder());
    const auto result = support::run_process(
        {"cp", "-rs", root.string(), beside.file("links")});
    if (result.status != 0) throw std::runtime_error(result.errors);
    std::error_code another_was_first;
    fs::rename(beside.file("links"), links, another_was_first);
  }
  return links / design.lexically_relative(root);
}

Reference render_reference(const fs::path& root, const fs::path& design) {
  OpenScadResult rendered = render(design);
  Reference reference;
  reference.kind = kind_of(rendered);
  if (reference.kind == ReferenceKind::kOutline) {
    rendered = render(write_extruder(root, design));
    if (rendered.output.empty()) reference.kind = kind_of(rendered);
  }
  if (!rendered.output.empty()) {
    reference.mesh = oracle::read_binary_stl(rendered.output);
    // Of degenerate faces alone, openscad writes none.
    if (reference.mesh.triangles.empty()) {
      reference.kind = ReferenceKind::kEmpty;
    }
  }
  reference.words = std::move(rendered.words);
  return reference;
}

}  // namespace lamina::conformance
