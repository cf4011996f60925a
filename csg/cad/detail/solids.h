#pragma once
// The solids of a shape, and what is made of faces that belong to none.

#include <string>
#include <vector>

#include <TopoDS_Shape.hxx>

#include "csg/cad/detail/shape_file.h"

namespace lamina::cad {

struct Solid {
  TopoDS_Shape shape;  // a solid, or a shell that stays open
  std::string name;
};

// chordal_error  how far apart edges may be that are sewn together [mm]
// part           gets warnings of what does not close, and notes
std::vector<Solid> find_solids(const ShapeFile& file, double chordal_error,
                               Part& part);

// "'bracket': ", or nothing for a solid without a name.
std::string prefix_of(const std::string& name);

}  // namespace lamina::cad
