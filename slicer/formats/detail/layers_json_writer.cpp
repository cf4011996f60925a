// Writes `.layers.json`: the layers for programs and tests, with every digit.
//
//   {"units":"mm","layers":[
//   {"z":…,"bottom":…,"top":…,"contours":[{"hole":false,"points":[[x,y],…]}]}
//   ]}
//
// z is the height of the section. Each layer has a line of its own; numbers are
// the shortest that read back as the same double.

#include <span>

#include "plane/loop_area.h"
#include "slicer/formats/detail/text_output.h"
#include "slicer/formats/detail/writers.h"

namespace lamina::slicer {
namespace {

class LayersJsonWriter : public FileWriter {
 public:
  LayersJsonWriter(const std::string& path, TemporaryFiles& temporary_files)
      : FileWriter(path, temporary_files) {
    output_.write("{\"units\":\"mm\",\"layers\":[");
  }

  void take(const Layer& layer) override {
    output_.write(has_layers_ ? ",\n" : "\n");
    has_layers_ = true;
    print(output_,
          FMT_COMPILE("{{\"z\":{},\"bottom\":{},\"top\":{},\"contours\":["),
          layer.section_z, layer.bottom, layer.top);
    for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
      if (i != 0) output_.write(",");
      write_loop(layer.contours.loop(i));
    }
    output_.write("]}");
  }

  void finish(Diagnostics& /*diagnostics*/) override {
    output_.write("\n]}\n");
  }

 private:
  void write_loop(std::span<const Vec2> loop) {
    const bool is_hole = signed_area(loop) < 0;
    print(output_, FMT_COMPILE("{{\"hole\":{},\"points\":["), is_hole);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      if (i != 0) output_.write(",");
      print(output_, FMT_COMPILE("[{},{}]"), loop[i].x, loop[i].y);
    }
    output_.write("]}");
  }

  bool has_layers_ = false;
};

}  // namespace

std::unique_ptr<LayerWriter> make_layers_json_writer(
    const WriterOptions& /*options*/, const std::string& path,
    TemporaryFiles& temporary_files) {
  return std::make_unique<LayersJsonWriter>(path, temporary_files);
}

}  // namespace lamina::slicer
