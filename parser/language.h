#pragma once
// Which OpenSCAD a design is read as.
//
// What only one version accepts is always understood. The language decides what
// both accept and take differently.

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/source.h"

namespace lamina {

// k2021: the release 2021.01. k2026: the development of July 2026.
enum class Language : std::uint8_t { k2021, k2026 };

// A name as messages show it: 2026 has double quotes everywhere, 2021.01 those
// that the message has.
inline std::string quoted_name(std::string_view name, Language language,
                               std::string_view quotes_of_2021) {
  return fmt::format("{1}{0}{1}", name,
                     language == Language::k2021 ? quotes_of_2021 : "\"");
}

// A place in a text that 2021.01 cannot parse, or that does nothing in it, so
// that the text was not written for it.
struct NewerSyntax {
  SourceRange range;
  std::string_view what;  // "trailing comma"
};

}  // namespace lamina
