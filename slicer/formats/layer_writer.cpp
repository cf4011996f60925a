#include "slicer/formats/layer_writer.h"

#include "base/check.h"
#include "slicer/formats/detail/cli_writer.h"
#include "slicer/formats/detail/image_stack_writer.h"
#include "slicer/formats/detail/layers_json_writer.h"
#include "slicer/formats/detail/slc_writer.h"
#include "slicer/formats/detail/svg_writer.h"
#include "slicer/formats/detail/threemf_writer.h"

namespace lamina::slicer {

std::unique_ptr<LayerWriter> make_layer_writer(const WriterOptions& options,
                                               const std::string& path,
                                               TemporaryFiles& files) {
  switch (options.format) {
    case OutputFormat::kSlc:
      return std::make_unique<SlcWriter>(path, files, options.deviation);
    case OutputFormat::kCli:
      return std::make_unique<CliWriter>(path, files, options.cli);
    case OutputFormat::kSvg:
      return std::make_unique<SvgWriter>(path, files);
    case OutputFormat::kThreemf:
      return std::make_unique<ThreemfWriter>(path, files, options.deviation);
    case OutputFormat::kPng:
    case OutputFormat::kSl1:
    case OutputFormat::kNanoDlp:
      return std::make_unique<ImageStackWriter>(options.format, options.panel,
                                                path, files);
    default:
      break;
  }
  LAMINA_CHECK_EQ(static_cast<int>(options.format),
                  static_cast<int>(OutputFormat::kLayersJson));
  return std::make_unique<LayersJsonWriter>(path, files);
}

}  // namespace lamina::slicer
