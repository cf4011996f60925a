#pragma once
// Hexadecimal and binary numbers: 0x and digits of either case, 0b and zeros
// and ones.
//
// To OpenSCAD 2021.01 `0xff` is a name, like any other that begins with a
// digit. It stays a name here, and a variable of that name counts; only where
// there is none is it a number. Later OpenSCAD reads 0x as well; 0b is lamina's
// own.

#include <string>
#include <string_view>

namespace lamina::csg {

bool is_prefixed_literal(std::string_view name);

struct PrefixedLiteral {
  double value = 0;     // 2^64 for all that is larger
  std::string warning;  // where the value is not exactly what was written
};

// `name` must be such a number.
PrefixedLiteral read_prefixed_literal(std::string_view name);

}  // namespace lamina::csg
