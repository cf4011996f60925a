// The passes of compiler/ behind a header that shows no type of theirs.

#include "api/lamina/design.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <mutex>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/paths.h"
#include "base/text.h"
#include "compiler/compile.h"
#include "compiler/layer_output.h"
#include "compiler/look_at.h"
#include "compiler/tasks/quote.h"
#include "compiler/tasks/viewer_options.h"
#include "compiler/validate.h"
#include "csg/support_tip.h"
#include "parser/customizer/customizer.h"
#include "plane/loop_area.h"
#include "slicer/picture/viewer_page.h"

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

class KeepingSink : public slicer::LayerSink {
 public:
  void take(const slicer::Layer& layer) override {
    layers.push_back(to_layer(layer));
  }

  std::vector<Layer> layers;
};

class CallingSink : public slicer::LayerSink {
 public:
  explicit CallingSink(const std::function<void(const Layer&)>& take)
      : take_(take) {}

  void take(const slicer::Layer& layer) override { take_(to_layer(layer)); }

 private:
  const std::function<void(const Layer&)>& take_;
};

[[noreturn]] void fail(const std::string& words) {
  throw DesignError(words, {words, "", 0, 0});
}

void require(bool holds, const std::string& words) {
  if (!holds) fail(words);
}

// A fault of a request, in the names of this interface instead of those of the
// command line: "--max-layer needs --adaptive" is "max_layer needs adaptive".
std::string in_own_names(std::string_view words) {
  return compiler::rename_options(words, [](std::string name) {
    if (name == "layer") return std::string("layer_thickness");
    if (name == "compensate") return std::string("compensation");
    std::ranges::replace(name, '-', '_');
    return name;
  });
}

void require_valid(const compiler::Request& request) {
  try {
    compiler::validate(request);
  } catch (const compiler::RequestError& error) {
    fail(in_own_names(error.what()));
  }
}

// Empty: none.
std::optional<slicer::SupportSizes> to_supports(const DesignOptions& options) {
  const std::string& word = options.supports;
  require(!word.empty() || !options.has_raft, "has_raft needs supports");
  if (word.empty()) return std::nullopt;
  slicer::SupportSizes sizes = {.tip = 0, .has_raft = options.has_raft};
  if (word == "auto") return sizes;
  std::optional<double> tip = csg::support_tip_named(word);
  if (!tip) tip = parse_number(word);
  require(
      tip && *tip >= csg::kLeastSupportTip && *tip <= csg::kGreatestSupportTip,
      fmt::format("supports: expected auto, light, medium, heavy or {:g} "
                  "to {:g} (mm), not '{}'",
                  csg::kLeastSupportTip, csg::kGreatestSupportTip, word));
  sizes.tip = *tip;
  return sizes;
}

compiler::Request to_request(const DesignOptions& options, std::string name) {
  require(options.parameter_file.empty() == options.parameter_set.empty(),
          "parameter_file and parameter_set need each other");
  require(options.values.empty() || options.parameter_set.empty(),
          "values stand in the place of parameter_set");
  compiler::Request request;
  request.design.path = std::move(name);
  for (const std::string& definition : options.definitions) {
    request.design.definitions += definition + ";\n";
  }
  request.design.parameter_file = options.parameter_file;
  request.design.parameter_set = options.parameter_set;
  if (!options.values.empty()) {
    ParameterSet& set = request.design.parameters.emplace();
    for (const auto& [key, value] : options.values) {
      set.push_back({key, value});
    }
    request.design.misfit = Misfit::kError;
  }
  request.geometry.chordal_error = options.chordal_error;
  request.geometry.scale = Vec3(options.scale);
  request.geometry.axis = options.axis;
  request.geometry.is_placed_on_bed = options.place_on_bed;
  request.design.language = options.language;
  request.design.seed = options.seed;
  request.design.max_depth = options.max_depth;
  request.design.max_leaves = options.max_leaves;
  request.design.module_folder = options.module_folder;
  request.supports = to_supports(options);
  if (options.has_sprue) request.sprues.emplace();
  if (options.hollow != 0) request.hollow = {.wall = options.hollow};
  request.job.layer_thickness = options.layer_thickness;
  request.output.printer = options.printer;
  request.output.material = options.material;
  request.output.metal = options.metal;
  for (const std::string& words : options.prices) {
    const auto price = slicer::parse_price(words);
    require(price.has_value(),
            fmt::format("prices: expected such as 62.5/g or 60 EUR/l, not '{}'",
                        words));
    request.output.prices.push_back(*price);
  }
  require_valid(request);
  return request;
}

