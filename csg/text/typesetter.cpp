#include "csg/text/typesetter.h"

#include <filesystem>
#include <new>
#include <utility>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "csg/text/detail/engine.h"

namespace lamina::text {
namespace {

namespace fs = std::filesystem;

constexpr const char* kModule = "lamina_text.so";

[[noreturn]] void fail(SourceRange range, std::string words) {
  throw GeometryError({Severity::kError, range, std::move(words)});
}

// The module stays open to the end: the libraries below it keep state of
// their own that outlives their callers.
MakeEngine* open_module(const std::vector<std::string>& folders,
                        SourceRange range) {
  for (const std::string& folder : folders) {
    const std::string path = folder + "/" + kModule;
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = module ? dlsym(module, kMakeEngineName) : nullptr;
    if (!symbol) {
      fail(range,
           fmt::format("Can't open the module for text(): {}", dlerror()));
    }
    return reinterpret_cast<MakeEngine*>(symbol);
  }
  fail(range, fmt::format("Can't find the module for text(), {}, in {}",
                          kModule, fmt::join(folders, " or ")));
}

}  // namespace

std::vector<std::string> module_folders() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const fs::path folder = program.parent_path();
  return {folder.string(), (folder.parent_path() / "lib/lamina").string()};
}

Typesetter::Typesetter(std::vector<std::string> folders)
    : folders_(std::move(folders)) {}

Typesetter::~Typesetter() = default;

void Typesetter::add_fonts(const std::vector<std::string>& files) {
  font_files_.insert(font_files_.end(), files.begin(), files.end());
}

void Typesetter::open_engine(SourceRange range, Diagnostics& diagnostics) {
  engine_.reset(open_module(folders_, range)(kEngineVersion));
  if (!engine_) {
    fail(range, fmt::format("{} is of another version of lamina", kModule));
  }
  for (const std::string& file : font_files_) {
    if (!engine_->add_font(file.c_str())) {
      diagnostics.report({Severity::kPlain,
                          {},
                          fmt::format("Can't register font '{}'", file)});
    }
  }
}

std::vector<std::vector<Vec2>> Typesetter::outline(
    const csg::TextParams& params, int segments, SourceRange range,
    Diagnostics& diagnostics) {
  if (!engine_) open_engine(range, diagnostics);
  const Typeset* typeset = engine_->set(params, segments);
  if (!typeset) throw std::bad_alloc();
  for (const Message& message : typeset->messages) {
    diagnostics.report({message.severity, range, message.words});
  }
  std::vector<std::vector<Vec2>> contours;
  std::size_t begin = 0;
  for (const std::size_t end : typeset->ends) {
    const auto points = typeset->points.subspan(begin, end - begin);
    contours.emplace_back(points.begin(), points.end());
    begin = end;
  }
  return contours;
}

}  // namespace lamina::text
