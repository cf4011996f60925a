#pragma once
// The values that `for` and `each` see: of a vector its elements, of a range
// its numbers, of an object its keys, of a string its characters, of undef
// none; anything else is one value.

#include <cstdint>

#include "csg/eval/code/code.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/object.h"

namespace lamina::csg {

// Statements loop over ranges of fewer elements than the first, comprehensions
// of fewer than the second: so OpenSCAD has it.
constexpr std::uint32_t kMostStatementElements = 10000;
constexpr std::uint32_t kMostElements = 1000000;

// Warns of a range that is too long, at the code that loops.
void warn_of_long_range(std::uint32_t count, SourceRange place, Frame& frame);

// Calls `give` for each value. `most` is one of the limits above.
template <typename Give>
void for_each_value(const Value& values, std::uint32_t most, SourceRange place,
                    Frame& frame, const Give& give) {
  switch (values.type()) {
    case Type::kRange: {
      const Range& range = values.as_range();
      const std::uint32_t count = range.count();
      if (count >= most) return warn_of_long_range(count, place, frame);
      if (range.step == 0) return;
      for (std::uint32_t i = 0; i < count; ++i) give(Value(range.at(i)));
      return;
    }
    case Type::kVector:
      for (const Value& value : values.as_vector()) give(Value(value));
      return;
    case Type::kObject:
      for (const Value& key : values.as_object().keys.as_vector()) {
        give(Value(key));
      }
      return;
    case Type::kString: {
      const std::uint32_t count = values.character_count();
      for (std::uint32_t i = 0; i < count; ++i) give(values.character(i));
      return;
    }
    case Type::kUnset:
    case Type::kUndef:
      return;
    default:
      give(Value(values));
  }
}

}  // namespace lamina::csg
