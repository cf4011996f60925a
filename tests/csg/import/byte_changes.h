#pragma once
// Damages files: cuts them off, or replaces a byte.

#include <functional>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include "base/file/format_error.h"
#include "csg/import/mesh_file.h"

namespace lamina::csg {

// Calls `parse` with the bytes cut off at every length, and with every byte
// replaced by some others. Only FormatError may come out.
inline void expect_no_harm(const std::string& bytes,
                           const std::function<void(std::string_view)>& parse) {
  const auto survive = [&parse](const std::string& changed) {
    try {
      parse(changed);
    } catch (const FormatError& fault) {
      EXPECT_NE(std::string_view(fault.what()), "");
    }
  };
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    // A copy of its own, so that reading past its end is seen.
    survive(std::string(bytes.data(), size));
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char other : {'\0', '9', '-', ' ', '\n', '<', '\xff'}) {
      std::string changed = bytes;
      changed[i] = other;
      survive(changed);
    }
  }
}

// Every index names a vertex.
inline void expect_whole(const RawMesh& raw) {
  EXPECT_EQ(raw.count_stray_corners(), 0U);
}

// What parsing fails with; "" where it does not.
inline std::string fault_of(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const FormatError& fault) {
    return fault.what();
  }
  return "";
}

}  // namespace lamina::csg
