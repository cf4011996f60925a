#include "tests/oracle/conformance/reference.h"

#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <unistd.h>

#include "tests/oracle/openscad.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::oracle {
namespace {

namespace fs = std::filesystem;

std::string openscad_version() {
  const auto result = support::run_process({"openscad", "--version"});
  if (result.status != 0) throw std::runtime_error("openscad is missing");
  return result.errors;
}

// Names what openscad would render: the program and the design's file.
std::string key_of(const fs::path& design) {
  const std::string identity = fmt::format(
      "{}{}{}{}", openscad_version(), design.string(), fs::file_size(design),
      fs::last_write_time(design).time_since_epoch().count());
  return fmt::format("{}-{:016x}", design.stem().string(),
                     std::hash<std::string>()(identity));
}

// The tree `root` as links in the cache, so that files can be put beside those
// of a tree that is not ours.
fs::path linked_tree(const fs::path& root) {
  const fs::path tree = reference_cache() / "tree" / root.filename();
  if (fs::exists(tree)) return tree;
  const fs::path beside =
      reference_cache() / fmt::format("tree.{}.tmp", ::getpid());
  fs::create_directories(beside);
  fs::create_directories(tree.parent_path());
  const auto result = support::run_process(
      {"cp", "-rs", root.string(), (beside / root.filename()).string()});
  if (result.status != 0) throw std::runtime_error(result.errors);
  std::error_code another_was_first;
  fs::rename(beside / root.filename(), tree, another_was_first);
  fs::remove_all(beside);
  return tree;
}

// A design beside `design` that extrudes its outline: the whole text as a
// module, but for its `use` lines, which may stand outside only.
fs::path write_extruder(const fs::path& root, const fs::path& design) {
  const fs::path folder =
      (linked_tree(root) / design.lexically_relative(root)).parent_path();
  fs::path path = folder / fmt::format("{}.extruded.{}.scad",
                                       design.stem().string(), ::getpid());
  std::string uses;
  std::string body;
  std::istringstream lines(support::read_file(design.string()));
  for (std::string line; std::getline(lines, line);) {
    (line.starts_with("use <") ? uses : body) += line + '\n';
  }
  std::ofstream(path) << fmt::format(
      "{}module whole() {{\n{}\n}}\nlinear_extrude(height = 1) whole();\n",
      uses, body);
  return path;
}

struct Rendered {
  int status = 0;
  std::string words;
};

Rendered run_openscad(const fs::path& design, const fs::path& stl) {
  const auto result = support::run_process(
      {"sh", "-c",
       fmt::format("ulimit -t {}; exec openscad --export-format binstl -o '{}' "
                   "'{}'",
                   kRenderSeconds, stl.string(), design.string())});
  return {result.status, result.errors};
}

bool contains(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

ReferenceKind kind_of(const Rendered& rendered) {
  constexpr int kKilled = 128;
  if (rendered.status == 0) return ReferenceKind::kSolid;
  if (contains(rendered.words, "object is not a 3D object")) {
    return ReferenceKind::kOutline;
  }
  if (contains(rendered.words, "object is empty")) return ReferenceKind::kEmpty;
  return rendered.status > kKilled ? ReferenceKind::kTooSlow
                                   : ReferenceKind::kFailed;
}

// Renders to `stl`; the kind and openscad's words stand in `note`.
void render(const fs::path& root, const fs::path& design, const fs::path& stl,
            const fs::path& note) {
  const fs::path beside = stl.string() + fmt::format(".{}.tmp", ::getpid());
  Rendered rendered = run_openscad(design, beside);
  ReferenceKind kind = kind_of(rendered);
  if (kind == ReferenceKind::kOutline) {
    const fs::path extruder = write_extruder(root, design);
    rendered = run_openscad(extruder, beside);
    fs::remove(extruder);
    const ReferenceKind extruded = kind_of(rendered);
    if (extruded != ReferenceKind::kSolid) kind = extruded;
  }
  if (fs::exists(beside)) fs::rename(beside, stl);
  const fs::path note_beside = beside.string() + ".note";
  std::ofstream(note_beside) << static_cast<int>(kind) << '\n'
                             << rendered.words;
  fs::rename(note_beside, note);
}

}  // namespace

fs::path reference_cache() {
  if (const char* own = std::getenv("LAMINA_TEST_CACHE")) return own;
  if (const char* user = std::getenv("XDG_CACHE_HOME")) {
    return fs::path(user) / "lamina-tests";
  }
  if (const char* home = std::getenv("HOME")) {
    return fs::path(home) / ".cache" / "lamina-tests";
  }
  return fs::temp_directory_path() / "lamina-tests";
}

Reference render_reference(const fs::path& root, const fs::path& design) {
  fs::create_directories(reference_cache());
  const fs::path base = reference_cache() / key_of(design);
  const fs::path stl = base.string() + ".stl";
  const fs::path note = base.string() + ".note";
  if (!fs::exists(note)) render(root, design, stl, note);

  Reference reference;
  std::ifstream file(note);
  int kind = 0;
  file >> kind;
  reference.kind = static_cast<ReferenceKind>(kind);
  reference.words = {std::istreambuf_iterator<char>(file), {}};
  if (reference.kind == ReferenceKind::kSolid ||
      reference.kind == ReferenceKind::kOutline) {
    reference.mesh = read_binary_stl(stl);
    // Of degenerate faces alone, openscad writes none.
    if (reference.mesh.triangles.empty()) {
      reference.kind = ReferenceKind::kEmpty;
    }
  }
  return reference;
}

}  // namespace lamina::oracle
