#include "slicer/formats/detail/layers_json_writer.h"

#include <span>

#include "base/file/text_output.h"

namespace lamina::slicer {
namespace {

void write_loop(OutputFile& output, std::span<const Vec2> loop) {
  const bool is_hole = ldni::signed_area(loop) < 0;
  print(output, FMT_COMPILE("{{\"hole\":{},\"points\":["), is_hole);
  for (std::size_t i = 0; i < loop.size(); ++i) {
    if (i != 0) output.write(",");
    print(output, FMT_COMPILE("[{},{}]"), loop[i].x, loop[i].y);
  }
  output.write("]}");
}

}  // namespace

LayersJsonWriter::LayersJsonWriter(const std::string& path,
                                   TemporaryFiles& temporary_files)
    : FileWriter(path, temporary_files) {
  output_.write("{\"units\":\"mm\",\"layers\":[");
}

void LayersJsonWriter::take(const Layer& layer) {
  output_.write(has_layers_ ? ",\n" : "\n");
  has_layers_ = true;
  print(output_,
        FMT_COMPILE("{{\"z\":{},\"bottom\":{},\"top\":{},\"contours\":["),
        layer.section_z, layer.bottom, layer.top);
  for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
    if (i != 0) output_.write(",");
    write_loop(output_, layer.contours.loop(i));
  }
  output_.write("]}");
}

void LayersJsonWriter::finish(Diagnostics& /*diagnostics*/) {
  output_.write("\n]}\n");
}

}  // namespace lamina::slicer
