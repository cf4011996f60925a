#pragma once
// Reads parts of CAD programs, STEP, IGES and BREP, as meshes of a stated
// chordal error.
//
// OpenCASCADE reads them. It stands behind a module that the first such file
// opens: other runs pay nothing for it. It is known to crash on broken files,
// and does to a process as a whole what a library must not, so it reads each
// file in a process of its own (decision 36).

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/module.h"
#include "csg/scene.h"
#include "csg/tree.h"

namespace lamina::cad {

// The module that holds OpenCASCADE.
inline constexpr Module kModule{
    "lamina_cad.so", "lamina_make_cad_engine", "STEP, IGES and BREP",
    "the package lamina-cad has it; in a build folder, the target "
    "lamina_cad_module makes it"};

enum class Format : std::uint8_t {
  kStep,
  kIges,
  kBrep,  // OpenCASCADE's own, as text or binary
};

// Of a FreeCAD file: that of the boundaries in it.
Format format_of(csg::ImportFormat format);

// How closely a mesh follows the surface that it stands for.
struct Fineness {
  // Greatest distance of the surface from the mesh [mm].
  double chordal_error = 0.01;
  // Greatest turn of an edge of a face from one chord to the next [rad]: how
  // round what is small beside the chordal error still is.
  double angle = 0.35;
};

// One solid where it stands, in mm.
struct Body {
  std::string name;  // the file's; may be empty
  // Vertices are joined along the edges of the solid, each is a corner of a
  // triangle, and faces are counter-clockwise from outside. Where the file's
  // faces leave gaps, so does the mesh (csg/lower/detail/repair.h closes them).
  csg::Mesh mesh;
};

struct Part {
  std::vector<Body> bodies;  // in the order of the file
  std::vector<std::string> warnings;
  std::vector<std::string> notes;  // what is left out and is not a solid's
};

class Engine;

// Processor time for one file: OpenCASCADE may loop for ever on a broken one.
constexpr unsigned kMostSeconds = 300;

class Reader {
 public:
  // folders       where to look for the module, in this order
  // diagnostics   gets the error that the module is missing; outlives the
  //               reader
  // most_seconds  see above
  Reader(std::vector<std::string> folders, Diagnostics& diagnostics,
         unsigned most_seconds = kMostSeconds);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  // Reads all solids of a file, assemblies with all instances of their parts.
  // Shells and faces that belong to no solid are sewn together first.
  //
  // asked   only the solids of this name, or the one of this number, from 1 in
  //         the order of the file
  // throws  FormatError for what cannot be read, whatever OpenCASCADE did then,
  //         and where the file has no solid that is asked for;
  //         GeometryError where the module is missing; plane::LimitExceeded for
  //         too many triangles; std::bad_alloc
  Part read(std::string_view bytes, Format format, const Fineness& fineness,
            std::optional<std::string_view> asked = std::nullopt);

 private:
  std::vector<std::string> folders_;
  Diagnostics& diagnostics_;
  unsigned most_seconds_;
  Engine* engine_ = nullptr;  // the module's, to the end
};

}  // namespace lamina::cad
