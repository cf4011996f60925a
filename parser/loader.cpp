#include "parser/loader.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include <sys/stat.h>

#include "base/paths.h"
#include "base/similar.h"
#include "parser/parser.h"

namespace lamina {

namespace fs = std::filesystem;

namespace {

// Where Debian and most others install OpenSCAD's libraries.
constexpr const char* kInstalledLibraries = "/usr/share/openscad/libraries";

// Ranges are 32-bit offsets.
constexpr std::uintmax_t kLargestText =
    std::numeric_limits<std::uint32_t>::max() / 2;

// Where OpenSCAD finds no data folder of the user, its library folder is "",
// which stands for the folder in which it runs.
std::string user_folder(const FileAccess& access) {
  const char* home = std::getenv("HOME");
  const fs::path data =
      home == nullptr ? ""
                      : access.canonical(fs::path(home) / ".local" / "share");
  return data.empty() ? "" : (data / "OpenSCAD" / "libraries").string();
}

bool is_open(const std::string& path, std::span<const Source* const> open) {
  return std::any_of(open.begin(), open.end(), [&](const Source* source) {
    return source->path() == path;
  });
}

bool are_similar(std::string_view a, std::string_view b) {
  return a == b || !most_similar(b, std::array{a}).empty();
}

// A hint for a file that is not there: one beside it whose name and kind are
// similar, each by itself.
std::string similar_file(const std::string& path, const FileAccess& access) {
  using Names = std::vector<std::string>;
  const fs::path wanted(path);
  const std::string folder =
      wanted.has_parent_path() ? wanted.parent_path().string() : ".";
  Names names;
  const std::string stem = wanted.stem().string();
  const std::string extension = wanted.extension().string();
  for (const std::string& name : access.list(folder).value_or(Names())) {
    const fs::path file(name);
    if (are_similar(file.stem().string(), stem) &&
        are_similar(file.extension().string(), extension)) {
      names.push_back((wanted.parent_path() / name).string());
    }
  }
  std::sort(names.begin(), names.end());
  const std::vector<std::string_view> all(names.begin(), names.end());
  return did_you_mean(path, all);
}

}  // namespace

std::vector<std::string> library_folders(const FileAccess& access) {
  std::vector<std::string> folders;
  if (const char* paths = std::getenv("OPENSCADPATH")) {
    std::string_view rest = paths;
    while (true) {
      const std::size_t end = rest.find(':');
      folders.push_back(absolute_path(std::string(rest.substr(0, end))));
      if (end == std::string_view::npos) break;
      rest.remove_prefix(end + 1);
    }
  }
  folders.push_back(user_folder(access));
  folders.emplace_back(kInstalledLibraries);
  return folders;
}

Loader::Loader(SourceStore& sources, Diagnostics& diagnostics,
               std::vector<std::string> folders, std::string definitions,
               const FileAccess& access)
    : sources_(sources),
      diagnostics_(diagnostics),
      folders_(std::move(folders)),
      definitions_(std::move(definitions)),
      access_(access) {}

std::string Loader::find(SourceRange place, std::string_view name,
                         std::span<const Source* const> open) {
  std::string path = look_up(place, name, open);
  if (path.empty()) {
    add_missing(fs::path(folder_of(place.source->path())) / fs::path(name));
  } else {
    add_file(path);
  }
  return path;
}

// A file that includes itself is found nowhere, and is there.
void Loader::add_missing(const std::string& path) {
  if (access_.is_file(path)) return;
  if (std::ranges::find(missing_, path) != missing_.end()) return;
  missing_.push_back(path);
}

void Loader::add_file(const std::string& path) {
  if (std::find(files_.begin(), files_.end(), path) != files_.end()) return;
  files_.push_back(path);
  access_.note_input(path);
}

std::string Loader::look_up(SourceRange place, std::string_view name,
                            std::span<const Source* const> open) const {
  const fs::path local(name);
  const FileUse use = is_font(name) ? FileUse::kData : FileUse::kCode;
  const auto accept = [&](const std::string& path) {
    return access_.is_file(path) && !is_open(path, open);
  };
  if (local.is_absolute()) {
    access_.require(local, name, place, use);
    return accept(local) ? access_.canonical(local) : "";
  }
  std::string beside = fs::path(folder_of(place.source->path())) / local;
  access_.require(beside, name, place, use);
  if (access_.is_file(beside)) beside = access_.canonical(beside);
  if (accept(beside)) return beside;
  // Pass over library folders that may not be read.
  for (const std::string& folder : folders_) {
    const fs::path path = fs::path(folder) / local;
    if (!access_.is_file(path)) continue;
    return path.has_parent_path() && accept(path) ? path.string() : "";
  }
  return "";
}

std::optional<std::string> Loader::read(const std::string& path) const {
  const OpenFile file = access_.open(path);
  if (!file) return std::nullopt;
  struct stat status {};
  if (::fstat(file.descriptor(), &status) == 0 &&
      static_cast<std::uintmax_t>(status.st_size) > kLargestText) {
    return std::nullopt;
  }
  auto text = file.read_all(kEndOfFile.size() + definitions_.size());
  if (!text) check_machine(path, errno);
  return text;
}

std::optional<std::string> Loader::read_design(const std::string& path) const {
  const std::string file = path == "-" ? "/dev/stdin" : path;
  if (access_.is_regular_file(file)) return read(file);
  auto text = access_.read(file);
  if (text && text->size() > kLargestText) return std::nullopt;
  return text;
}

const Source* Loader::open_include(const std::string& path) {
  const auto known = included_.find(path);
  if (known != included_.end()) return known->second;
  std::optional<std::string> text = read(path);
  if (!text) return nullptr;
  const Source& source = sources_.add(path, std::move(*text));
  included_.emplace(path, &source);
  return &source;
}

ast::Program Loader::load(const std::string& path) {
  access_.require(path);
  errno = 0;
  std::optional<std::string> text = read_design(path);
  if (!text) {
    Diagnostic missing{
        Severity::kError, {}, "Can't open input file '" + path + "'!"};
    if (errno != 0) missing.hints = hint_of(std::strerror(errno));
    const std::string similar = similar_file(path, access_);
    if (!similar.empty()) missing.hints.push_back({{}, similar});
    throw FileError(std::move(missing));
  }
  add_file(path);
  return load_text(path, std::move(*text));
}

// Parses the text of a file with what `-D` appends.
ast::Program Loader::parse_file(const std::string& path, std::string text,
                                const Source* user, bool is_implied) {
  text += kEndOfFile;
  text += definitions_;
  const Source& source = sources_.add(path, std::move(text), is_implied);
  ast::Program program = parse(source, user, *this, diagnostics_);
  if (!newer_) newer_ = program.newer;
  return program;
}

ast::Program Loader::load_text(const std::string& path, std::string text,
                               bool is_implied) {
  text += appended_;
  ast::Program program = parse_file(path, std::move(text), nullptr, is_implied);
  load_uses(program);
  return program;
}

void Loader::load_uses(const ast::Program& program) {
  for (const ast::Use& font : program.fonts) {
    if (access_.is_file(std::string(font.file))) {
      fonts_.emplace_back(font.file);
    }
  }
  for (const ast::Use& use : program.uses) {
    const std::string path(use.file);
    if (!use.is_found || used_.contains(path)) continue;
    // Enter it before it is read, so that files which use each other do not
    // repeat.
    std::optional<ast::Program>& used = used_[path];
    used = load_used(path, *program.source);
    if (used) load_uses(*used);
  }
}

std::optional<ast::Program> Loader::load_used(const std::string& path,
                                              const Source& user) {
  std::optional<std::string> text = read(path);
  if (!text) {
    diagnostics_.warning({}, "Can't open library file '" + path + "'\n");
    return std::nullopt;
  }
  try {
    return parse_file(path, std::move(*text), &user);
  } catch (const SyntaxError&) {
    return std::nullopt;  // reported already; the names stay unknown
  }
}

std::vector<const ast::Program*> Loader::with_used(
    const ast::Program& program) const {
  std::vector<const ast::Program*> all;
  const auto add = [&](const auto& self, const ast::Program& one) -> void {
    if (std::find(all.begin(), all.end(), &one) != all.end()) return;
    all.push_back(&one);
    for (const ast::Use& use : one.uses) {
      if (const ast::Program* used = used_program(use)) self(self, *used);
    }
  };
  add(add, program);
  return all;
}

const ast::Program* Loader::used_program(const ast::Use& use) const {
  const auto found = used_.find(use.file);
  if (found == used_.end() || !found->second) return nullptr;
  return &*found->second;
}

}  // namespace lamina
