#pragma once
// One of the two that `lamina compare` compares: a file of layers, a design, or
// a mesh. Designs and meshes can be cut at any heights, files cannot.

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "cli/process/context.h"
#include "compiler/request.h"
#include "slicer/contour/layer.h"

namespace lamina::cli {

// Ends the comparison; what went wrong has been shown.
class ShownFault : public std::exception {};

class Compared {
 public:
  explicit Compared(std::string name) : name_(std::move(name)) {}
  Compared(const Compared&) = delete;
  Compared& operator=(const Compared&) = delete;
  virtual ~Compared() = default;

  // For messages and tables.
  const std::string& name() const { return name_; }
  // "SLC 2.0 by lamina 0.1.0", "design", "mesh".
  virtual std::string description() const = 0;

  // Those of the file, or of the design cut as its options say. Valid as long
  // as this object. Throws ShownFault or Error, as cut() does.
  virtual const std::vector<slicer::Layer>& layers() = 0;

  virtual bool can_be_cut() const { return false; }
  // A layer for each height, empty ones too. Heights rise.
  virtual std::vector<slicer::Layer> cut(const std::vector<double>& heights);

  // Whether thicknesses of layers are known, not only heights of sections.
  virtual bool has_sides() const { return true; }

  // How far contours can be from what the layers stand for, as it says itself
  // or, if it does not, as is usual [mm]. Known when there are layers.
  virtual double precision() const = 0;
  virtual bool is_precision_assumed() const { return false; }

 private:
  std::string name_;
};

// Whether `path` is named like something that can be compared.
bool can_compare(const std::string& path);

// path     of a file of layers, a design or a mesh, by its name
// request  of the design, but for its path; a mesh is only turned, scaled and
//          compensated by them. It and the context outlive the result.
std::unique_ptr<Compared> open_compared(const std::string& path,
                                        const compiler::Request& request,
                                        bool is_quiet, const Context& context);

// What openscad makes of the design, by name "openscad". It is rendered when
// layers are asked for first.
//
// time_limit  for openscad [s]
std::unique_ptr<Compared> open_openscad(const std::string& design,
                                        const compiler::Request& request,
                                        double time_limit, bool is_quiet,
                                        const Context& context);

}  // namespace lamina::cli
