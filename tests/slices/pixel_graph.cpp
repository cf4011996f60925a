#include "tests/slices/pixel_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include <fmt/format.h>

#include "slicer/contour/layer_edges.h"

namespace lamina::support {

using slicer::Finding;
using slicer::FindingKind;

PixelGraph::PixelGraph(const std::vector<slicer::Layer>& layers, double pitch)
    : pitch_(pitch), layers_(layers.size()) {
  Box2 box;
  for (const slicer::Layer& layer : layers) {
    box.add(std::span<const Vec2>(layer.contours.points));
  }
  // Two pixels of void all around; the grid is off that of round numbers.
  low_ = box.low - Vec2(2.37 * pitch);
  columns_ = static_cast<std::size_t>(box.size().x / pitch) + 6;
  rows_ = static_cast<std::size_t>(box.size().y / pitch) + 6;
  pixels_.assign(layers_ * rows_ * columns_, 0);
  for (std::size_t i = 0; i < layers_; ++i) draw(i, layers[i].contours);
}

std::size_t PixelGraph::pixel_at(std::size_t layer, Vec2 place) const {
  const Vec2 at = (place - low_) / pitch_;
  return index(layer, static_cast<std::size_t>(at.y),
               static_cast<std::size_t>(at.x));
}

void PixelGraph::draw(std::size_t layer, const plane::Contours& contours) {
  // Middles: crossings of each row's line, in order.
  std::vector<std::vector<double>> crossings(rows_);
  slicer::visit_edges(contours, [&](Vec2 from, Vec2 to) {
    const Vec2 a = (from - low_) / pitch_;
    const Vec2 b = (to - low_) / pitch_;
    const double low = std::min(a.y, b.y);
    const double high = std::max(a.y, b.y);
    for (double row = std::ceil(low - 0.5); row + 0.5 < high; ++row) {
      crossings[static_cast<std::size_t>(row)].push_back(
          a.x + (row + 0.5 - a.y) * (b.x - a.x) / (b.y - a.y));
    }
  });
  for (std::size_t row = 0; row < rows_; ++row) {
    std::ranges::sort(crossings[row]);
    std::size_t passed = 0;
    for (std::size_t column = 0; column < columns_; ++column) {
      const double middle = static_cast<double>(column) + 0.5;
      while (passed < crossings[row].size() &&
             crossings[row][passed] <= middle) {
        ++passed;
      }
      pixels_[index(layer, row, column)] =
          passed % 2 == 1 ? kMayBeSolid : kMayBeVoid;
    }
  }
  // Cells that an edge passes through, and by a hair those beside it.
  constexpr double kHair = 1e-3;
  slicer::visit_edges(contours, [&](Vec2 from, Vec2 to) {
    Vec2 a = (from - low_) / pitch_;
    Vec2 b = (to - low_) / pitch_;
    if (a.y > b.y) std::swap(a, b);
    for (double row = std::floor(a.y - kHair); row <= b.y + kHair; ++row) {
      double x0 = a.x;
      double x1 = b.x;
      if (b.y > a.y) {
        const double slope = (b.x - a.x) / (b.y - a.y);
        x0 = a.x + slope * (std::clamp(row, a.y, b.y) - a.y);
        x1 = a.x + slope * (std::clamp(row + 1, a.y, b.y) - a.y);
      }
      for (double column = std::floor(std::min(x0, x1) - kHair);
           column <= std::max(x0, x1) + kHair; ++column) {
        pixels_[index(layer, static_cast<std::size_t>(row),
                      static_cast<std::size_t>(column))] |=
            kMayBeSolid | kMayBeVoid;
      }
    }
  });
}

template <bool kInSpace, bool kWithCorners>
std::vector<std::uint32_t> PixelGraph::label(std::uint8_t bit,
                                             std::uint8_t not_bit) const {
  const auto has = [&](std::size_t pixel) {
    return (pixels_[pixel] & bit) != 0 && (pixels_[pixel] & not_bit) == 0;
  };
  std::vector<std::uint32_t> labels(pixels_.size(), 0);
  std::vector<std::size_t> open;
  std::uint32_t last = 0;
  const std::size_t layer_size = rows_ * columns_;
  for (std::size_t seed = 0; seed < pixels_.size(); ++seed) {
    if (labels[seed] != 0 || !has(seed)) continue;
    labels[seed] = ++last;
    open.assign(1, seed);
    while (!open.empty()) {
      const std::size_t pixel = open.back();
      open.pop_back();
      const std::size_t column = pixel % columns_;
      const std::size_t row = pixel / columns_ % rows_;
      const std::size_t layer = pixel / layer_size;
      const auto take = [&](std::size_t other) {
        if (labels[other] != 0 || !has(other)) return;
        labels[other] = last;
        open.push_back(other);
      };
      for (int up = -1; up <= 1; ++up) {
        for (int right = -1; right <= 1; ++right) {
          if (!kWithCorners && up != 0 && right != 0) continue;
          if ((row == 0 && up < 0) || (row + 1 == rows_ && up > 0)) continue;
          if ((column == 0 && right < 0) ||
              (column + 1 == columns_ && right > 0)) {
            continue;
          }
          take(index(layer, row + static_cast<std::size_t>(up),
                     column + static_cast<std::size_t>(right)));
        }
      }
      if (!kInSpace) continue;
      if (layer > 0) take(pixel - layer_size);
      if (layer + 1 < layers_) take(pixel + layer_size);
    }
  }
  return labels;
}

std::vector<std::string> PixelGraph::complaints(
    const std::vector<Finding>& findings) const {
  std::vector<std::string> words;
  judge_islands(findings, words);
  judge_traps(findings, words);
  return words;
}

void PixelGraph::judge_islands(const std::vector<Finding>& findings,
                               std::vector<std::string>& words) const {
  const std::size_t layer_size = rows_ * columns_;
  // Which parts have something below: of wide parts what may be solid, of
  // narrow ones what is.
  const auto wide = label<false, true>(kMayBeSolid, 0);
  const auto narrow = label<false, false>(kMayBeSolid, kMayBeVoid);
  std::vector<std::uint8_t> is_wide_held(
      wide.empty() ? 1 : 1 + *std::ranges::max_element(wide), 0);
  std::vector<std::uint8_t> is_narrow_held(
      narrow.empty() ? 1 : 1 + *std::ranges::max_element(narrow), 0);
  // A wide part without a pixel that is wholly solid may be no part at all.
  std::vector<std::uint8_t> is_there(is_wide_held.size(), 0);
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (narrow[i] != 0) is_there[wide[i]] = 1;
    if (i < layer_size || (wide[i] != 0 && wide[i - layer_size] != 0)) {
      is_wide_held[wide[i]] = 1;
    }
    if (i >= layer_size && narrow[i] != 0 && narrow[i - layer_size] != 0) {
      is_narrow_held[narrow[i]] = 1;
    }
  }
  std::set<std::uint32_t> found;
  for (const Finding& finding : findings) {
    // A loose part begins as one.
    if (finding.kind != FindingKind::kIsland &&
        finding.kind != FindingKind::kLoosePart) {
      continue;
    }
    const std::size_t pixel = pixel_at(finding.first_layer - 1, finding.place);
    found.insert(wide[pixel]);
    if (narrow[pixel] != 0 && is_narrow_held[narrow[pixel]] != 0) {
      words.push_back(fmt::format("layer {}, {} {}: no island",
                                  finding.first_layer, finding.place.x,
                                  finding.place.y));
    }
  }
  for (std::uint32_t part = 1; part < is_there.size(); ++part) {
    if (is_there[part] == 0 || is_wide_held[part] != 0) continue;
    ++sure_islands_;
    if (found.contains(part)) continue;
    const auto at =
        static_cast<std::size_t>(std::ranges::find(wide, part) - wide.begin());
    words.push_back(fmt::format(
        "layer {}, {} {}: an island was missed", at / layer_size + 1,
        low_.x + pitch_ * static_cast<double>(at % columns_),
        low_.y + pitch_ * static_cast<double>(at / columns_ % rows_)));
  }
}

