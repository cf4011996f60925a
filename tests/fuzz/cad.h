#pragma once
// What the fuzzers of STEP, IGES and BREP share.

#include <string_view>

#include "csg/cad/cad_reader.h"

namespace lamina::fuzz {

// Reads the bytes as a file of that format. OpenCASCADE may crash or loop, in
// its own process; this one gets a part or an error.
void read_part(std::string_view bytes, cad::Format format);

}  // namespace lamina::fuzz
