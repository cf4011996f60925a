#include "slicer/picture/viewer_part.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "plane/loop_index.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/check/thin/thin_features.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/picture/detail/drawing.h"

namespace lamina::slicer {
namespace {

using Json = nlohmann::json;

constexpr double kMostSteps = 1 << 30;  // across the part

// Integers as bytes: 7 bits a byte, low ones first.
class IntegerStream {
 public:
  void add_count(std::uint64_t value) {
    for (; value >= 0x80; value >>= 7) {
      bytes_ += static_cast<char>(0x80 | (value & 0x7F));
    }
    bytes_ += static_cast<char>(value);
  }
  void add(std::int64_t value) {
    const auto bits = static_cast<std::uint64_t>(value);
    add_count(value < 0 ? ~(bits << 1) : bits << 1);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

// Writes points as steps from the point before.
class PointEncoder {
 public:
  PointEncoder(Vec2 origin, double step) : origin_(origin), step_(step) {}

  void add(IntegerStream& numbers, Vec2 place) {
    const std::int64_t x = std::llround((place.x - origin_.x) / step_);
    const std::int64_t y = std::llround((place.y - origin_.y) / step_);
    numbers.add(x - x_);
    numbers.add(y - y_);
    x_ = x;
    y_ = y;
  }

 private:
  Vec2 origin_;
  double step_;
  std::int64_t x_ = 0;
  std::int64_t y_ = 0;
};

// Leaves out digits that the page does not show.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// The places that the page lists and marks, as JSON: a row has kind, first and
// last layer, the layer to go to, x, y, how much around it belongs to it [mm],
// a text, and the index of what made it, or -1.
class PlaceList {
 public:
  explicit PlaceList(double step) : step_(step) {}

  // Adds what matters, ordered by kind.
  void add(const PrintCheck& print,
           const std::vector<std::string>& source_lines) {
    const std::vector<Finding>& findings = print.findings;
    std::vector<std::size_t> listed;
    for (std::size_t i = 0; i < findings.size(); ++i) {
      if (!findings[i].is_minor) listed.push_back(i);
    }
    std::ranges::stable_sort(listed, {},
                             [&](std::size_t i) { return findings[i].kind; });
    for (const std::size_t i : listed) {
      const Finding& finding = findings[i];
      const double reach =
          std::max(std::sqrt(finding.area) / 2, finding.distance);
      rows_.push_back({name_of(finding.kind), finding.first_layer,
                       finding.last_layer, finding.layer,
                       rounded(finding.place.x, step_),
                       rounded(finding.place.y, step_), rounded(reach, 1e-3),
                       size_text(finding), index_of(source_lines, i)});
    }
  }

  // Adds the features that people read about, the thinnest first, walls first;
  // low ones are left out. Returns how many those are.
  std::size_t add(const std::vector<ThinFeature>& features, double width,
                  const std::vector<std::string>& source_lines) {
    std::vector<std::size_t> listed;
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (!is_low(features[i], width)) listed.push_back(i);
    }
    std::ranges::stable_sort(listed, {}, [&](std::size_t i) {
      return std::pair(features[i].kind, rank_of(features[i]));
    });
    for (const std::size_t i : listed) {
      const ThinFeature& feature = features[i];
      rows_.push_back(
          {name_of(feature.kind), feature.first_layer, feature.last_layer,
           feature.layer, rounded(feature.place.x, step_),
           rounded(feature.place.y, step_), rounded(feature.width, 1e-3),
           is_edge(feature) ? "edge" : fmt::format("{:.3f} mm", feature.width),
           index_of(source_lines, i)});
    }
    return features.size() - listed.size();
  }

  Json rows() const { return rows_; }
  Json source_lines() const { return source_lines_; }

 private:
  int index_of(const std::vector<std::string>& source_lines, std::size_t i) {
    if (i >= source_lines.size() || source_lines[i].empty()) return -1;
    const auto [at, is_new] = known_.try_emplace(
        source_lines[i], static_cast<int>(source_lines_.size()));
    if (is_new) source_lines_.push_back(source_lines[i]);
    return at->second;
  }

  double step_;
  Json rows_ = Json::array();
  std::vector<std::string> source_lines_;
  std::map<std::string_view, int> known_;
};

// The step of coordinates for a part of that size, `finest` if it can be.
double step_for(Vec2 size, double finest) {
  double step = finest;
  while (std::max(size.x, size.y) / step > kMostSteps) step *= 10;
  return step;
}

// What the page shows of a layer below its picture.
Json figures_of(const plane::Contours& contours,
                const LayerMeasures& measures) {
  return {measures.loops, measures.holes, measures.vertices,
          rounded(measures.area, 1e-6),
          rounded(total_perimeter(contours), 1e-6)};
}

Json row_of(const Layer& layer, const LayerMeasures& measures) {
  Json row = {layer.section_z, layer.bottom, layer.top};
  for (Json& figure : figures_of(layer.contours, measures)) {
    row.push_back(std::move(figure));
  }
  return row;
}

void add_loops(IntegerStream& numbers, PointEncoder& corners,
               const plane::Contours& contours) {
  numbers.add_count(contours.loop_count());
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    numbers.add_count(contours.loop(i).size());
    for (const Vec2& point : contours.loop(i)) corners.add(numbers, point);
  }
}

class PartMaker {
 public:
  PartMaker(const std::vector<Layer>& layers, const ViewerOptions& options)
      : layers_(layers),
        options_(options),
        bounds_(bounds_of(layers)),
        has_supports_(std::ranges::any_of(
            layers,
            [](const Layer& layer) { return !layer.supports.is_empty(); })),
        colors_(colors_of(layers)),
        step_(step_for(bounds_.size(), options.step)),
        corners_(bounds_.low, step_),
        marks_(bounds_.low, step_) {}

