#include "tests/support/design.h"

#include <optional>
#include <stdexcept>
#include <utility>

#include "csg/eval/evaluator.h"
#include "csg/lower/lower.h"
#include "csg/text/typesetter.h"
#include "parser/loader.h"
#include "slicer/slice/slice.h"

namespace lamina::support {

struct Design::State {
  SourceStore sources;
  Diagnostics diagnostics;
  std::optional<Loader> loader;
  ast::Program program;
  csg::Tree tree;
  csg::Lowered lowered;

  std::string messages() const {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      text += caret_text(diagnostic);
    }
    return text;
  }

  // Reads by `load` and goes on to the scene.
  template <typename Load>
  void build(const Load& load, csg::LowerOptions options = {}) {
    loader.emplace(sources, diagnostics, std::vector<std::string>());
    try {
      program = load(*loader);
      tree = csg::evaluate(program, *loader, {}, diagnostics);
      text::Typesetter typesetter({LAMINA_MODULES}, diagnostics);
      typesetter.add_fonts(loader->fonts());
      options.typesetter = &typesetter;
      lowered = csg::lower(tree, options, diagnostics);
    } catch (const InternalError&) {
      throw;
    } catch (const Error& error) {
      throw std::runtime_error(messages() + error.what());
    }
    if (diagnostics.has_errors() || lowered.outline() != nullptr) {
      throw std::runtime_error("no solid\n" + messages());
    }
    if (lowered.is_empty()) {
      lowered.geometry = csg::Scene();
    }
  }
};

Design::Design(std::unique_ptr<State> state) : state_(std::move(state)) {}
Design::Design(Design&&) noexcept = default;
Design& Design::operator=(Design&&) noexcept = default;
Design::~Design() = default;

Design Design::from_file(const std::filesystem::path& path) {
  auto state = std::make_unique<State>();
  state->build([&](Loader& loader) { return loader.load(path.string()); });
  return Design(std::move(state));
}

Design Design::from_text(const std::string& text, double chordal_error) {
  auto state = std::make_unique<State>();
  csg::LowerOptions options;
  options.chordal_error = chordal_error;
  state->build(
      [&](Loader& loader) { return loader.load_text("test.scad", text); },
      options);
  return Design(std::move(state));
}

const csg::Scene& Design::scene() const { return *state_->lowered.scene(); }

std::vector<slicer::Layer> slice_layers(const csg::Scene& scene,
                                        const slicer::Settings& settings) {
  LayerList list;
  Diagnostics diagnostics;
  slicer::slice(scene, settings, list, diagnostics);
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
