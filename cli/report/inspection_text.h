#pragma once
// What `lamina inspect` prints.

#include <string>

#include "slicer/check/defects/inspect.h"

namespace lamina::cli {

enum class ListedLayers { kSummary, kAll };

// For the user; ends with '\n'.
std::string inspection_text(const slicer::Inspection& found, ListedLayers list);

// For programs: all findings as JSON; ends with '\n'.
std::string inspection_json(const slicer::Inspection& found);

}  // namespace lamina::cli
