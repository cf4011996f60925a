#pragma once
// One of the two things that `lamina compare` compares: a file of layers, a
// design, or a mesh. Designs and meshes can be cut at any heights, files
// cannot.

#include <memory>
#include <string>
#include <vector>

#include "compiler/compilation.h"
#include "slicer/contour/layer.h"

namespace lamina::compiler {

// What a comparison says of one of the two.
struct SideText {
  std::string name;
  std::string description;  // "SLC 2.0 by lamina 0.1.0", "design", "mesh"
  // How far contours can be from the part that the layers show, as the file or
  // the design says or, if it does not, as is usual [mm].
  double precision = 0;
  bool is_assumed = false;  // the precision
};

class Compared {
 public:
  virtual ~Compared() = default;

  virtual const std::string& name() const = 0;
  // Known once layers() or cut() has been called.
  virtual SideText text() const = 0;

  // The layers of the file, or of the design cut as its options say. Valid as
  // long as this object. Throws Error, as cut() does; what a compilation throws
  // is among its messages then.
  virtual const std::vector<slicer::Layer>& layers() = 0;
  // Whether thicknesses of layers are known, not only heights of sections.
  virtual bool has_sides() const { return true; }

  virtual bool can_be_cut() const { return false; }
  // A layer for each height, empty ones too. Heights rise.
  virtual std::vector<slicer::Layer> cut(const std::vector<double>& heights);
};

// Whether `path` is named like something that can be compared.
bool can_compare(const std::string& path);

// What is asked of one side of a comparison. A mesh is only turned, scaled and
// compensated by the options of designs.
Request request_of_side(const std::string& path, const Request& request);

// The file, design or mesh of the compilation's request, which outlives the
// result.
std::unique_ptr<Compared> open_compared(Compilation& compilation);

// A mesh that openscad has made; its name is "openscad".
std::unique_ptr<Compared> open_openscad_mesh(Compilation& compilation,
                                             std::string description);

}  // namespace lamina::compiler
