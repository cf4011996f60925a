// Writes 3MF with a stack of slices (Slice Extension 1.0.2; docs/formats.md).
//
// The package's XML goes straight into the archive, layer by layer, so memory
// does not grow with the design; a library that builds the whole model first
// would hold all layers (docs/decisions/0018-3mf-without-lib3mf.md). Every
// reader needs a mesh: the box of all layers, marked as too coarse to slice.
//
// Coordinates are float32 (float_writer.h), as common readers hold them.

#include <cstddef>
#include <iterator>
#include <string_view>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "base/file/zip_output.h"
#include "base/version.h"
#include "slicer/formats/detail/float_writer.h"
#include "slicer/formats/detail/reading.h"

namespace lamina::slicer {
namespace {

constexpr std::string_view kContentTypes =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
)";

constexpr std::string_view kRelationships =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" Target="/3D/3dmodel.model"/>
</Relationships>
)";

constexpr std::string_view kModelHead =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<model unit="millimeter" xml:lang="en-US" requiredextensions="s" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02" xmlns:s="http://schemas.microsoft.com/3dmanufacturing/slice/2015/07">
 <metadata name="Application">lamina {}</metadata>
 <resources>
)";

// The build places the object where the design has it.
constexpr std::string_view kModelEnd =
    R"( </resources>
 <build>
  <item objectid="2"/>
 </build>
</model>
)";

// Corner i of a box is high in x, y, z where bit 0, 1, 2 of i is set; seen from
// outside, triangles run counter-clockwise.
constexpr int kBoxTriangles[12][3] = {
    {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

// 0 is added because -0 has a sign in print.
float printed(float value) { return value + 0.0F; }

class ThreemfWriter : public FloatWriter {
 public:
  // deviation  as WriterOptions has it
  ThreemfWriter(const std::string& path, TemporaryFiles& temporary_files,
                std::optional<double> deviation)
      : FloatWriter("3MF", path, temporary_files),
        deviation_(deviation),
        archive_(output_) {
    archive_.add_text("[Content_Types].xml", kContentTypes);
    archive_.add_text("_rels/.rels", kRelationships);
  }

  // Throws FileError where two layers fall on the same float32 height.
  void take(const Layer& layer) override {
    if (!has_layers_) begin_stack(layer);
    check_rise(top_z_, layer.top);
    top_z_ = static_cast<float>(layer.top);
    contours_.take(layer);
    write_slice();
  }

 private:
  void begin_stack(const Layer& first) {
    has_layers_ = true;
    bottom_z_ = top_z_ = static_cast<float>(first.bottom);
    archive_.begin_text(kThreemfModel);
    archive_.write(fmt::format(fmt::runtime(kModelHead), version()));
    archive_.write(fmt::format("  <s:slicestack id=\"1\" zbottom=\"{}\">\n",
                               printed(bottom_z_)));
  }

  // Writes the layer that contours_ holds.
  void write_slice() {
    const float top = printed(top_z_);
    text_.clear();
    auto out = std::back_inserter(text_);
    const std::size_t loops = contours_.loop_count();
    if (loops == 0) {
      fmt::format_to(out, FMT_COMPILE("   <s:slice ztop=\"{}\"/>\n"), top);
      archive_.write(text_);
      return;
    }
    fmt::format_to(out, FMT_COMPILE("   <s:slice ztop=\"{}\">\n<s:vertices>\n"),
                   top);
    for (std::size_t i = 0; i < loops; ++i) {
      for (const FloatPoint& point : contours_.open_loop(i)) {
        fmt::format_to(out, FMT_COMPILE("<s:vertex x=\"{}\" y=\"{}\"/>\n"),
                       printed(point.x), printed(point.y));
      }
    }
    text_ += "</s:vertices>\n";
    std::size_t begin = 0;
    for (std::size_t i = 0; i < loops; ++i) {
      const std::size_t end = begin + contours_.open_loop(i).size();
      fmt::format_to(out, FMT_COMPILE("<s:polygon startv=\"{}\">\n"), begin);
      for (std::size_t vertex = begin + 1; vertex < end; ++vertex) {
        fmt::format_to(out, FMT_COMPILE("<s:segment v2=\"{}\"/>\n"), vertex);
      }
      // Back to the first one.
      fmt::format_to(out, FMT_COMPILE("<s:segment v2=\"{}\"/>\n</s:polygon>\n"),
                     begin);
      begin = end;
    }
    text_ += "   </s:slice>\n";
    archive_.write(text_);
  }

  // The object that refers to the stack, with the box of all layers as its
  // mesh.
  std::string object() const {
    std::string text =
        "  <object id=\"2\" type=\"model\" s:slicestackid=\"1\" "
        "s:meshresolution=\"lowres\"";
    auto out = std::back_inserter(text);
    if (deviation_) {
      fmt::format_to(out, " name=\"contours within {:.6g} mm\"",
                     *deviation_ + greatest_rounding());
    }
    text += ">\n   <mesh>\n    <vertices>\n";
    const FloatPoint low = contours_.low();
    const FloatPoint high = contours_.high();
    for (int corner = 0; corner < 8; ++corner) {
      fmt::format_to(out, "     <vertex x=\"{}\" y=\"{}\" z=\"{}\"/>\n",
                     printed((corner & 1) != 0 ? high.x : low.x),
                     printed((corner & 2) != 0 ? high.y : low.y),
                     printed((corner & 4) != 0 ? top_z_ : bottom_z_));
    }
    text += "    </vertices>\n    <triangles>\n";
    for (const auto& triangle : kBoxTriangles) {
      fmt::format_to(out, "     <triangle v1=\"{}\" v2=\"{}\" v3=\"{}\"/>\n",
                     triangle[0], triangle[1], triangle[2]);
    }
    return text + "    </triangles>\n   </mesh>\n  </object>\n";
  }

  void end_file() override {
    if (!has_layers_) begin_stack(Layer{});
    archive_.write("  </s:slicestack>\n");
    archive_.write(object());
    archive_.write(kModelEnd);
    archive_.end_entry();
    archive_.finish();
  }

  const std::optional<double> deviation_;
  ZipOutput archive_;
  std::string text_;  // of the slice that is being written
  bool has_layers_ = false;
  float bottom_z_ = 0;  // of the first layer
  float top_z_ = 0;     // of the last one
};

}  // namespace

std::unique_ptr<LayerWriter> make_threemf_writer(
    const WriterOptions& options, const std::string& path,
    TemporaryFiles& temporary_files) {
  return std::make_unique<ThreemfWriter>(path, temporary_files,
                                         options.deviation);
}

}  // namespace lamina::slicer
