#pragma once
// What the program sees of the module lamina_text.so.
//
// FreeType, HarfBuzz and Fontconfig take 15 shared libraries and 10 ms to
// load, and few designs have text. So they stand behind a module that is opened
// on first use. It offers one C function, which makes an Engine. Nothing is
// thrown across: what fails says so by its result.

#include <cstdint>
#include <span>
#include <string>

#include "csg/tree.h"
#include "csg/vec.h"
#include "parser/diagnostic.h"

namespace lamina::text {

struct Message {
  Severity severity;
  std::string words;
};

// A text as polygons: inside is where they wind other than 0 times.
struct Typeset {
  std::span<const Vec2> points;         // of all polygons, one after another
  std::span<const std::uint32_t> ends;  // of each polygon in `points`
  std::span<const Message> messages;
};

class Engine {
 public:
  virtual ~Engine() = default;

  // Lets texts use the font in the file `path`. False if it holds none.
  virtual bool add_font(const char* path) noexcept = 0;

  // segments  into which a curve is cut
  // returns   what stays valid until the next call; null: out of memory
  virtual const Typeset* set(const csg::TextParams& params,
                             int segments) noexcept = 0;
};

// Changes whenever something above does.
constexpr int kEngineVersion = 1;

// The module's function: a new engine; null if it has another version or there
// is no memory.
using MakeEngine = Engine*(int version);
constexpr const char* kMakeEngineName = "lamina_make_text_engine";

}  // namespace lamina::text