  ViewerPart make() {
    Json facts = describe();
    facts["title"] = on_one_line(options_.title);
    facts["estimate"] = options_.estimate;
    if (has_supports_) facts["supports"] = describe_supports();
    if (!colors_.empty()) facts["colors"] = colors_;
    for (const Layer& layer : layers_) {
      add_loops(numbers_, corners_, layer.contours);
      if (has_supports_) {
        add_bodies(layer.contours, {&layer.part, &layer.supports});
      }
      if (!colors_.empty()) add_colored(layer);
    }
    if (options_.print || options_.min_feature > 0) {
      facts["found"] = find_places();
    }
    return {text_of(facts), numbers_.bytes()};
  }

 private:
  // "#rrggbb" of each.
  static std::vector<std::string> colors_of(const std::vector<Layer>& layers) {
    std::vector<std::string> colors;
    const auto colored = std::ranges::find_if(
        layers, [](const Layer& layer) { return !layer.colored.empty(); });
    if (colored == layers.end()) return colors;
    for (const ColoredPart& part : colored->colored) {
      colors.push_back(fmt::format("#{:06x}", part.color));
    }
    return colors;
  }

  Json describe() const {
    Json rows = Json::array();
    double volume = 0;
    for (const Layer& layer : layers_) {
      const LayerMeasures measures = measure(layer.contours);
      volume += measures.area * (layer.top - layer.bottom);
      rows.push_back(row_of(layer, measures));
    }
    return {{"layers", std::move(rows)},
            {"volume", volume},
            {"step", step_},
            {"low", {bounds_.low.x, bounds_.low.y}},
            {"high", {bounds_.high.x, bounds_.high.y}},
            {"minFeature", options_.min_feature}};
  }

  // What the page shows of the part without its supports.
  Json describe_supports() const {
    Json rows = Json::array();
    double volume = 0;
    for (const Layer& layer : layers_) {
      const LayerMeasures measures = measure(layer.part);
      volume += measures.area * (layer.top - layer.bottom);
      rows.push_back(figures_of(layer.part, measures));
    }
    return {{"text", options_.supports},
            {"partLayers", std::move(rows)},
            {"partVolume", volume}};
  }

