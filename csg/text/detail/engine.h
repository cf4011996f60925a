#pragma once
// What the program sees of the module lamina_text.so.
//
// FreeType, HarfBuzz and Fontconfig come with eight more shared libraries, and
// few designs have text. So they stand behind a module (base/file/module.h).

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/vec.h"
#include "csg/text/typesetter.h"
#include "csg/text_measurer.h"
#include "csg/tree.h"

namespace lamina::text {

struct Message {
  Severity severity;
  std::string words;
  Audience audience = Audience::kAll;
};

// What a text gave: its polygons, or its measures.
struct Typeset {
  bool has_font = false;
  std::span<const Message> messages;
  // The points of all polygons, one polygon after another, and where each ends.
  // Inside is where they wind other than 0 times.
  std::span<const Vec2> points;
  std::span<const std::uint32_t> ends;
  csg::TextMetrics text_metrics;
  csg::FontMetrics font_metrics;
};

// The way to the files of fonts. It keeps a failure, and throws it once the
// module has returned.
class FontFiles {
 public:
  virtual ~FontFiles() = default;

  // Whether only some may be read (`--root`).
  virtual bool is_confined() const noexcept = 0;
  // The files in a folder and below it that may be read.
  virtual std::vector<std::string> files_in(
      const std::string& folder) const noexcept = 0;
  // All bytes; none where the file may not or cannot be read.
  virtual std::string read(const std::string& path) const noexcept = 0;
};

// What add_font() came to.
enum class AddedFont { kAdded, kNone, kNoMemory };

class Engine {
 public:
  virtual ~Engine() = default;

  // Lets texts use the font in the file `path`; kNone if it holds none.
  virtual AddedFont add_font(const char* path) noexcept = 0;

  // What these return stays valid until the next call; null: out of memory.
  virtual const Typeset* set(const csg::TextParams& params,
                             const Chords& chords) noexcept = 0;
  virtual const Typeset* measure_text(
      const csg::TextParams& params) noexcept = 0;
  virtual const Typeset* measure_font(
      const csg::TextParams& params) noexcept = 0;
};

// Grows with every change above.
constexpr int kEngineVersion = 6;

// The module's function: a new engine; null if it has another version, or
// there is no memory (errno is ENOMEM then).
//
// files  outlives the engine
using MakeEngine = Engine*(int version, const FontFiles* files);

}  // namespace lamina::text
