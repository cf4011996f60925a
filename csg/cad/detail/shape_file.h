#pragma once
// From the bytes of a file to a shape of OpenCASCADE.

#include <string>
#include <string_view>
#include <vector>

#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS_Shape.hxx>

#include "csg/cad/cad_reader.h"

namespace lamina::cad {

// Thrown for bytes that are not such a file, or cannot be meshed.
struct Unreadable {
  std::string reason;
};

struct ShapeFile {
  TopoDS_Shape shape;  // of all that the file has, in mm
  // The names of solids, by their shape without its place.
  TopTools_DataMapOfShapeInteger name_of_solid;
  std::vector<std::string> names;
  std::string loss;  // of what is not in the shape: words for a warning, or ""
};

// Throws Unreadable, or one of OpenCASCADE's own.
ShapeFile read_shape(std::string_view bytes, Format format);

}  // namespace lamina::cad
