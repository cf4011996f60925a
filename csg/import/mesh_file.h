#pragma once
// import() of meshes: STL, OFF, AMF, 3MF, OBJ, PLY; and a reader for each
// format, which throws FormatError.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "csg/scene.h"
#include "csg/tree.h"

namespace lamina::csg {

// ", import() at line 7", as OpenSCAD ends messages on files; nothing where
// nobody wrote the import().
std::string at_import(SourceRange range);

// One body. Nothing is repaired yet and equal vertices need not be one, but
// every index names a vertex. Faces are counter-clockwise from outside, if the
// file keeps to that.
struct RawMesh {
  Mesh mesh;
  std::vector<std::vector<std::uint32_t>> polygons;  // faces of 4 corners up
  // No two vertices are equal, and each is a corner of a triangle.
  bool is_joined = false;
  // Whether the mesh only stands in for the slices that a 3MF has of its part.
  bool is_stand_in = false;

  // Appends a face; one of less than three corners is left out.
  void add_face(std::span<const std::uint32_t> corners) {
    if (corners.size() == 3) {
      mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (corners.size() > 3) {
      polygons.emplace_back(corners.begin(), corners.end());
    }
  }

  // Number of corners that name no vertex; 0, or a reader is at fault.
  std::size_t count_stray_corners() const;
};

// STL, as text and as binary.
//
// A file is binary where its size is the one that its number of facets asks
// for, whatever it begins with: many programs begin binary files with "solid".
// In text, lines with "vertex" count and all else is passed over, as OpenSCAD
// 2021.01 does. Rejected are a vertex without three numbers, a fourth vertex in
// a loop, and what is neither text nor as long as its facets need.
RawMesh parse_stl(std::string_view bytes);

// OFF, the format of Geomview, as text. Normals, colours and texture
// coordinates ([ST][C][N]OFF, 4OFF) are passed over; nOFF must be of 3
// dimensions. Each vertex and each face has a line of its own; the header says
// how many there are, and need not have the word OFF.
RawMesh parse_off(std::string_view bytes);

// OBJ, the format of Wavefront: vertices and faces; all else (normals,
// textures, materials, lines) is passed over. All objects and groups together
// make one body. Indices count from 1, or, if negative, back from the last
// vertex so far.
RawMesh parse_obj(std::string_view bytes);

// PLY, the format of Stanford's scans: as text, or binary in either order of
// bytes. Vertices are the elements "vertex" with x, y and z; faces are those of
// "face", or of "tristrips", with vertex_indices (or vertex_index). All other
// elements and properties are passed over. A file without faces is rejected.
RawMesh parse_ply(std::string_view bytes);

// What a file for printers shows.
struct PlacedMeshes {
  std::vector<RawMesh> bodies;
  // What it says and the reader passes over: each a sentence without a subject,
  // "has lengths in inches, taken for millimetres".
  std::vector<std::string> passed_over;
};

// By which rules the objects of a file are placed.
enum class Placing : std::uint8_t {
  kNone,      // each where it lies, as in OpenSCAD 2021.01
  kOpenScad,  // as in newer OpenSCAD, with transforms in its order; 3MF only
  kFile,      // as the file says, in its unit
};

// AMF, plain and zipped: one body for each object, or for each instance of a
// constellation. Colours and curved triangles do not count.
//
// name  of the file, without folder: an archive's entry of that name is the
//       model, or else its only entry
PlacedMeshes parse_amf(std::string_view bytes, const std::string& name,
                       Placing placing = Placing::kNone);

// 3MF, with the parts that components name by their path (the production
// extension): one body for each mesh object, or for each time that a build item
// names it, through components. Colours do not count.
//
// part  only what is of the object of this name or id, placed as all
PlacedMeshes parse_3mf(std::string_view bytes, Placing placing = Placing::kNone,
                       std::optional<std::string_view> part = std::nullopt);

// An object of a 3MF.
struct ThreemfPart {
  std::string id;
  std::string name;           // empty: none
  std::size_t triangles = 0;  // its own; none where it is made of others
  std::size_t count = 0;      // that the plate has of it
};

// The objects that parse_3mf() may be asked for, in the order of the file.
std::vector<ThreemfPart> threemf_parts(std::string_view bytes);

// The format by a file's extension, with or without its dot, in any case of
// letters.
ImportFormat import_format_of(std::string_view extension);
ImportFormat import_format_of_file(const std::string& path);

bool is_mesh(ImportFormat format);

// Whether a CAD program writes it.
bool is_cad(ImportFormat format);

// Whether part= names parts of it: CAD programs' files and 3MF.
bool has_parts(ImportFormat format);

// Reads the bodies of a file; none where it cannot be read, which it reports in
// OpenSCAD's words at `range`. It drops facets with coordinates that are no
// numbers, with a warning, so all vertices are finite.
//
// params  path, format and rules count; the format is one of meshes
std::vector<RawMesh> read_mesh_file(const ImportParams& params,
                                    const FileAccess& access, SourceRange range,
                                    Diagnostics& diagnostics);

}  // namespace lamina::csg