  // Says of each loop whose it is: the number of a body, or of how many there
  // are. Adds what loops of the bodies are left, body by body.
  void add_bodies(const plane::Contours& whole,
                  const std::vector<const plane::Contours*>& bodies) {
    std::vector<plane::LoopIndex> loops;
    std::vector<std::vector<bool>> is_known;
    for (const plane::Contours* body : bodies) {
      loops.emplace_back(*body);
      is_known.emplace_back(body->loop_count());
    }
    for (std::size_t i = 0; i < whole.loop_count(); ++i) {
      std::size_t owner = 0;
      for (; owner < bodies.size(); ++owner) {
        const auto found = loops[owner].find(whole.loop(i));
        if (!found) continue;
        is_known[owner][*found] = true;
        break;
      }
      numbers_.add_count(owner);
    }
    for (std::size_t owner = 0; owner < bodies.size(); ++owner) {
      plane::Contours rest;
      for (std::size_t i = 0; i < bodies[owner]->loop_count(); ++i) {
        if (!is_known[owner][i]) rest.add_loop(bodies[owner]->loop(i));
      }
      add_loops(numbers_, corners_, rest);
    }
  }

  // Layers without contours have no colored parts.
  void add_colored(const Layer& layer) {
    static const plane::Contours kNothing;
    std::vector<const plane::Contours*> bodies(colors_.size(), &kNothing);
    for (std::size_t i = 0; i < layer.colored.size(); ++i) {
      bodies[i] = &layer.colored[i].contours;
    }
    add_bodies(has_supports_ ? layer.part : layer.contours, bodies);
  }

  // What is to be said of the print, and where.
  Json find_places() {
    PlaceList places(step_);
    Json notes = Json::array();
    if (options_.print) {
      const PrintCheck& print = *options_.print;
      places.add(print, options_.finding_source_lines);
      if (const std::size_t minor = print.count_minor()) {
        notes.push_back(
            fmt::format("{} negligible.",
                        counted(minor, "more place is", "more places are")));
      }
      if (const Peel& peel = print.peel; peel.layer > 0) {
        notes.push_back(
            fmt::format("Peel: largest cured area {:.4g} mm² (layer {}).",
                        peel.greatest_area, peel.layer));
      }
    }
    if (options_.min_feature > 0) {
      const std::vector<ThinFeature> features = find_thin_places();
      const std::size_t low =
          places.add(options_.features.empty() ? features : options_.features,
                     options_.min_feature, options_.source_lines);
      if (low > 0) {
        notes.push_back(
            fmt::format("{} less than {:g} mm high, and not listed.",
                        counted(low, "thin place is", "thin places are"),
                        options_.min_feature));
      }
    }
    return {{"places", places.rows()},
            {"origins", places.source_lines()},
            {"notes", std::move(notes)},
            {"hasPrint", options_.print.has_value()}};
  }

  // Adds the middle lines of each layer behind all contours. Returns the
  // features that they make.
  std::vector<ThinFeature> find_thin_places() {
    ThinFinder finder(options_.min_feature);
    FeatureCollector collector(options_.min_feature, {});
    std::vector<ThinStretch> stretches;
    for (const Layer& layer : layers_) {
      finder.find(layer.contours, stretches);
      collector.take(layer, stretches);
      numbers_.add_count(stretches.size());
      for (const ThinStretch& stretch : stretches) {
        numbers_.add_count(stretch.kind == ThinKind::kGap ? 1 : 0);
        marks_.add(numbers_, stretch.from);
        marks_.add(numbers_, stretch.to);
      }
    }
    return collector.finish();
  }

  const std::vector<Layer>& layers_;
  const ViewerOptions& options_;
  const Box2 bounds_;
  const bool has_supports_;
  const std::vector<std::string> colors_;
  const double step_;
  PointEncoder corners_;
  PointEncoder marks_;
  IntegerStream numbers_;
};

}  // namespace

ViewerPart viewer_part(const std::vector<Layer>& layers,
                       const ViewerOptions& options) {
  return PartMaker(layers, options).make();
}

ViewerLayer viewer_layer(const Layer& layer, const Box2& whole, double step) {
  const double used = step_for(whole.size(), step);
  IntegerStream numbers;
  PointEncoder corners(whole.low, used);
  add_loops(numbers, corners, layer.contours);
  return {text_of(row_of(layer, measure(layer.contours))), numbers.bytes(),
          used};
}

}  // namespace lamina::slicer
