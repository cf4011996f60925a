// The passes of the program (compiler/compile.cpp), behind a header without
// them.

#include "api/lamina/design.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/loop_area.h"
#include "csg/eval/evaluator.h"
#include "csg/lower/lower.h"
#include "csg/text/typesetter.h"
#include "parser/loader.h"
#include "slicer/contour/deviation.h"
#include "slicer/formats/layer_writer.h"
#include "slicer/formats/output_format.h"
#include "slicer/slice/slice.h"

namespace lamina {
namespace {

Layer to_layer(const slicer::Layer& sliced) {
  Layer layer{sliced.section_z, sliced.bottom, sliced.top, {}};
  layer.loops.resize(sliced.contours.loop_count());
  for (std::size_t i = 0; i < layer.loops.size(); ++i) {
    for (const Vec2& point : sliced.contours.loop(i)) {
      layer.loops[i].push_back({point.x, point.y});
    }
  }
  return layer;
}

class CallingSink : public slicer::LayerSink {
 public:
  explicit CallingSink(const std::function<void(const Layer&)>& take)
      : take_(take) {}

  void take(const slicer::Layer& layer) override { take_(to_layer(layer)); }

 private:
  const std::function<void(const Layer&)>& take_;
};

// What must not reach the slicer, which trusts its settings.
void check(const SliceOptions& options) {
  const auto require = [](bool holds, const char* words) {
    if (!holds) throw std::runtime_error(words);
  };
  require(options.layer_thickness > 0 && std::isfinite(options.layer_thickness),
          "layer_thickness must be more than 0 mm");
  require(options.tolerance >= 0 && std::isfinite(options.tolerance),
          "tolerance must not be negative");
  require(std::isfinite(options.compensation), "compensation must be finite");
  for (std::size_t i = 0; i < options.heights.size(); ++i) {
    require(std::isfinite(options.heights[i]), "heights must be finite");
    require(i == 0 || options.heights[i - 1] < options.heights[i],
            "heights must rise");
  }
}

slicer::Settings to_settings(const SliceOptions& options) {
  check(options);
  slicer::Settings settings;
  settings.layer_thickness = options.layer_thickness;
  settings.heights = options.heights;
  settings.tolerance = options.tolerance;
  settings.compensation = options.compensation;
  settings.threads = options.threads;
  return settings;
}

std::string join_definitions(const std::vector<std::string>& definitions) {
  std::string text;
  for (const std::string& definition : definitions) text += definition + ";\n";
  return text;
}

// The messages of a run: shown as they come, and kept where they end it.
class Messages {
 public:
  explicit Messages(std::function<void(std::string_view)> show)
      : show_(std::move(show)),
        diagnostics_([this](const Diagnostic& d) { take(d); }) {}

  Diagnostics& diagnostics() { return diagnostics_; }

  // Runs `work`, and throws the text of the errors where it fails.
  template <typename Work>
  auto run(const Work& work) {
    try {
      return work();
    } catch (const Error& error) {
      if (errors_.empty()) take(error.diagnostic());
      fail();
    }
  }

  [[noreturn]] void fail() const { throw std::runtime_error(errors_); }

 private:
  void take(const Diagnostic& diagnostic) {
    const std::string text = caret_text(diagnostic);
    if (diagnostic.severity == Severity::kError) {
      errors_ += text;
    } else if (show_) {
      show_(text);
    }
  }

  std::function<void(std::string_view)> show_;
  std::string errors_;
  Diagnostics diagnostics_;
};

}  // namespace

double signed_area(const Loop& loop) {
  if (loop.empty()) return 0;
  const auto place = [](const Point& point) { return Vec2(point.x, point.y); };
  DoubledArea area(place(loop.front()), place(loop.back()));
  for (const Point& point : loop) area.add(place(point));
  return area.value() / 2;
}

double area(const Layer& layer) {
  double sum = 0;
  for (const Loop& loop : layer.loops) sum += signed_area(loop);
  return sum;
}

struct Design::State {
  explicit State(const DesignOptions& options)
      : show(options.show),
        messages(show),
        loader(sources, messages.diagnostics(), library_folders(),
               join_definitions(options.definitions)) {}

