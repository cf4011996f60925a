#pragma once
// What a page for browsers says of a design or a file of layers, beside the
// layers themselves.

#include <string>

#include "compiler/look_at.h"
#include "slicer/picture/viewer_page.h"

namespace lamina::compiler {

// What was found in the layers, what the print takes, and how much the supports
// are. Places of the design are named from the design's folder.
//
// inspection  of the compilation
// title       of the page
slicer::ViewerOptions viewer_options(const Compilation& compilation,
                                     const Inspection& inspection,
                                     const std::string& title);

// What the print takes.
slicer::PrintEstimate estimate_of(const Compilation& compilation,
                                  const slicer::Inspection& found);

}  // namespace lamina::compiler
