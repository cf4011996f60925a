#include "csg/text/typesetter.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <utility>

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "csg/text/detail/engine.h"

namespace lamina::text {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(Diagnostics& diagnostics, const std::string& words) {
  diagnostics.error({}, words);
  throw GeometryError({Severity::kError, {}, words});
}

// The module stays open to the end: the libraries below it keep state of
// their own that outlives their callers.
MakeEngine* open_module(const std::vector<std::string>& folders,
                        Diagnostics& diagnostics) {
  for (const std::string& folder : folders) {
    const std::string path = folder + "/" + kModuleName;
    std::error_code error;
    if (!fs::exists(path, error)) continue;
    void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    void* symbol = module ? dlsym(module, kMakeEngineName) : nullptr;
    if (!symbol) {
      fail(diagnostics,
           fmt::format("Can't open the module for text(): {}", dlerror()));
    }
    return reinterpret_cast<MakeEngine*>(symbol);
  }
  fail(diagnostics, fmt::format("Can't find the module for text(), {}, in {}",
                                kModuleName, fmt::join(folders, " or ")));
}

class PermittedFonts : public FontFiles {
 public:
  explicit PermittedFonts(const FileAccess& access) : file_access_(access) {}

  std::vector<std::string> files_in(const std::string& folder) const override {
    std::vector<std::string> files;
    for (const std::string& part : file_access_.readable_parts(folder)) {
      collect(part, 0, files);
    }
    return files;
  }

  int open(const std::string& path) const override {
    return file_access_.open(path).release();
  }

 private:
  void collect(const std::string& folder, int depth,
               std::vector<std::string>& files) const {
    // Links can lead in a circle.
    constexpr int kDeepest = 8;
    if (depth > kDeepest) return;
    auto names = file_access_.list(folder);
    if (!names) return;
    std::sort(names->begin(), names->end());
    for (const std::string& name : *names) {
      const std::string path = fmt::format("{}/{}", folder, name);
      if (file_access_.is_regular_file(path)) {
        files.push_back(path);
      } else {
        collect(path, depth + 1, files);
      }
    }
  }

  const FileAccess& file_access_;
};

const Typeset& checked(const Typeset* typeset,
                       std::vector<std::string>& warnings) {
  if (!typeset) throw std::bad_alloc();
  for (const Message& message : typeset->messages) {
    warnings.push_back(message.words);
  }
  return *typeset;
}

}  // namespace

std::vector<std::string> module_folders() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const fs::path folder = program.parent_path();
  return {folder.string(), (folder.parent_path() / LAMINA_MODULES).string()};
}

Typesetter::Typesetter(std::vector<std::string> folders,
                       Diagnostics& diagnostics, const FileAccess& access)
    : folders_(std::move(folders)), diagnostics_(diagnostics) {
  if (access.is_confined()) {
    permitted_fonts_ = std::make_unique<PermittedFonts>(access);
  }
}

Typesetter::~Typesetter() = default;

void Typesetter::add_fonts(const std::vector<std::string>& files) {
  font_files_.insert(font_files_.end(), files.begin(), files.end());
}

Engine& Typesetter::engine() {
  if (engine_) return *engine_;
  engine_.reset(open_module(folders_, diagnostics_)(kEngineVersion,
                                                    permitted_fonts_.get()));
  if (!engine_) {
    fail(diagnostics_, fmt::format("{} is of another version", kModuleName));
  }
  for (const std::string& file : font_files_) {
    if (!engine_->add_font(file.c_str())) {
      diagnostics_.report({Severity::kPlain,
                           {},
                           fmt::format("Can't register font '{}'", file)});
    }
  }
  return *engine_;
}

std::vector<std::vector<Vec2>> Typesetter::outline(
    const csg::TextParams& params, const Chords& chords, SourceRange range,
    Diagnostics& diagnostics) {
  const Typeset* typeset = engine().set(params, chords);
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

std::optional<csg::TextMetrics> Typesetter::measure_text(
    const csg::TextParams& params, std::vector<std::string>& warnings) {
  const Typeset& typeset = checked(engine().measure_text(params), warnings);
  if (!typeset.has_font) return std::nullopt;
  return typeset.text_metrics;
}

std::optional<csg::FontMetrics> Typesetter::measure_font(
    const csg::TextParams& params, std::vector<std::string>& warnings) {
  const Typeset& typeset = checked(engine().measure_font(params), warnings);
  if (!typeset.has_font) return std::nullopt;
  return typeset.font_metrics;
}

}  // namespace lamina::text
