#pragma once
// What the program sees of the module lamina_cad.so (base/file/module.h).
//
// The engine works in a process of its own (base/child_process.h), which reads
// one file and ends.

#include <optional>
#include <string>
#include <string_view>

#include "csg/cad/cad_reader.h"

namespace lamina::cad {

enum class Outcome : std::uint8_t {
  kRead,
  kBroken,  // Result::reason says why
  kNoMemory,
  kTooManyTriangles,
};

struct Result {
  Outcome outcome = Outcome::kRead;
  std::string reason = {};
  double triangles = 0;  // where there are too many: so far
  Part part = {};
};

class Engine {
 public:
  virtual ~Engine() = default;

  virtual Result read(std::string_view bytes, Format format,
                      const Fineness& fineness,
                      std::optional<std::string_view> asked) noexcept = 0;
};

// Grows with every change above.
constexpr int kEngineVersion = 3;

// The module's function: the engine, which nobody deletes; null if it has
// another version.
using MakeEngine = Engine*(int version);

}  // namespace lamina::cad
