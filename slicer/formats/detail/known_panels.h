#pragma once
// The printer profiles of slicer/formats/profiles, which the build puts into
// the program.

#include <span>
#include <string_view>

namespace lamina::slicer {

// The texts of the files, in alphabetical order of their names.
extern const std::span<const std::string_view> kKnownPanels;

}  // namespace lamina::slicer
