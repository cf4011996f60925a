#include "slicer/formats/layer_writer.h"

#include "parser/check.h"
#include "slicer/formats/layers_json_writer.h"
#include "slicer/formats/slc_writer.h"

namespace lamina::slicer {

std::unique_ptr<LayerWriter> make_layer_writer(
    OutputFormat format, OutputFile& output, std::optional<double> deviation) {
  if (format == OutputFormat::kSlc)
    return std::make_unique<SlcWriter>(output, deviation);
  LAMINA_CHECK_EQ(static_cast<int>(format),
                  static_cast<int>(OutputFormat::kLayersJson));
  return std::make_unique<LayersJsonWriter>(output);
}

}  // namespace lamina::slicer
