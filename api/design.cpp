// The passes of compiler/passes.h behind a header that shows no type of theirs.

#include "api/lamina/design.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "compiler/compile.h"
#include "compiler/passes.h"
#include "parser/customizer/customizer.h"
#include "plane/loop_area.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/plan/orientation.h"

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

void require(bool holds, const std::string& words) {
  if (!holds) throw std::runtime_error(words);
}

bool is_positive(double value) { return value > 0 && std::isfinite(value); }
bool is_not_negative(double value) {
  return value >= 0 && std::isfinite(value);
}

// The passes trust what they are asked for.
void check(const DesignOptions& options) {
  const auto& axes = slicer::kAxes;
  require(options.axis == compiler::kAutomaticAxis ||
              std::find(axes.begin(), axes.end(), options.axis) != axes.end(),
          "axis must be z, x, y, -x, -y, -z or auto");
  require(is_positive(options.scale), "scale must be more than 0");
  require(is_not_negative(options.chordal_error),
          "chordal_error must not be negative");
  require(options.language == "auto" || options.language == "2021" ||
              options.language == "2026",
          "language must be auto, 2021 or 2026");
  require(options.parameter_file.empty() == options.parameter_set.empty(),
          "parameter_file and parameter_set need each other");
}

void check(const SliceOptions& options) {
  require(is_positive(options.layer_thickness),
          "layer_thickness must be more than 0 mm");
  require(is_not_negative(options.tolerance), "tolerance must not be negative");
  require(std::isfinite(options.compensation), "compensation must be finite");
  require(is_not_negative(options.adaptive), "adaptive must not be negative");
  require(options.adaptive == 0 || options.heights.empty(),
          "adaptive and heights exclude each other");
  require(options.max_layer == 0 ||
              (options.adaptive > 0 && std::isfinite(options.max_layer) &&
               options.max_layer >= options.layer_thickness),
          "max_layer needs adaptive and must not be less than layer_thickness");
  for (std::size_t i = 0; i < options.heights.size(); ++i) {
    require(std::isfinite(options.heights[i]), "heights must be finite");
    require(i == 0 || options.heights[i - 1] < options.heights[i],
            "heights must rise");
  }
}

compiler::Request to_request(const DesignOptions& options, std::string name) {
  check(options);
  compiler::Request request;
  request.design.path = std::move(name);
  for (const std::string& definition : options.definitions) {
    request.design.definitions += definition + ";\n";
  }
  request.design.parameter_file = options.parameter_file;
  request.design.parameter_set = options.parameter_set;
  request.geometry.chordal_error = options.chordal_error;
  request.geometry.scale = options.scale;
  request.geometry.axis = options.axis;
  request.geometry.is_placed_on_bed = options.place_on_bed;
  request.design.language = options.language;
  request.design.seed = options.seed;
  request.design.max_depth = options.max_depth;
  request.design.max_leaves = options.max_leaves;
  request.design.module_folder = options.module_folder;
  return request;
}

slicer::Settings to_settings(const SliceOptions& options) {
  check(options);
  slicer::Settings settings;
  settings.layer_thickness = options.layer_thickness;
  settings.cusp = options.adaptive;
  settings.greatest_thickness = options.max_layer;
  settings.heights = options.heights;
  settings.tolerance = options.tolerance;
  settings.compensation = options.compensation;
  settings.threads = options.threads;
  return settings;
}

// Where its choices are `""`, the customizer found none.
Parameter to_parameter(const CustomizerEntry& entry) {
  const ParameterComment& comment = entry.comment;
  return {entry.name, entry.value,
          comment.values == "\"\"" ? "" : comment.values, comment.description,
          comment.group};
}

ThinPlace to_place(const slicer::ThinFeature& feature, std::string origin) {
  return {feature.kind == slicer::ThinKind::kWall,
          feature.width,
          {feature.place.x, feature.place.y},
          feature.section_z,
          feature.bottom,
          feature.top,
          std::move(origin)};
}

// Shows messages as they come, and keeps those that end the work.
class Messages {
 public:
  explicit Messages(std::function<void(std::string_view)> show)
      : show_(std::move(show)),
        diagnostics_([this](const Diagnostic& d) { take(d); }) {}

  void take(const Diagnostic& diagnostic) {
    const std::string text = caret_text(diagnostic);
    if (diagnostic.severity == Severity::kError) {
      errors_ += text;
    } else if (show_) {
      show_(text);
    }
  }

  // Runs `work`, which may report to the Diagnostics that it gets, and throws
  // the text of the errors where it fails.
  template <typename Work>
  auto run(const Work& work) {
    try {
      return work(diagnostics_);
    } catch (const Error& error) {
      if (errors_.empty()) take(error.diagnostic());
      fail();
    }
  }

  [[noreturn]] void fail() const { throw std::runtime_error(errors_); }

