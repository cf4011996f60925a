#include "cli/options/contradictions.h"

#include "cli/process/exit_status.h"
#include "compiler/request.h"
#include "slicer/formats/layer_reader.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {
void refuse_contradictions(const slicer::Settings& settings) {
  const bool is_paper = settings.contour == slicer::ContourMode::kPaper;
  refuse_if(settings.min_feature > 0 && is_paper,
            "--min-feature needs --contour faithful");
  refuse_if(settings.paper.boxes == ldni::BoxMode::kGlobal && !is_paper,
            "--boxes global needs --contour paper");
  const bool is_adaptive = settings.cusp > 0;
  const bool has_heights = !settings.heights.empty();
  refuse_if(is_adaptive && has_heights,
            "--adaptive and --heights say different things");
  refuse_if(settings.greatest_thickness > 0 && !is_adaptive,
            "--max-layer needs --adaptive");
  refuse_if(settings.greatest_thickness > 0 &&
                settings.greatest_thickness < settings.layer_thickness,
            "--max-layer must not be less than --layer");
  const bool is_drawn = settings.paper.sampler != ldni::SamplerKind::kScanline;
  refuse_if(is_drawn && !is_paper,
            "--sampler gl and gl-peeling need --contour paper");
  refuse_if(is_drawn && (is_adaptive || has_heights),
            "--sampler gl and gl-peeling need layers of one thickness, not "
            "--heights or --adaptive");
}

void refuse_misfits(const compiler::Request& request, bool has_report) {
  using enum slicer::OutputFormat;
  const slicer::OutputFormat format = request.output.format;
  const slicer::Settings& settings = request.job;
  const bool has_layers = slicer::is_of_layers(format);
  refuse_if(!has_layers && has_report, "--report needs layers");
  refuse_if(!has_layers && settings.min_feature > 0,
            "--min-feature needs layers");
  const bool has_images = slicer::is_of_images(format);
  refuse_if(!has_layers && !request.output.printer.empty(),
            "--printer needs layers");
  refuse_if(!has_layers && !request.output.material.empty(),
            "--material needs layers");
  refuse_if(
      !has_images && (request.output.mirrors_x || request.output.mirrors_y),
      "--mirror needs images: .png, .sl1 or .zip");
  refuse_if(request.output.cli_encoding && format != kCli,
            "--cli needs .cli output");
  const bool is_archive = format == kSl1 || format == kNanoDlp;
  const bool has_heights = !settings.heights.empty();
  refuse_if(is_archive && (settings.cusp > 0 || has_heights),
            ".sl1 and .zip need layers of one thickness, not --heights or "
            "--adaptive");
  refuse_if(format == kThreemf && has_heights,
            ".3mf needs layers, not --heights");
}

void require_readable(std::string_view command, const std::string& file) {
  refuse_if(slicer::is_named_as_layers(file) && !compiler::is_imported(file) &&
                !slicer::is_readable_layer_file(file),
            "{} reads files of layers, folders of images, designs and meshes; "
            "not '{}'",
            command, file);
}

void refuse_design_option(const std::string& option, const std::string& file) {
  refuse_if(!option.empty(), "{} needs a design; '{}' holds layers", option,
            file);
}

}  // namespace lamina::cli
