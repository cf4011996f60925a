#pragma once
// The 954 names that people gave to the colours of a monitor in the survey of
// xkcd.com, 2010.

#include <string_view>

namespace lamina::csg {

// "name RRGGBB," for each, in the order of the names, which may hold blanks.
extern const std::string_view kXkcdColors;

}  // namespace lamina::csg