void PixelGraph::judge_traps(const std::vector<Finding>& findings,
                             std::vector<std::string>& words) const {
  const std::size_t layer_size = rows_ * columns_;
  const auto wide = label<true, true>(kMayBeVoid, 0);
  const auto narrow = label<true, false>(kMayBeVoid, kMayBeSolid);
  std::set<std::uint32_t> open_wide = {0};
  std::set<std::uint32_t> open_narrow = {0};
  std::set<std::uint32_t> all;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const std::size_t layer = i / layer_size;
    const std::size_t row = i / columns_ % rows_;
    const std::size_t column = i % columns_;
    if (layer == 0 || layer + 1 == layers_ || row == 0 || row + 1 == rows_ ||
        column == 0 || column + 1 == columns_) {
      open_wide.insert(wide[i]);
      open_narrow.insert(narrow[i]);
    }
    if (narrow[i] != 0) all.insert(wide[i]);
  }
  std::set<std::uint32_t> found;
  for (const Finding& finding : findings) {
    if (finding.kind != FindingKind::kResinTrap) continue;
    const std::size_t pixel = pixel_at(finding.layer - 1, finding.place);
    found.insert(wide[pixel]);
    if (narrow[pixel] != 0 && open_narrow.contains(narrow[pixel])) {
      words.push_back(fmt::format("layer {}, {} {}: no resin trap",
                                  finding.layer, finding.place.x,
                                  finding.place.y));
    }
  }
  for (const std::uint32_t part : all) {
    if (open_wide.contains(part)) continue;
    ++sure_traps_;
    if (!found.contains(part)) {
      words.push_back(fmt::format("a resin trap was missed"));
    }
  }
}

}  // namespace lamina::support
