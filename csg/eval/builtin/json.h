#pragma once
// JSON files as values: objects with their members in the order of their
// names, as OpenSCAD has them (of one name twice the last counts), null as
// undef, every number as a number of the language.

#include <string>

#include "base/file/file_access.h"
#include "csg/eval/value/value.h"

namespace lamina::csg {

struct JsonResult {
  Value value;
  bool can_read = true;
  std::string fault;  // why it is no JSON; empty: it is
};

JsonResult read_json(const std::string& path,
                     const FileAccess& access = kAllFiles);

}  // namespace lamina::csg