slicer::Settings to_settings(const SliceOptions& options,
                             slicer::Settings settings) {
  settings.layer_thickness = options.layer_thickness;
  settings.cusp = options.adaptive;
  settings.greatest_thickness = options.max_layer;
  settings.heights = options.heights;
  settings.tolerance = options.tolerance;
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

Point to_point(Vec2 place) { return {place.x, place.y}; }

// The lines of the design that made it; empty where they are not known.
std::string source_line_at(const std::vector<std::string>& source_lines,
                           std::size_t i) {
  return i < source_lines.size() ? source_lines[i] : std::string();
}

std::vector<ThinPlace> to_places(const compiler::Inspection& inspection) {
  const auto source_lines = compiler::texts_of(inspection.lines.features);
  std::vector<ThinPlace> places;
  for (const slicer::ThinFeature& feature : inspection.found.features) {
    places.push_back({feature.kind == slicer::ThinKind::kWall, feature.width,
                      to_point(feature.place), feature.section_z,
                      feature.bottom, feature.top,
                      source_line_at(source_lines, places.size())});
  }
  return places;
}

std::vector<Finding> to_findings(const compiler::Inspection& inspection) {
  std::vector<Finding> findings;
  if (!inspection.found.print) return findings;
  const auto source_lines = compiler::texts_of(inspection.lines.findings);
  for (const slicer::Finding& found : inspection.found.print->findings) {
    findings.push_back({static_cast<Finding::Kind>(found.kind), found.is_minor,
                        found.first_layer, found.last_layer, found.bottom,
                        found.top, to_point(found.place), found.section_z,
                        found.area, found.volume, found.distance,
                        source_line_at(source_lines, findings.size())});
  }
  return findings;
}

Inspection to_inspection(const compiler::Inspection& inspection) {
  const slicer::Inspection& found = inspection.found;
  Inspection all;
  all.format = found.file.format;
  all.writer = found.file.writer;
  for (const auto& [bottom, thickness, of, perimeter] : found.layers) {
    all.layers.push_back({bottom, thickness, of.loops, of.holes, of.vertices,
                          of.area, perimeter});
  }
  all.volume = found.volume;
  all.defects = found.defects;
  all.reported_defects = found.reported_defects;
  all.thin_places = to_places(inspection);
  all.findings = to_findings(inspection);
  return all;
}

Remark to_remark(const std::string& message, SourceRange range) {
  Remark remark{message, "", 0, 0};
  if (!range.is_written() || range.is_defined_by_option()) return remark;
  const LineColumn place = range.source->line_column(range.begin);
  remark.file = shown_path(range.source->path());
  remark.line = place.line;
  remark.column = place.column;
  return remark;
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
      if (errors_.empty()) keep(diagnostic);
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

  [[noreturn]] void fail() const { throw DesignError(errors_, fault_, calls_); }

 private:
  void keep(const Diagnostic& diagnostic) {
    fault_ = to_remark(diagnostic.message, diagnostic.range);
    for (const Note& note : diagnostic.notes) {
      calls_.push_back(to_remark(note.message, note.range));
    }
  }

  std::function<void(std::string_view)> show_;
  std::string errors_;
  Remark fault_;  // the first of them
  std::vector<Remark> calls_;
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
  State(const DesignOptions& its_options, compiler::Request its_request)
      : options(its_options),
        show(options.show),
        messages(show),
        access(to_access(options)),
        temporary_files(access),
        request(std::move(its_request)),
        compilation(request, temporary_files,
                    [this](const Diagnostic& d) { messages.take(d); }) {
    compilation.evaluation_stack = options.stack;
  }

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
      state->compilation.report.machine =
          compiler::choose_machine(state->request.output, state->access);
      state->lowered = compiler::lower_tree(state->compilation);
    });
    for (const CustomizerEntry& entry :
         list_parameters(state->compilation.design.program)) {
      state->parameters.push_back(to_parameter(entry));
    }
    return state;
  }

  // The request with the options of a job, which are refused where the program
  // refuses them.
  compiler::Request with_job(const SliceOptions& wanted) const {
    compiler::Request asked = request;
    asked.job = to_settings(wanted, request.job);
    if (wanted.compensation != 0) {
      asked.compensation.contour = wanted.compensation;
    }
    require_valid(asked);
    return asked;
  }

  // The passes from the scene to layers. Several threads may call it.
  slicer::SliceReport slice(const compiler::Request& asked,
                            const compiler::Machine& machine,
                            slicer::LayerSink& sink,
                            Diagnostics& diagnostics) const {
    const slicer::Settings settings = compiler::settings_of(asked, machine);
    return compiler::slice(lowered, compiler::plan(lowered, settings), settings,
                           sink, {}, diagnostics);
  }

  void slice(const SliceOptions& wanted, slicer::LayerSink& sink) const {
    const compiler::Request asked = with_job(wanted);
    Messages shown(show);
    shown.run([&](Diagnostics& diagnostics) {
      slice(asked, compilation.report.machine, sink, diagnostics);
    });
  }

  compiler::Inspection look(const compiler::Request& asked,
                            const compiler::LookOptions& wanted) const {
    require_valid(asked);
    const compiler::Machine& machine = compilation.report.machine;
    Messages shown(show);
    return shown.run([&](Diagnostics& diagnostics) {
      return compiler::look_at_design(
          lowered,
          compiler::plan(lowered, compiler::settings_of(asked, machine)), asked,
          machine, wanted, {}, diagnostics);
    });
  }

  // What `tell` says of the compilation, as if it had been made for `asked`.
  template <typename Tell>
  std::string tell_of(const compiler::Request& asked, const Tell& tell) const {
    const std::lock_guard lock(telling);
    compilation.request.job = asked.job;
    compilation.request.compensation = asked.compensation;
    return tell(compilation);
  }

  DesignOptions options;
  std::function<void(std::string_view)> show;
  Messages messages;
  FileAccess access;
  TemporaryFiles temporary_files;
  compiler::Request request;
  mutable std::mutex telling;  // what the compilation was asked for
  mutable compiler::Compilation compilation;
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

