#include "cli/report/comparison_text.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/paths.h"
#include "cli/report/printed_text.h"

namespace lamina::cli {
namespace {

using compiler::ComparisonResult;
using compiler::SideText;
using slicer::LayerDifference;

constexpr std::size_t kListedDifferences = 10;

// Three digits are enough to compare lengths by.
std::string length(double mm) {
  return std::isinf(mm) ? "missing" : fmt::format("{:.3g}", mm);
}

// "12-1 / 12": regions and holes, of both where they differ.
std::string loops(const LayerDifference& layer) {
  const auto words = [](const slicer::LoopCount& count) {
    return fmt::format("{}-{}", count.regions, count.holes);
  };
  return layer.loops_a == layer.loops_b
             ? words(layer.loops_a)
             : fmt::format("{} / {}", words(layer.loops_a),
                           words(layer.loops_b));
}

// All, or those that differ most, in their order.
std::vector<std::size_t> choose_rows(const std::vector<LayerDifference>& layers,
                                     bool lists_all) {
  std::vector<std::size_t> rows;
  const auto rank = [&](std::size_t row) {
    return std::pair(layers[row].distance.distance, layers[row].area());
  };
  for (std::size_t row = 0; row < layers.size(); ++row) {
    if (lists_all || rank(row) > std::pair(0.0, 0.0)) rows.push_back(row);
  }
  if (lists_all || rows.size() <= kListedDifferences) return rows;
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t i, std::size_t j) {
    return rank(i) > rank(j);
  });
  rows.resize(kListedDifferences);
  std::sort(rows.begin(), rows.end());
  return rows;
}

std::string verdict(const ComparisonResult& result) {
  const slicer::ComparisonTotals& totals = result.totals;
  if (result.is_equal()) {
    return fmt::format("equal     within {:.4g} mm in all {} layers",
                       result.tolerance, totals.layers);
  }
  std::string words =
      fmt::format("different in {} of {} layers, beyond {:.4g} mm",
                  totals.outside, totals.layers, result.tolerance);
  if (result.hint != Vec3(0)) {
    words += fmt::format(
        "; equal if b is moved by ({:.6g}, {:.6g}, {:.6g}) mm: --align",
        result.hint.x, result.hint.y, result.hint.z);
  }
  return words;
}

class Writer : PrintedText {
 public:
  explicit Writer(const ComparisonResult& result) : result_(result) {}

  std::string write(bool lists_all) {
    side('a', result_.a);
    side('b', result_.b);
    if (result_.shift != Vec3(0)) {
      print("shift     b moved by ({:.6g}, {:.6g}, {:.6g}) mm\n",
            result_.shift.x, result_.shift.y, result_.shift.z);
    }
    table(lists_all);
    totals();
    print("{}\n", verdict(result_));
    return std::move(text_);
  }

 private:
  void side(char letter, const SideText& side) {
    print("{}         {} ({})\n", letter, display_path(side.name),
          side.description);
  }

  void table(bool lists_all) {
    const auto& layers = result_.layers;
    const std::vector<std::size_t> rows = choose_rows(layers, lists_all);
    text_ += '\n';
    if (rows.empty()) return;
    print("{:>6} {:>10} {:>13} {:>13} {:>12} {:>12} {:>13} {:>10}\n", "layer",
          "z", "area a", "area b", "only a", "only b", "regions-holes",
          "distance");
    for (const std::size_t row : rows) {
      const LayerDifference& layer = layers[row];
      print(
          "{:>6} {:>10.6g} {:>13.6f} {:>13.6f} {:>12.6f} {:>12.6f} {:>13} "
          "{:>10}{}\n",
          layer.number, layer.z, layer.areas.a(), layer.areas.b(),
          layer.areas.only_a, layer.areas.only_b, loops(layer),
          length(layer.distance.distance), layer.moved != 0 ? " *" : "");
    }
    if (rows.size() < layers.size()) {
      print("({} of {} layers, those that differ most; --all lists them all)\n",
            rows.size(), layers.size());
    }
    text_ += '\n';
  }

