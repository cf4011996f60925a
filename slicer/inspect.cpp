#include "slicer/inspect.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "ldni/contours.h"
#include "slicer/defects.h"
#include "slicer/deviation.h"
#include "slicer/feature_table.h"
#include "slicer/formats/slc_reader.h"
#include "slicer/thin_features.h"
#include "slicer/thin_finder.h"

namespace lamina::slicer {
namespace {

// Layers listed of a long file, and defects told of a bad one.
constexpr std::size_t kListedLayers = 24;
constexpr std::uint64_t kToldDefects = 20;

// A line of the layer table.
struct LayerLine {
  double z = 0;
  std::size_t loops = 0;
  std::size_t holes = 0;
  std::size_t vertices = 0;  // without the closing ones
  double area = 0;           // holes count negative
  double perimeter = 0;
  double greatest_coordinate = 0;  // |x| or |y|
};

LayerLine measure(const SlcLayer& layer) {
  LayerLine line;
  line.z = layer.z;
  line.loops = layer.boundaries.size();
  for (const SlcBoundary& boundary : layer.boundaries) {
    std::span<const Vec2> points = boundary.points;
    if (points.size() > 1 && points.front() == points.back()) {
      points = points.first(points.size() - 1);
    }
    const double area = ldni::signed_area(points);
    line.holes += area < 0 ? 1 : 0;
    line.vertices += points.size();
    line.area += area;
    line.perimeter += ldni::perimeter(points);
    for (const Vec2& point : points) {
      line.greatest_coordinate = std::max(
          {line.greatest_coordinate, std::abs(point.x), std::abs(point.y)});
    }
  }
  return line;
}

class Inspector {
 public:
  Inspector(const std::string& path, double min_feature)
      : path_(path), reader_(path), min_feature_(min_feature) {
    if (min_feature > 0) {
      finder_.emplace(min_feature);
      collector_.emplace(min_feature, std::vector<std::uint32_t>{});
    }
  }

  Inspection inspect(LayerList list) {
    print_header();
    SlcLayer layer;
    while (reader_.read_layer(layer)) take(layer);
    check_top();
    print_layers(list);
    print_totals();
    print_features();
    return {std::move(text_), defects_};
  }

 private:
  template <typename... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format,
                   std::forward<Values>(values)...);
  }

  template <typename... Values>
  void add_defect(fmt::format_string<Values...> format, Values&&... values) {
    if (++defects_ > kToldDefects) return;
    fmt::format_to(std::back_inserter(told_defects_), "  ");
    fmt::format_to(std::back_inserter(told_defects_), format,
                   std::forward<Values>(values)...);
    told_defects_ += '\n';
  }

  void print_header() {
    const SlcHeader& header = reader_.header();
    print("{}: SLC {}, {}, unit {}, written by {}\n", path_, header.version,
          header.type, header.unit,
          header.package.empty() ? "an unnamed program" : header.package);
    if (header.extents) {
      const auto& [x, y, z] = *header.extents;
      print(
          "extents   x {:.4f} … {:.4f}   y {:.4f} … {:.4f}   z {:.4f} … "
          "{:.4f}\n",
          x.x, x.y, y.x, y.y, z.x, z.y);
    }
    for (const SlcSampling& row : reader_.sampling()) {
      print("sampling  from z {}: layers of {}", row.min_z, row.thickness);
      if (row.line_width_compensation != 0) {
        print(", lines compensated by {}", row.line_width_compensation);
      }
      text_ += '\n';
    }
  }

  void take(const SlcLayer& layer) {
    if (!lines_.empty() && !(layer.z > lines_.back().z)) {
      add_defect("layer {} at z {}: not higher than the layer before",
                 lines_.size() + 1, layer.z);
    }
    lines_.push_back(measure(layer));
    volume_ += lines_.back().area * layer.thickness;
    for (const Defect& defect : find_defects(layer)) {
      add_defect("layer {} at z {}: loop {} {}, near x {} y {}", lines_.size(),
                 layer.z, defect.boundary + 1, describe(defect.kind),
                 defect.place.x, defect.place.y);
    }
    if (finder_) look_for_features(layer);
  }

  void look_for_features(const SlcLayer& slc_layer) {
    const Layer layer = to_layer(slc_layer);
    finder_->find(layer.contours, stretches_);
    collector_->take(layer, stretches_);
  }

  void print_features() {
    if (!collector_) return;
    text_ += '\n';
    text_ += feature_table(collector_->finish(), min_feature_, {});
  }

  void check_top() {
    if (!lines_.empty() && reader_.top() < lines_.back().z) {
      add_defect("the end record's top, z {}, lies below the last layer",
                 reader_.top());
    }
  }

  void print_layers(LayerList list) {
    if (lines_.empty()) return;
    const std::size_t count = lines_.size();
    const bool lists_all = list == LayerList::kAll || count <= kListedLayers;
    print("\n{:>7} {:>12} {:>7} {:>7} {:>9} {:>14} {:>14}\n", "layer", "z",
          "loops", "holes", "vertices", "area mm²", "perimeter mm");
    const std::size_t listed = lists_all ? count : kListedLayers;
    for (std::size_t i = 0; i < listed; ++i) {
      const std::size_t index = lists_all ? i : i * (count - 1) / (listed - 1);
      const LayerLine& line = lines_[index];
      print("{:>7} {:>12.6g} {:>7} {:>7} {:>9} {:>13.6f} {:>13.6f}\n",
            index + 1, line.z, line.loops, line.holes, line.vertices, line.area,
            line.perimeter);
    }
    if (!lists_all) {
      print("({} of {} layers; --all lists them all)\n", listed, count);
    }
  }

  void print_totals() {
    std::size_t loops = 0;
    std::size_t holes = 0;
    std::size_t vertices = 0;
    std::size_t empty = 0;
    double greatest_coordinate = 0;
    for (const LayerLine& line : lines_) {
      loops += line.loops;
      holes += line.holes;
      vertices += line.vertices;
      empty += line.loops == 0 ? 1 : 0;
      greatest_coordinate =
          std::max(greatest_coordinate, line.greatest_coordinate);
    }
    print("\nlayers    {}, {} of them empty; top of the part z {:.6g}\n",
          lines_.size(), empty, reader_.top());
    print("loops     {}, {} of them holes; {} vertices\n", loops, holes,
          vertices);
    print("volume    {:.6f} mm³\n", volume_);
    if (reader_.header().deviation) {
      print("deviation at most {:.6g} mm from the design's sections\n",
            *reader_.header().deviation);
    }
    print("rounding  at most {:.2g} mm of that, by 32-bit numbers\n",
          float32_rounding(greatest_coordinate));
    if (defects_ == 0) {
      print("defects   none\n");
      return;
    }
    print("defects   {}\n{}", defects_, told_defects_);
    if (defects_ > kToldDefects) {
      print("  … and {} more\n", defects_ - kToldDefects);
    }
  }

  const std::string& path_;
  SlcReader reader_;
  std::string text_;
  std::string told_defects_;
  std::uint64_t defects_ = 0;
  std::vector<LayerLine> lines_;
  double volume_ = 0;
  double min_feature_;
  std::optional<ThinFinder> finder_;
  std::optional<FeatureCollector> collector_;
  std::vector<ThinStretch> stretches_;
};

}  // namespace

Inspection inspect_slc(const std::string& path, LayerList list,
                       double min_feature) {
  return Inspector(path, min_feature).inspect(list);
}

}  // namespace lamina::slicer