Design Design::with(const ParameterValues& values) const {
  DesignOptions options = state_->options;
  for (const auto& value : values) {
    std::erase_if(options.values, [&](const auto& other) {
      return other.first == value.first;
    });
    options.values.push_back(value);
  }
  const compiler::DesignRequest& design = state_->request.design;
  return design.text ? from_text(*design.text, options, design.path)
                     : from_file(design.path, options);
}

std::vector<Layer> Design::slice(const SliceOptions& options) const {
  KeepingSink sink;
  state_->slice(options, sink);
  return std::move(sink.layers);
}

void Design::slice(const SliceOptions& options,
                   const std::function<void(const Layer&)>& take) const {
  CallingSink sink(take);
  state_->slice(options, sink);
}

void Design::write(const std::string& path, const SliceOptions& options,
                   const ImageOptions& images) const {
  compiler::Request request = state_->with_job(options);
  request.output.path = path;
  if (!images.printer.empty()) request.output.printer = images.printer;
  request.output.mirrors_x = images.mirror_x;
  request.output.mirrors_y = images.mirror_y;
  const slicer::FormatChoice choice = slicer::choose_output_format(path);
  if (!choice.format) fail(choice.complaint);
  request.output.format = *choice.format;
  require(slicer::is_of_layers(request.output.format),
          fmt::format("'{}' asks for no format of layers", path));
  require_valid(request);
  Messages messages(state_->show);
  messages.run([&](Diagnostics& diagnostics) {
    state_->access.run_files()->require_unread(
        path, state_->access.look_at(path), state_->access);
    TemporaryFiles temporary_files(state_->access);
    compiler::Report report;
    report.machine = compiler::choose_machine(request.output, state_->access);
    compiler::LayerOutput output = compiler::LayerOutput::open(
        request, report.machine, temporary_files, diagnostics);
    report.slice =
        state_->slice(request, report.machine, output.sink(), diagnostics);
    output.finish(diagnostics, report);
  });
}

