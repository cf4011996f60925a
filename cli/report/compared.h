#pragma once
// One of the two things that `lamina compare` compares: a file of layers, a
// design, or a mesh. Designs and meshes can be cut at any heights, files
// cannot.

#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "cli/process/context.h"
#include "compiler/request.h"
#include "slicer/contour/layer.h"

namespace lamina::cli {

// Ends the comparison after a fault that has been shown.
class ShownFault : public std::exception {};

class Compared {
 public:
  explicit Compared(std::string name, std::string description = "")
      : description_(std::move(description)), name_(std::move(name)) {}
  virtual ~Compared() = default;

  // For messages and tables.
  const std::string& name() const { return name_; }
  // "SLC 2.0 by lamina 0.1.0", "design", "mesh"; of a file, once layers() has
  // read it.
  const std::string& description() const { return description_; }

  // The layers of the file, or of the design cut as its options say. Valid as
  // long as this object. Throws ShownFault or Error, as cut() does.
  virtual const std::vector<slicer::Layer>& layers() = 0;

  virtual bool can_be_cut() const { return false; }
  // A layer for each height, empty ones too. Heights rise.
  virtual std::vector<slicer::Layer> cut(const std::vector<double>& heights);

  // Whether thicknesses of layers are known, not only heights of sections.
  virtual bool has_sides() const { return true; }

  // How far contours can be from what the layers stand for, as the file or the
  // design says or, if it does not, as is usual [mm]. Known once layers() or
  // cut() has been called.
  virtual double precision() const = 0;
  virtual bool is_precision_assumed() const { return false; }

 protected:
  std::string description_;

 private:
  std::string name_;
};

// Whether `path` is named like something that can be compared.
bool can_compare(const std::string& path);

// path     of a file of layers, a design or a mesh, by its name
// request  what is asked of a design, whatever its path; a mesh is only turned,
//          scaled and compensated by it
// context  outlives the result
std::unique_ptr<Compared> open_compared(const std::string& path,
                                        const compiler::Request& request,
                                        bool is_quiet, const Context& context);

// The mesh that openscad makes of the design; its name is "openscad". Throws
// FileError where openscad makes none.
//
// version     as openscad_version() has it
// time_limit  for openscad [s]
std::unique_ptr<Compared> open_openscad(const std::string& design,
                                        const compiler::Request& request,
                                        const std::string& version,
                                        double time_limit, bool is_quiet,
                                        const Context& context);

}  // namespace lamina::cli
