#include "slicer/formats/layer_writer.h"

#include "base/check.h"
#include "slicer/formats/detail/writers.h"

namespace lamina::slicer {
namespace {

MakeLayerWriter* writer_for(OutputFormat format) {
  switch (format) {
    case OutputFormat::kSlc:
      return make_slc_writer;
    case OutputFormat::kCli:
      return make_cli_writer;
    case OutputFormat::kSvg:
      return make_svg_writer;
    case OutputFormat::kThreemf:
      return make_threemf_writer;
    case OutputFormat::kGoo:
      return make_goo_writer;
    case OutputFormat::kCtb:
      return make_ctb_writer;
    case OutputFormat::kPng:
    case OutputFormat::kSl1:
    case OutputFormat::kNanoDlp:
      return make_image_stack_writer;
    default:
      LAMINA_CHECK_EQ(static_cast<int>(format),
                      static_cast<int>(OutputFormat::kLayersJson));
      return make_layers_json_writer;
  }
}

}  // namespace

std::unique_ptr<LayerWriter> make_layer_writer(const WriterOptions& options,
                                               const std::string& path,
                                               TemporaryFiles& files) {
  return writer_for(options.format)(options, path, files);
}

}  // namespace lamina::slicer
