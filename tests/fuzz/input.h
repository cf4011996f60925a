#pragma once
// What fuzzers share: their input as text and as a file, and what they claim.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace lamina::fuzz {

inline std::string_view as_text(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Writes the bytes to a file of that name and returns its path. The file stays
// until the next one of this name; all go at the program's end.
std::string write_input(const std::string& name, std::string_view bytes);

// Ends the program where a claim does not hold: a finding.
void require(bool holds, std::string_view claim);

}  // namespace lamina::fuzz
