#pragma once
// Takes a design all the way from text to layers, for tests.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "compiler/compile.h"
#include "csg/scene.h"
#include "slicer/contour/layer.h"
#include "slicer/slice/settings.h"

namespace lamina::support {

// A design read, evaluated and lowered; keeps alive what its scene points to.
class Design {
 public:
  // Both throw std::runtime_error with all messages where the design has errors
  // or is 2D, and let InternalError pass. A design of nothing has a scene
  // without instances.
  static Design from_file(const std::filesystem::path& path);
  // chordal_error  [mm]; 0: $fa and $fs decide
  static Design from_text(const std::string& text, double chordal_error = 0);

  Design(Design&&) noexcept;
  Design& operator=(Design&&) noexcept;
  ~Design();

  const csg::Scene& scene() const;

 private:
  struct State;
  explicit Design(std::unique_ptr<State> state);
  static Design make(compiler::Request request);

  std::unique_ptr<State> state_;
};

using slicer::LayerList;

// All layers of a scene. Throws what the slicer throws.
std::vector<slicer::Layer> slice_layers(const csg::Scene& scene,
                                        const slicer::Settings& settings);

// Sections at exactly these heights, all vertices kept, on one thread.
//
// pitch  of the look-ahead rays [mm]; 0 = auto
std::vector<slicer::Layer> slice_heights(const csg::Scene& scene,
                                         const std::vector<double>& heights,
                                         double pitch = 0);

}  // namespace lamina::support
