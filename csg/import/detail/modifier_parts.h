#pragma once
// Parts of a slicer's project that are no part of the print: volumes that
// change settings, hold supports off, or cut others. 3MF itself does not know
// them; PrusaSlicer, Bambu Studio and OrcaSlicer name them in files beside the
// model.

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/file/zip.h"

namespace lamina::csg {

struct ModifierParts {
  std::size_t count = 0;
  // PrusaSlicer: first and last triangle in an object's mesh, by its id.
  std::map<std::string, std::vector<std::pair<std::uint32_t, std::uint32_t>>>
      triangles;
  // Bambu Studio, OrcaSlicer: the ids of an object and of a component of it.
  std::set<std::pair<std::string, std::string>> components;
  // Both: the names that objects have in the program, by their ids.
  std::map<std::string, std::string> names;
};

// throws  FormatError where such a file is malformed
ModifierParts read_modifier_parts(const ZipArchive& archive);

}  // namespace lamina::csg
