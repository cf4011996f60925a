#include "tests/support/design.h"

#include <stdexcept>
#include <utility>

#include "slicer/slice/slice.h"

namespace lamina::support {

struct Design::State {
  explicit State(compiler::Request its_request)
      : request(std::move(its_request)), compilation(request, files) {}

  std::string messages() const {
    std::string text;
    for (const Diagnostic& diagnostic : compilation.diagnostics.all()) {
      text += caret_text(diagnostic);
    }
    return text;
  }

  // The passes as far as the scene.
  void build() {
    try {
      compiler::make_tree(compilation);
      lowered = compiler::lower(compilation.tree, request, {},
                                compilation.readers, compilation.diagnostics);
    } catch (const InternalError&) {
      throw;
    } catch (const Error& error) {
      throw std::runtime_error(messages() + error.what());
    }
    if (compilation.diagnostics.has_errors() || lowered.outline() != nullptr) {
      throw std::runtime_error("no solid\n" + messages());
    }
    if (lowered.is_empty()) lowered.geometry = csg::Scene();
  }

  compiler::Request request;
  TemporaryFiles files;
  compiler::Compilation compilation;
  csg::Lowered lowered;
};

Design::Design(std::unique_ptr<State> state) : state_(std::move(state)) {}
Design::Design(Design&&) noexcept = default;
Design& Design::operator=(Design&&) noexcept = default;
Design::~Design() = default;

Design Design::make(compiler::Request request) {
  request.design.module_folder = LAMINA_MODULES;
  auto state = std::make_unique<State>(std::move(request));
  state->build();
  return Design(std::move(state));
}

Design Design::from_file(const std::filesystem::path& path) {
  compiler::Request request;
  request.design.path = path.string();
  return make(std::move(request));
}

Design Design::from_text(const std::string& text, double chordal_error) {
  compiler::Request request;
  request.design.path = "test.scad";
  request.design.text = text;
  request.geometry.chordal_error = chordal_error;
  return make(std::move(request));
}

const csg::Scene& Design::scene() const { return *state_->lowered.scene(); }

std::vector<slicer::Layer> slice_layers(const csg::Scene& scene,
                                        const slicer::Settings& settings) {
  LayerList list;
  Diagnostics diagnostics;
  slicer::slice(scene, slicer::plan_layers(scene, settings), settings, list,
                diagnostics);
  return std::move(list.layers);
}

std::vector<slicer::Layer> slice_heights(const csg::Scene& scene,
                                         const std::vector<double>& heights,
                                         double pitch) {
  slicer::Settings settings;
  settings.heights = heights;
  settings.ray_pitch = pitch;
  settings.tolerance = 0;
  settings.threads = 1;
  return slice_layers(scene, settings);
}

}  // namespace lamina::support
