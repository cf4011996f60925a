#include "csg/text/typesetter.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <new>
#include <sstream>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "csg/text/detail/engine.h"

namespace lamina::text {
namespace {

// What the module measured; nothing where it found no font.
template <typename Metrics>
std::optional<Metrics> measured(const Typeset& typeset,
                                Metrics Typeset::*metrics,
                                std::vector<std::string>& warnings) {
  for (const Message& message : typeset.messages) {
    warnings.push_back(message.words);
  }
  if (!typeset.has_font) return std::nullopt;
  return typeset.*metrics;
}

// What permits the fonts: the system's, and those of OPENSCAD_FONT_PATH, where
// the portable archive has its own.
std::string options_for_fonts() {
  std::string options = " --allow-read /usr/share/fonts";
  if (const char* more = std::getenv("OPENSCAD_FONT_PATH")) {
    std::istringstream list(more);
    for (std::string folder; std::getline(list, folder, ':');) {
      options += " --allow-read " + folder;
    }
  }
  return options;
}

}  // namespace

class ReadableFonts : public FontFiles {
 public:
  explicit ReadableFonts(const FileAccess& access) : file_access_(access) {}

  bool is_confined() const noexcept override {
    return file_access_.is_confined();
  }

  std::vector<std::string> files_in(
      const std::string& folder) const noexcept override {
    return keep_fault([&] {
      std::vector<std::string> files;
      for (const std::string& part : file_access_.readable_parts(folder)) {
        collect(part, 0, files);
      }
      return files;
    });
  }

  std::string read(const std::string& path) const noexcept override {
    return keep_fault([&] {
      const OpenFile file = file_access_.open(path);
      auto bytes = file ? file.read_all() : std::nullopt;
      if (!bytes) check_machine(path, errno);
      files_read_.push_back(path);
      return bytes.value_or("");
    });
  }

  const std::vector<std::string>& files_read() const { return files_read_; }

  // Throws what was thrown while the module called.
  void rethrow_fault() const {
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  template <typename Work>
  auto keep_fault(const Work& work) const noexcept -> decltype(work()) {
    try {
      return work();
    } catch (...) {
      fault_ = std::current_exception();
      return {};
    }
  }

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
  mutable std::exception_ptr fault_;
  mutable std::vector<std::string> files_read_;
};

Typesetter::Typesetter(std::vector<std::string> folders,
                       Diagnostics& diagnostics, const FileAccess& access)
    : folders_(std::move(folders)),
      diagnostics_(diagnostics),
      readable_fonts_(std::make_unique<const ReadableFonts>(access)) {}

Typesetter::~Typesetter() = default;

void Typesetter::add_fonts(const std::vector<std::string>& files) {
  font_files_.insert(font_files_.end(), files.begin(), files.end());
}

const std::vector<std::string>& Typesetter::files_read() const {
  return readable_fonts_->files_read();
}

Engine& Typesetter::engine() {
  if (engine_) return *engine_;
  auto* const make_engine = reinterpret_cast<MakeEngine*>(
      open_module(kModule, folders_, diagnostics_));
  engine_.reset(make_engine(kEngineVersion, readable_fonts_.get()));
  const int error = errno;
  readable_fonts_->rethrow_fault();
  if (!engine_) fail_without_engine(kModule, error, diagnostics_);
  for (const std::string& file : font_files_) {
    const AddedFont added = engine_->add_font(file.c_str());
    readable_fonts_->rethrow_fault();
    if (added == AddedFont::kNoMemory) throw std::bad_alloc();
    if (added == AddedFont::kNone) {
      diagnostics_.report({Severity::kPlain,
                           {},
                           fmt::format("Can't register font '{}'", file)});
    }
  }
  return *engine_;
}

// What the module returned, where nothing failed meanwhile.
const Typeset& Typesetter::checked(const Typeset* typeset) const {
  readable_fonts_->rethrow_fault();
  if (typeset == nullptr) throw std::bad_alloc();
  return *typeset;
}

std::vector<std::vector<Vec2>> Typesetter::outline(
    const csg::TextParams& params, const Chords& chords, SourceRange range,
    Diagnostics& diagnostics) {
  const Typeset& typeset = checked(engine().set(params, chords));
  for (const Message& message : typeset.messages) {
    Diagnostic said{message.severity, range, message.words};
    said.audience = message.audience;
    if (!typeset.has_font && readable_fonts_->is_confined()) {
      said.hints = hint_of("the system's fonts may not be read: try" +
                           options_for_fonts());
    }
    diagnostics.report(std::move(said));
  }
  std::vector<std::vector<Vec2>> contours;
  std::size_t begin = 0;
  for (const std::size_t end : typeset.ends) {
    const auto points = typeset.points.subspan(begin, end - begin);
    contours.emplace_back(points.begin(), points.end());
    begin = end;
  }
  return contours;
}

std::optional<csg::TextMetrics> Typesetter::measure_text(
    const csg::TextParams& params, std::vector<std::string>& warnings) {
  return measured(checked(engine().measure_text(params)),
                  &Typeset::text_metrics, warnings);
}

std::optional<csg::FontMetrics> Typesetter::measure_font(
    const csg::TextParams& params, std::vector<std::string>& warnings) {
  return measured(checked(engine().measure_font(params)),
                  &Typeset::font_metrics, warnings);
}

}  // namespace lamina::text
