#include "compiler/tasks/compared.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/check.h"
#include "compiler/compile.h"
#include "compiler/look_at.h"
#include "plane/loop_area.h"
#include "slicer/contour/compensate.h"
#include "slicer/contour/deviation.h"
#include "slicer/formats/layer_reader.h"

namespace lamina::compiler {
namespace {

using slicer::Layer;

// What is assumed of files that do not say their precision: the default of
// --tolerance [mm].
const double kUsualSimplification = slicer::Settings().tolerance;

// OpenSCAD unites and offsets outlines on a grid of 2^-16 mm.
constexpr double kOpenScadGrid = 1.0 / 65536;

class ComparedFile : public Compared {
 public:
  ComparedFile(std::string path, const FileAccess& access)
      : path_(std::move(path)), file_access_(access) {}

  const std::string& name() const override { return path_; }

  const std::vector<Layer>& layers() override {
    if (!file_) {
      file_ = look_at_file(path_, {.makes_graph = false, .keeps_layers = true},
                           {}, file_access_);
    }
    return file_->layers;
  }

  bool has_sides() const override { return file_->found.file.has_sides; }

  SideText text() const override {
    const slicer::Inspection& found = file_->found;
    const slicer::LayerFileFacts& facts = found.file;
    SideText text;
    text.name = path_;
    text.description = facts.format;
    if (!facts.writer.empty()) text.description += " by " + facts.writer;
    const std::string left_out = slicer::left_out_text(facts);
    if (!left_out.empty()) text.description += ", left out: " + left_out;
    slicer::Deviation usual;
    usual.simplification = kUsualSimplification;
    text.precision = facts.deviation.value_or(usual.from_section());
    if (facts.is_float32) {
      text.precision += slicer::float32_rounding(found.greatest_coordinate);
    }
    text.is_assumed = !facts.deviation;
    return text;
  }

 private:
  const std::string path_;
  const FileAccess& file_access_;
  std::optional<Inspection> file_;
};

// How far a mesh with this greatest coordinate rounds the coordinates of the
// design that it came from [mm].
using Rounding = double (*)(double greatest);

double no_rounding(double /*greatest*/) { return 0; }

double openscad_rounding(double greatest) {
  return kOpenScadGrid + slicer::float32_rounding(greatest);
}

class ComparedDesign : public Compared {
 public:
  ComparedDesign(std::string name, std::string description, Rounding rounding,
                 Compilation& compilation)
      : name_(std::move(name)),
        description_(std::move(description)),
        rounding_(rounding),
        compilation_(compilation) {}

  const std::string& name() const override { return name_; }

  const std::vector<Layer>& layers() override {
    if (!layers_) layers_ = sliced(settings());
    return *layers_;
  }

  bool can_be_cut() const override { return true; }

  std::vector<Layer> cut(const std::vector<double>& heights) override {
    if (heights.empty()) return {};
    slicer::Settings at_heights = settings();
    at_heights.heights = heights;
    return sliced(at_heights);
  }

  SideText text() const override {
    const slicer::Settings job = settings();
    slicer::Deviation deviation;
    deviation.simplification = job.tolerance;
    if (slicer::moves_contours(job)) {
      deviation.compensation = slicer::kArcTolerance;
    }
    deviation.rounding = rounding_(greatest_coordinate_);
    return {name_, description_, deviation.from_section()};
  }

 private:
  slicer::Settings settings() const {
    return settings_of(compilation_.request, compilation_.report.machine);
  }

  std::vector<Layer> sliced(const slicer::Settings& settings) {
    slicer::LayerList list;
    try {
      if (!lowered_) lowered_ = make_geometry(compilation_);
      if (!lowered_) throw Error(compilation_.diagnostics.all().back());
      make_layers(compilation_, *lowered_, settings, list);
    } catch (const InternalError&) {
      throw;
    } catch (const Error& error) {
      if (!is_among(compilation_.diagnostics, error.diagnostic())) {
        compilation_.diagnostics.report(error.diagnostic());
      }
      throw;
    }
    for (const Layer& layer : list.layers) {
      greatest_coordinate_ = std::max(
          greatest_coordinate_, greatest_coordinate(layer.contours.points));
    }
    return std::move(list.layers);
  }

  const std::string name_;
  const std::string description_;
  const Rounding rounding_;
  Compilation& compilation_;
  std::optional<csg::Lowered> lowered_;
  std::optional<std::vector<Layer>> layers_;
  double greatest_coordinate_ = 0;
};

}  // namespace

std::vector<Layer> Compared::cut(const std::vector<double>& /*heights*/) {
  LAMINA_CHECK_EQ(can_be_cut(), true);
  return {};
}

bool can_compare(const std::string& path) {
  return is_design(path) || is_imported(path) ||
         slicer::is_readable_layer_file(path);
}

Request request_of_side(const std::string& path, const Request& request) {
  Request own = request;
  own.design.path = path;
  // Outlines can be compared, too, as files of layers hold them.
  own.output.format = slicer::OutputFormat::kLayersJson;
  if (!is_imported(path)) return own;
  own.design.definitions.clear();
  own.design.parameter_file.clear();
  own.design.parameter_set.clear();
  own.geometry.chordal_error = 0;
  return own;
}

std::unique_ptr<Compared> open_compared(Compilation& compilation) {
  const std::string& path = compilation.request.design.path;
  if (holds_layers(path, compilation.file_access())) {
    return std::make_unique<ComparedFile>(path, compilation.file_access());
  }
  const Rounding rounding =
      slicer::is_named(path, ".stl") ? slicer::float32_rounding : no_rounding;
  return std::make_unique<ComparedDesign>(
      path, is_imported(path) ? "mesh" : "design", rounding, compilation);
}

std::unique_ptr<Compared> open_openscad_mesh(Compilation& compilation,
                                             std::string description) {
  return std::make_unique<ComparedDesign>("openscad", std::move(description),
                                          openscad_rounding, compilation);
}

}  // namespace lamina::compiler