  void totals() {
    const slicer::ComparisonTotals& totals = result_.totals;
    if (totals.volume_a > 0 || totals.volume_b > 0) {
      print("volume    a {:.6f} mm³, b {:.6f}; only a {:.6f}, only b {:.6f}\n",
            totals.volume_a, totals.volume_b, totals.volume_only_a,
            totals.volume_only_b);
    }
    print("loops     {}\n",
          totals.other_loops == 0
              ? "as many regions and holes in every layer"
              : fmt::format("other numbers of regions or holes in {} of {} "
                            "layers",
                            totals.other_loops, totals.layers));
    worst();
    const auto moved =
        std::count_if(result_.layers.begin(), result_.layers.end(),
                      [](const auto& layer) { return layer.moved != 0; });
    if (moved > 0) {
      print(
          "faces     {} layers (*) lie in a horizontal face, as far as "
          "numbers tell; cut\n          {:.1g} mm beside it they are as "
          "shown\n",
          moved, greatest_move());
    }
    tolerance();
  }

  void worst() {
    if (!result_.totals.worst) return;
    const LayerDifference& layer = result_.layers[*result_.totals.worst];
    if (std::isinf(layer.distance.distance)) {
      print("distance  in layer {} at z {:.6g} only {} has contours\n",
            layer.number, layer.z, layer.areas.only_a > 0 ? "a" : "b");
      return;
    }
    if (layer.distance.distance == 0) {
      print("distance  none\n");
      return;
    }
    print(
        "distance  at most {} mm: layer {} at z {:.6g}, near x {:.6g} y "
        "{:.6g}\n",
        length(layer.distance.distance), layer.number, layer.z,
        layer.distance.place.x, layer.distance.place.y);
  }

  double greatest_move() const {
    double greatest = 0;
    for (const LayerDifference& layer : result_.layers) {
      greatest = std::max(greatest, std::abs(layer.moved));
    }
    return greatest;
  }

  void tolerance() {
    const auto words = [](const SideText& side) {
      return fmt::format("{:.4g}{}", side.precision,
                         side.is_assumed ? " assumed" : "");
    };
    print("tolerance {:.4g} mm; what contours can be off by: a {}, b {}\n",
          result_.tolerance, words(result_.a), words(result_.b));
  }

  const ComparisonResult& result_;
};

nlohmann::ordered_json side_json(const SideText& side) {
  return {{"name", display_path(side.name)},
          {"description", side.description},
          {"precision", side.precision},
          {"is_precision_assumed", side.is_assumed}};
}

nlohmann::ordered_json layer_json(const LayerDifference& layer) {
  const auto count = [](const slicer::LoopCount& loops) {
    return nlohmann::ordered_json{{"regions", loops.regions},
                                  {"holes", loops.holes}};
  };
  nlohmann::ordered_json json = {
      {"number", layer.number},          {"z", layer.z},
      {"area_a", layer.areas.a()},       {"area_b", layer.areas.b()},
      {"only_a", layer.areas.only_a},    {"only_b", layer.areas.only_b},
      {"loops_a", count(layer.loops_a)}, {"loops_b", count(layer.loops_b)}};
  // Where only one of them has contours there is no distance.
  if (std::isinf(layer.distance.distance)) {
    json["distance"] = nullptr;
  } else {
    json["distance"] = layer.distance.distance;
    json["place"] = {layer.distance.place.x, layer.distance.place.y};
  }
  if (layer.moved != 0) json["cut_higher"] = layer.moved;
  return json;
}

}  // namespace

std::string comparison_text(const ComparisonResult& result, bool lists_all) {
  return Writer(result).write(lists_all);
}

std::string comparison_json(const ComparisonResult& result) {
  const slicer::ComparisonTotals& totals = result.totals;
  nlohmann::ordered_json layers = nlohmann::ordered_json::array();
  for (const LayerDifference& layer : result.layers) {
    layers.push_back(layer_json(layer));
  }
  const nlohmann::ordered_json json = {
      {"a", side_json(result.a)},
      {"b", side_json(result.b)},
      {"equal", result.is_equal()},
      {"tolerance", result.tolerance},
      {"shift", {result.shift.x, result.shift.y, result.shift.z}},
      {"layers_outside", totals.outside},
      {"layers_of_other_loops", totals.other_loops},
      {"volume_a", totals.volume_a},
      {"volume_b", totals.volume_b},
      {"volume_only_a", totals.volume_only_a},
      {"volume_only_b", totals.volume_only_b},
      {"layers", std::move(layers)}};
  // Names of files need not be UTF-8.
  return json.dump(1, ' ', false,
                   nlohmann::ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace lamina::cli
