#pragma once
// Options that each are good, but not together. They are refused, so that
// nobody takes for done what was not. Only options of slicing may stand idle:
// one set of them goes for layers and texts of a design.

#include <string>
#include <string_view>

#include "compiler/design_options.h"
#include "slicer/slice/settings.h"

namespace lamina::cli {

// What is wrong with them, for the user; null if they go together.
const char* find_contradiction(const slicer::Settings& settings);

// Likewise of the options with the output's format.
const char* find_misfit(const DesignOptions& options);

// Throws UsageError if `file` is named as layers that are written only, such
// as ring.sl1. `command` is what would have read it.
void require_readable(std::string_view command, const std::string& file);

}  // namespace lamina::cli
