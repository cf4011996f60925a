#pragma once
// Readers of meshes, one for each format. All throw FormatError.

#include <string>
#include <string_view>
#include <vector>

#include "csg/import/raw_mesh.h"

namespace lamina::csg {

// STL, as text and as binary.
//
// A file is binary where its size is the one that its number of facets asks
// for, whatever it begins with: many programs begin binary files with "solid".
// Of text, lines with "vertex" count and all else is passed over, as OpenSCAD
// 2021.01 does. Rejected are a vertex without three numbers, a fourth vertex in
// a loop, and what is neither text nor as long as its facets need.
RawMesh parse_stl(std::string_view bytes);

// OFF, the format of Geomview, as text. Normals, colours and texture
// coordinates ([ST][C][N]OFF, 4OFF) are passed over. Each vertex and each face
// has a line of its own; the header says how many there are.
RawMesh parse_off(std::string_view bytes);

// OBJ, the format of Wavefront: vertices and faces; all else (normals,
// textures, materials, lines) is passed over. All objects and groups together
// make one body. Indices count from 1, or, if negative, back from the last
// vertex so far.
RawMesh parse_obj(std::string_view bytes);

// AMF, plain and zipped: one body for each object. As in OpenSCAD 2021.01,
// every object counts where it lies; units, constellations, colours and curved
// triangles do not.
//
// name  of the file, without folder: an archive's entry of that name is the
//       model, or else its only entry
std::vector<RawMesh> parse_amf(std::string_view bytes, const std::string& name);

// 3MF: one body for each mesh object. As in OpenSCAD 2021.01, every object
// counts where it lies; units, build items, components and colours do not.
std::vector<RawMesh> parse_3mf(std::string_view bytes);

}  // namespace lamina::csg