 private:
  std::function<void(std::string_view)> show_;
  std::string errors_;
  Diagnostics diagnostics_;
};

FileAccess to_access(const DesignOptions& options) {
  require(!options.root.empty() || options.readable.empty(),
          "readable needs root");
  Messages messages(nullptr);
  return messages.run([&](Diagnostics&) {
    FileAccess access =
        FileAccess::within({options.root, options.readable, options.no_import});
    access.report_to(std::make_shared<RunFiles>());
    return access;
  });
}

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
  State(const DesignOptions& options, compiler::Request its_request)
      : show(options.show),
        messages(show),
        access(to_access(options)),
        temporary_files(access),
        request(std::move(its_request)),
        compilation(request, temporary_files,
                    [this](const Diagnostic& d) { messages.take(d); }) {}

  // From the design to the scene.
  static std::unique_ptr<const State> make(const DesignOptions& options,
                                           compiler::Request request) {
    auto state = std::make_unique<State>(options, std::move(request));
    state->messages.run([&](Diagnostics&) {
      // Errors of files that the design uses end it here, too.
      if (!compiler::make_tree(state->compilation) ||
          state->compilation.diagnostics.has_errors()) {
        state->messages.fail();
      }
      state->lowered = compiler::lower_tree(state->compilation);
    });
    for (const CustomizerEntry& entry :
         list_parameters(state->compilation.program)) {
      state->parameters.push_back(to_parameter(entry));
    }
    return state;
  }

  // The passes from the scene to layers. Several threads may call it.
  slicer::SliceReport slice(const slicer::Settings& settings,
                            slicer::LayerSink& sink,
                            Diagnostics& diagnostics) const {
    return compiler::slice(lowered, compiler::plan(lowered, settings), settings,
                           sink, diagnostics);
  }

  std::function<void(std::string_view)> show;
  Messages messages;
  FileAccess access;
  TemporaryFiles temporary_files;
  compiler::Request request;
  compiler::Compilation compilation;
  csg::Lowered lowered;
  std::vector<Parameter> parameters;
};

Design::Design(std::unique_ptr<const State> state) : state_(std::move(state)) {}
Design::Design(Design&&) noexcept = default;
Design& Design::operator=(Design&&) noexcept = default;
Design::~Design() = default;

Design Design::from_file(const std::string& path,
                         const DesignOptions& options) {
  return Design(State::make(options, to_request(options, path)));
}

Design Design::from_text(const std::string& text, const DesignOptions& options,
                         const std::string& name) {
  compiler::Request request = to_request(options, name);
  request.design.text = text;
  return Design(State::make(options, std::move(request)));
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
  messages.run([&](Diagnostics& diagnostics) {
    state_->slice(settings, sink, diagnostics);
  });
}

void Design::write(const std::string& path, const SliceOptions& options,
                   const ImageOptions& images) const {
  compiler::Request request = state_->request;
  request.output.path = path;
  request.job = to_settings(options);
  request.output.printer = images.printer;
  request.output.mirrors_x = images.mirror_x;
  request.output.mirrors_y = images.mirror_y;
  const slicer::FormatChoice choice = slicer::choose_output_format(path);
  if (!choice.format) throw std::runtime_error(choice.complaint);
  request.output.format = *choice.format;
  require(slicer::is_of_layers(request.output.format),
          fmt::format("'{}' asks for no format of layers", path));
  Messages messages(state_->show);
  messages.run([&](Diagnostics& diagnostics) {
    state_->access.run_files()->require_unread(
        path, state_->access.look_at(path), state_->access);
    TemporaryFiles temporary_files(state_->access);
    compiler::LayerOutput output =
        compiler::LayerOutput::open(request, temporary_files, diagnostics);
    state_->slice(compiler::settings_of(request), output.sink(), diagnostics);
    compiler::Report report;
    output.finish(diagnostics, report);
  });
}

std::vector<ThinPlace> Design::find_thin_places(
    double width, const SliceOptions& options) const {
  require(
      width >= slicer::kLeastThinWidth && width <= slicer::kGreatestThinWidth,
      fmt::format("width must be from {} to {} mm", slicer::kLeastThinWidth,
                  slicer::kGreatestThinWidth));
  slicer::Settings settings = to_settings(options);
  settings.min_feature = width;
  slicer::LayerDrain drain;
  Messages messages(state_->show);
  return messages.run([&](Diagnostics& diagnostics) {
    const std::vector<slicer::ThinFeature> features =
        state_->slice(settings, drain, diagnostics).features;
    const std::vector<std::string> origins = compiler::origin_texts(
        compiler::origins_of(*state_->lowered.scene(), features));
    std::vector<ThinPlace> places;
    for (std::size_t i = 0; i < features.size(); ++i) {
      places.push_back(to_place(features[i], origins[i]));
    }
    return places;
  });
}

const std::vector<Parameter>& Design::parameters() const {
  return state_->parameters;
}

}  // namespace lamina
