#include "slicer/picture/viewer_page.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include "base/check.h"
#include "slicer/check/feature_table.h"
#include "slicer/check/thin_finder.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/picture/detail/drawing.h"
#include "slicer/picture/detail/viewer_template.h"

namespace lamina::slicer {
namespace {

using Json = nlohmann::json;

constexpr double kFinestStep = 1e-4;    // of coordinates [mm]
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

std::string deflate(const std::string& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string deflated(size, '\0');
  const int status =
      compress2(reinterpret_cast<Bytef*>(deflated.data()), &size,
                reinterpret_cast<const Bytef*>(bytes.data()),
                static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
  if (status != Z_OK) throw std::bad_alloc();
  deflated.resize(size);
  return deflated;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const char byte = i + j < bytes.size() ? bytes[i + j] : '\0';
      bits = bits << 8 | static_cast<unsigned char>(byte);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      text += i + j > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * j) & 63];
    }
  }
  return text;
}

// Leaves out digits that the page does not show.
double rounded(double value, double step) {
  return std::round(value / step) * step;
}

std::string replaced(std::string_view text, char letter,
                     std::string_view replacement) {
  std::string result;
  for (const char c : text) {
    result += c == letter ? replacement : std::string_view(&c, 1);
  }
  return result;
}

// JSON within a <script>, where no end tag may stand.
std::string script_text(const Json& json) {
  return replaced(json.dump(-1, ' ', false, Json::error_handler_t::replace),
                  '<', "\\u003c");
}

std::string escape_html(std::string_view text) {
  return replaced(replaced(text, '&', "&amp;"), '<', "&lt;");
}

class PageMaker {
 public:
  PageMaker(const std::vector<Layer>& layers, const ViewerOptions& options)
      : layers_(layers),
        options_(options),
        bounds_(bounds_of(layers)),
        step_(step_for(bounds_.size())),
        corners_(bounds_.low, step_),
        marks_(bounds_.low, step_) {}

  std::string make() {
    Json facts = describe();
    facts["title"] = options_.title;
    for (const Layer& layer : layers_) add_contours(layer);
    if (options_.min_feature > 0) facts["thin"] = find_thin_places();
    // Copy the template, with a text in the place of each mark.
    std::string page;
    std::string_view rest = kViewerPage;
    const auto put = [&](std::string_view mark, std::string_view text) {
      const std::size_t place = rest.find(mark);
      LAMINA_CHECK_EQ(place != std::string_view::npos, true);
      page.append(rest.substr(0, place)).append(text);
      rest.remove_prefix(place + mark.size());
    };
    put("{{title}}", escape_html(options_.title));
    put("{{style}}", kViewerStyle);
    put("{{facts}}", script_text(facts));
    put("{{contours}}", base64(deflate(numbers_.bytes())));
    put("{{script}}", kViewerScript);
    return page.append(rest);
  }

 private:
  static double step_for(Vec2 size) {
    double step = kFinestStep;
    while (std::max(size.x, size.y) / step > kMostSteps) step *= 10;
    return step;
  }

  Json describe() const {
    Json rows = Json::array();
    double volume = 0;
    for (const Layer& layer : layers_) {
      const LayerMeasures measures = measure(layer.contours);
      volume += measures.area * (layer.top - layer.bottom);
      rows.push_back({layer.section_z, layer.bottom, layer.top, measures.loops,
                      measures.holes, measures.vertices,
                      rounded(measures.area, 1e-6),
                      rounded(total_perimeter(layer.contours), 1e-6)});
    }
    return {{"layers", std::move(rows)},
            {"volume", volume},
            {"step", step_},
            {"low", {bounds_.low.x, bounds_.low.y}},
            {"high", {bounds_.high.x, bounds_.high.y}},
            {"minFeature", options_.min_feature}};
  }

  void add_contours(const Layer& layer) {
    const ldni::Contours& contours = layer.contours;
    numbers_.add_count(contours.loop_count());
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      numbers_.add_count(contours.loop(i).size());
      for (const Vec2& point : contours.loop(i)) corners_.add(numbers_, point);
    }
  }

  // Adds the middle lines of each layer behind all contours. Returns the
  // features that they make.
  Json find_thin_places() {
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
    return list(options_.features.empty() ? collector.finish()
                                          : options_.features);
  }

  // Returns what feature_table() would list, in its order; low ones are
  // counted.
  Json list(const std::vector<ThinFeature>& features) const {
    std::vector<std::size_t> listed;
    for (std::size_t i = 0; i < features.size(); ++i) {
      if (!is_low(features[i], options_.min_feature)) listed.push_back(i);
    }
    std::ranges::stable_sort(
        listed, {}, [&](std::size_t i) { return rank_of(features[i]); });
    Json rows = Json::array();
    for (const std::size_t i : listed) {
      const ThinFeature& feature = features[i];
      rows.push_back({feature.kind == ThinKind::kGap ? 1 : 0,
                      feature.first_layer, feature.last_layer, feature.layer,
                      is_edge(feature) ? 0 : rounded(feature.width, 1e-6),
                      rounded(feature.place.x, step_),
                      rounded(feature.place.y, step_)});
      if (i < options_.origins.size()) {
        rows.back().push_back(options_.origins[i]);
      }
    }
    return {{"low", features.size() - listed.size()},
            {"features", std::move(rows)}};
  }

  const std::vector<Layer>& layers_;
  const ViewerOptions& options_;
  const Box2 bounds_;
  const double step_;
  PointEncoder corners_;
  PointEncoder marks_;
  IntegerStream numbers_;
};

}  // namespace

std::string viewer_page(const std::vector<Layer>& layers,
                        const ViewerOptions& options) {
  return PageMaker(layers, options).make();
}

}  // namespace lamina::slicer
