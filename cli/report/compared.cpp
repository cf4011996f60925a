#include "cli/report/compared.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/check.h"
#include "cli/process/exit_status.h"
#include "cli/process/openscad.h"
#include "cli/report/session.h"
#include "compiler/compile.h"
#include "compiler/request.h"
#include "plane/loop_area.h"
#include "slicer/contour/compensate.h"
#include "slicer/contour/deviation.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {
namespace {

using slicer::Layer;

// What is assumed of files that do not say their precision: the default of
// --tolerance [mm].
const double kUsualSimplification = slicer::Settings().tolerance;

// OpenSCAD unites and offsets outlines on a grid of 2^-16 mm.
constexpr double kOpenScadGrid = 1.0 / 65536;

double greatest_coordinate(const std::vector<Layer>& layers) {
  double greatest = 0;
  for (const Layer& layer : layers) {
    greatest =
        std::max(greatest, lamina::greatest_coordinate(layer.contours.points));
  }
  return greatest;
}

class ComparedFile : public Compared {
 public:
  ComparedFile(const std::string& path, const FileAccess& access)
      : Compared(path), file_access_(access) {}

  const std::vector<Layer>& layers() override {
    if (!layers_) {
      layers_.emplace();
      facts_ = slicer::read_layers(
          name(), [&](Layer& layer) { layers_->push_back(std::move(layer)); },
          file_access_);
      description_ =
          facts_.writer.empty()
              ? facts_.format
              : fmt::format("{} by {}", facts_.format, facts_.writer);
      const std::string left_out = slicer::left_out_text(facts_);
      if (!left_out.empty()) description_ += ", left out: " + left_out;
    }
    return *layers_;
  }

  bool has_sides() const override { return facts_.has_sides; }

  double precision() const override {
    slicer::Deviation deviation;
    deviation.simplification = kUsualSimplification;
    const double rounding =
        facts_.is_float32
            ? slicer::float32_rounding(greatest_coordinate(*layers_))
            : 0;
    return facts_.deviation.value_or(deviation.from_section()) + rounding;
  }
  bool is_precision_assumed() const override { return !facts_.deviation; }

 private:
  const FileAccess& file_access_;
  slicer::LayerFileFacts facts_;
  std::optional<std::vector<Layer>> layers_;
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
  ComparedDesign(std::string name, std::string description,
                 compiler::Request request, Rounding rounding, bool is_quiet,
                 const Context& context)
      : Compared(std::move(name), std::move(description)),
        request_(std::move(request)),
        rounding_(rounding),
        session_(request_, is_quiet, context) {}

  const std::vector<Layer>& layers() override {
    if (!layers_) layers_ = sliced(request_.job);
    return *layers_;
  }

  bool can_be_cut() const override { return true; }

  std::vector<Layer> cut(const std::vector<double>& heights) override {
    if (heights.empty()) return {};
    slicer::Settings settings = request_.job;
    settings.heights = heights;
    return sliced(settings);
  }

  double precision() const override {
    slicer::Deviation deviation;
    deviation.simplification = request_.job.tolerance;
    if (request_.job.compensation != 0) {
      deviation.compensation = slicer::kArcTolerance;
    }
    deviation.rounding = rounding_(greatest_coordinate_);
    return deviation.from_section();
  }

 private:
  std::vector<Layer> sliced(const slicer::Settings& settings) {
    compiler::LayerList list;
    const int status = session_.run([&] {
      compiler::Compilation& compilation = session_.compilation;
      if (!lowered_) lowered_ = compiler::make_geometry(compilation);
      if (!lowered_) return kFault;
      compiler::make_layers(compilation, *lowered_, settings, list);
      return kDone;
    });
    if (status != kDone) throw ShownFault();
    greatest_coordinate_ =
        std::max(greatest_coordinate_, greatest_coordinate(list.layers));
    return std::move(list.layers);
  }

  const compiler::Request request_;
  const Rounding rounding_;
  Session session_;
  std::optional<csg::Lowered> lowered_;
  std::optional<std::vector<Layer>> layers_;
  double greatest_coordinate_ = 0;
};

bool is_design(const std::string& path) {
  return slicer::is_named(path, ".scad") || slicer::is_named(path, ".csg");
}

// Outlines can be compared, too, as files of layers hold them.
compiler::Request design_request(const std::string& path,
                                 const compiler::Request& request) {
  compiler::Request own = request;
  own.design.path = path;
  own.output.format = slicer::OutputFormat::kLayersJson;
  return own;
}

// The part of the request that means something for a mesh.
compiler::Request mesh_request(const std::string& path,
                               const compiler::Request& request) {
  compiler::Request own = design_request(path, request);
  own.design.definitions.clear();
  own.design.parameter_file.clear();
  own.design.parameter_set.clear();
  own.geometry.chordal_error = 0;
  return own;
}

}  // namespace

std::vector<Layer> Compared::cut(const std::vector<double>& /*heights*/) {
  LAMINA_CHECK_EQ(can_be_cut(), true);
  return {};
}

bool can_compare(const std::string& path) {
  return is_design(path) || compiler::is_imported(path) ||
         slicer::is_readable_layer_file(path);
}

std::unique_ptr<Compared> open_compared(const std::string& path,
                                        const compiler::Request& request,
                                        bool is_quiet, const Context& context) {
  if (slicer::is_readable_layer_file(path, context.file_access())) {
    return std::make_unique<ComparedFile>(path, context.file_access());
  }
  if (compiler::is_imported(path)) {
    const Rounding rounding =
        slicer::is_named(path, ".stl") ? slicer::float32_rounding : no_rounding;
    return std::make_unique<ComparedDesign>(
        path, "mesh", mesh_request(path, request), rounding, is_quiet, context);
  }
  return std::make_unique<ComparedDesign>(path, "design",
                                          design_request(path, request),
                                          no_rounding, is_quiet, context);
}

std::unique_ptr<Compared> open_openscad(const std::string& design,
                                        const compiler::Request& request,
                                        const std::string& version,
                                        double time_limit, bool is_quiet,
                                        const Context& context) {
  const ScratchFolder folder(context.temporary_files);
  const OpenScadMesh rendered =
      render_with_openscad(design_request(design, request), time_limit, folder);
  auto mesh = std::make_unique<ComparedDesign>(
      "openscad",
      fmt::format("{}, rendered in {:.1f} s", version, rendered.seconds),
      mesh_request(rendered.path, request), openscad_rounding, is_quiet,
      context);
  // Has it read while it is there.
  mesh->cut({0});
  return mesh;
}

}  // namespace lamina::cli