std::vector<ThinPlace> Design::find_thin_places(
    double width, const SliceOptions& options) const {
  const compiler::NumberLimits& limits = compiler::limits_of("--min-feature");
  require(limits.hold(width),
          "width " + limits.fault_of(fmt::format("{}", width)));
  compiler::Request request = state_->with_job(options);
  request.job.min_feature = width;
  return to_places(state_->look(request, {}));
}

std::vector<Finding> Design::check(const SliceOptions& options,
                                   double self_supporting) const {
  compiler::Request request = state_->with_job(options);
  require(options.heights.empty(), "check needs whole layers, not heights");
  request.job.print.self_supporting = self_supporting;
  request.job.finds_makers = true;
  return to_findings(state_->look(request, {}));
}

Inspection Design::inspect(const SliceOptions& options,
                           const InspectOptions& wanted) const {
  compiler::Request request = state_->with_job(options);
  request.job.print.self_supporting = wanted.self_supporting;
  request.job.finds_makers = true;
  request.job.min_feature = wanted.min_feature;
  return to_inspection(state_->look(request, {.finds_defects = true}));
}

std::string Design::report(const SliceOptions& options,
                           const InspectOptions& wanted) const {
  compiler::Request request = state_->with_job(options);
  request.job.print.self_supporting = wanted.self_supporting;
  request.job.finds_makers = true;
  request.job.min_feature = wanted.min_feature;
  const compiler::Inspection inspection = state_->look(request, {});
  return state_->tell_of(request, [&](const compiler::Compilation& made) {
    return compiler::quote_json(made, inspection).dump();
  });
}

std::string Design::page(const SliceOptions& options) const {
  compiler::Request request = state_->with_job(options);
  request.job.finds_makers = true;
  const compiler::Inspection inspection = state_->look(
      request,
      {.makes_graph = true, .keeps_layers = true, .keeps_colors = true});
  require(std::ranges::any_of(inspection.layers,
                              [](const slicer::Layer& layer) {
                                return !layer.contours.points.empty();
                              }),
          "there is no contour");
  const std::string title =
      std::filesystem::path(request.design.path).filename();
  return state_->tell_of(request, [&](const compiler::Compilation& made) {
    return slicer::viewer_page(
        inspection.layers, compiler::viewer_options(made, inspection, title));
  });
}

std::vector<Support> Design::supports() const {
  std::vector<Support> all;
  const auto& plan = state_->compilation.report.supports;
  if (!plan) return all;
  for (const slicer::Support& support : plan->supports) {
    const Vec3 contact = support.contact;
    all.push_back({{contact.x, contact.y},
                   contact.z,
                   support.tip,
                   support.end == slicer::SupportEnd::kFoot,
                   support.holds});
  }
  return all;
}

Inspection inspect_file(const std::string& path, const InspectOptions& wanted) {
  compiler::Request request;
  request.job.print.self_supporting = wanted.self_supporting;
  request.job.min_feature = wanted.min_feature;
  require_valid(request);
  Messages messages(nullptr);
  return messages.run([&](Diagnostics&) {
    return to_inspection(compiler::look_at_file(
        path, {.finds_defects = true, .min_feature = wanted.min_feature},
        request.job.print, kAllFiles));
  });
}

const std::vector<Parameter>& Design::parameters() const {
  return state_->parameters;
}

}  // namespace lamina