  template <typename Load>
  static std::unique_ptr<const State> make(const DesignOptions& options,
                                           const Load& load) {
    auto state = std::make_unique<State>(options);
    state->messages.run([&] { state->build(options, load(state->loader)); });
    return state;
  }

  // From the syntax tree to the scene.
  void build(const DesignOptions& options, const ast::Program& program) {
    Diagnostics& diagnostics = messages.diagnostics();
    std::vector<std::string> folders = text::module_folders();
    folders.insert(folders.begin(), options.module_folder);
    text::Typesetter typesetter(folders, diagnostics);
    typesetter.add_fonts(loader.fonts());
    csg::EvaluateOptions how;
    how.preview = false;
    how.text_measurer = &typesetter;
    tree = csg::evaluate(program, loader, how, diagnostics);
    if (diagnostics.has_errors()) messages.fail();
    csg::LowerOptions lowering;
    lowering.chordal_error = options.chordal_error;
    lowering.scale = options.scale;
    lowering.typesetter = &typesetter;
    csg::Lowered lowered = csg::lower(tree, lowering, diagnostics);
    tree.drop_nodes();
    if (lowered.scene() == nullptr) {
      throw GeometryError({Severity::kError,
                           {},
                           lowered.is_empty()
                               ? "Current top level object is empty."
                               : "Current top level object is not a 3D "
                                 "object."});
    }
    scene = std::get<csg::Scene>(std::move(lowered.geometry));
  }

  std::function<void(std::string_view)> show;
  // What the scene names its places in.
  SourceStore sources;
  Messages messages;
  Loader loader;
  csg::Tree tree;
  csg::Scene scene;
};

Design::Design(std::unique_ptr<const State> state) : state_(std::move(state)) {}
Design::Design(Design&&) noexcept = default;
Design& Design::operator=(Design&&) noexcept = default;
Design::~Design() = default;

Design Design::from_file(const std::string& path,
                         const DesignOptions& options) {
  return Design(
      State::make(options, [&](Loader& loader) { return loader.load(path); }));
}

Design Design::from_text(const std::string& text, const DesignOptions& options,
                         const std::string& name) {
  return Design(State::make(
      options, [&](Loader& loader) { return loader.load_text(name, text); }));
}

std::vector<Layer> Design::slice(const SliceOptions& options) const {
  std::vector<Layer> layers;
  slice(options, [&](const Layer& layer) { layers.push_back(layer); });
  return layers;
}

void Design::slice(const SliceOptions& options,
                   const std::function<void(const Layer&)>& take) const {
  const slicer::Settings settings = to_settings(options);
  CallingSink sink(take);
  Messages messages(state_->show);
  messages.run([&] {
    slicer::slice(state_->scene, settings, sink, messages.diagnostics());
  });
}

void Design::write(const std::string& path, const SliceOptions& options) const {
  const slicer::Settings settings = to_settings(options);
  const slicer::FormatChoice choice = slicer::choose_output_format(path);
  if (!choice.format) throw std::runtime_error(choice.complaint);
  if (!slicer::is_of_layers(*choice.format) ||
      slicer::is_of_images(*choice.format)) {
    throw std::runtime_error(
        fmt::format("'{}' asks for no format of contours", path));
  }
  Messages messages(state_->show);
  messages.run([&] {
    TemporaryFiles temporary_files;
    slicer::WriterOptions how;
    how.format = *choice.format;
    how.deviation = slicer::promised_deviation(settings)->from_section();
    const auto writer = make_layer_writer(how, path, temporary_files);
    slicer::slice(state_->scene, settings, *writer, messages.diagnostics());
    writer->finish(messages.diagnostics());
    writer->commit();
  });
}

}  // namespace lamina
