#pragma once
// What `lamina inspect` prints.

#include <string>

#include "slicer/check/inspect.h"

namespace lamina::slicer {

enum class LayerList { kSummary, kAll };

// For the user; ends with '\n'.
std::string inspection_text(const Inspection& found, LayerList list);

// For programs: all findings as JSON; ends with '\n'.
std::string inspection_json(const Inspection& found);

}  // namespace lamina::slicer
