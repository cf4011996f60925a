#pragma once
// JSON files as values. As in OpenSCAD, the members of objects are in the order
// of their names; of members of one name the last counts; null is undef.

#include <string>

#include "base/file/file_access.h"
#include "csg/eval/value/value.h"

namespace lamina::csg {

struct JsonResult {
  Value value;
  bool can_read = true;
  std::string fault;  // what is wrong with the text; empty: nothing
};

JsonResult read_json(const std::string& path,
                     const FileAccess& access = kAllFiles);

}  // namespace lamina::csg
