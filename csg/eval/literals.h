#pragma once
// Hexadecimal numbers: 0x and digits of either case.
//
// To OpenSCAD 2021.01 `0xff` is a name like any other that begins with a digit.
// So it stays one here, and a variable of that name is found first; only where
// there is none is it the number.

#include <string>
#include <string_view>

namespace lamina::csg {

bool is_hex_literal(std::string_view name);

struct HexLiteral {
  double value = 0;     // 2^64 for all that is larger
  std::string warning;  // where the value is not exactly what was written
};

// `name` must be a hexadecimal number.
HexLiteral read_hex_literal(std::string_view name);

}  // namespace lamina::csg
