#include "slicer/formats/layer_writer.h"

#include "parser/check.h"
#include "slicer/formats/cli_writer.h"
#include "slicer/formats/layers_json_writer.h"
#include "slicer/formats/slc_writer.h"
#include "slicer/formats/svg_writer.h"

namespace lamina::slicer {

std::unique_ptr<LayerWriter> make_layer_writer(const WriterOptions& options,
                                               OutputFile& output) {
  switch (options.format) {
    case OutputFormat::kSlc:
      return std::make_unique<SlcWriter>(output, options.deviation);
    case OutputFormat::kCli:
      return std::make_unique<CliWriter>(output, options.cli);
    case OutputFormat::kSvg:
      return std::make_unique<SvgWriter>(output);
    default:
      break;
  }
  LAMINA_CHECK_EQ(static_cast<int>(options.format),
                  static_cast<int>(OutputFormat::kLayersJson));
  return std::make_unique<LayersJsonWriter>(output);
}

}  // namespace lamina::slicer
