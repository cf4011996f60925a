#include "tests/oracle/random_design.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

namespace lamina::oracle {
namespace {

class Writer {
 public:
  Writer(RandomKind kind, std::uint32_t seed) : kind_(kind), random_(seed) {}

  std::string design(std::size_t leaf_count) {
    if (kind_ == RandomKind::kNear) shift_ = std::pow(10.0, uniform(-9, -5));
    std::string body = tree(leaf_count, 0);
    if (kind_ != RandomKind::kTurnedGrid) return body;
    return fmt::format("rotate([{:.3f}, {:.3f}, {:.3f}])\n{}",
                       below(2) == 0 ? 0 : uniform(-40, 40),
                       below(2) == 0 ? 0 : uniform(-40, 40), uniform(0, 360),
                       body);
  }

 private:
  bool is_grid() const {
    return kind_ == RandomKind::kGrid || kind_ == RandomKind::kTurnedGrid ||
           kind_ == RandomKind::kNear;
  }

  // The standard's distributions differ from library to library; these do not.
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(random_() % count);
  }
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 0x1p32;
  }

  // A length, on the grid where there is one.
  std::string length(double low, double high) {
    const double value = uniform(low, high);
    if (!is_grid()) return fmt::format("{:.4f}", value);
    return fmt::format("{}", std::max(std::round(value * 4), 1.0) / 4);
  }
  std::string place(double low, double high) {
    const double value = uniform(low, high);
    if (!is_grid()) return fmt::format("{:.4f}", value);
    const double on_grid = std::round(value * 4) / 4;
    if (kind_ != RandomKind::kNear || below(2) == 0) {
      return fmt::format("{}", on_grid);
    }
    return fmt::format("{:.12f}", on_grid + (below(2) == 0 ? shift_ : -shift_));
  }

  std::string tree(std::size_t leaf_count, std::size_t depth) {
    const std::string indent(2 * depth, ' ');
    if (leaf_count == 1) return indent + transform() + leaf() + "\n";
    constexpr const char* kOperators[] = {"union", "union", "difference",
                                          "difference", "intersection"};
    // A large intersection of random parts is empty.
    const char* op = kOperators[below(leaf_count > 6 ? 4 : 5)];
    std::string text = indent + transform() + op + "() {\n";
    while (leaf_count > 0) {
      const auto most = static_cast<std::uint32_t>(leaf_count);
      const std::size_t share =
          depth >= 4 ? 1 : std::max<std::size_t>(1, below(most));
      text += tree(std::min(share, leaf_count), depth + 1);
      leaf_count -= std::min(share, leaf_count);
    }
    return text + indent + "}\n";
  }

  std::string translation() {
    return fmt::format("translate([{}, {}, {}]) ", place(-3, 3), place(-3, 3),
                       place(-2, 2));
  }

  std::string transform() {
    std::string text = translation();
    if (is_grid()) {
      switch (below(6)) {
        case 0:
          return text + fmt::format("rotate({}) ", 90 * below(4));
        case 1:
          return text + fmt::format("rotate([{}, {}, 0]) ", 90 * below(4),
                                    90 * below(4));
        case 2:
          return text + "mirror([1, 0, 0]) ";
        case 3:
          return text + "scale([2, 1, 0.5]) ";
        default:
          return text;
      }
    }
    if (kind_ == RandomKind::kThin) {
      constexpr double kTurns[] = {0, 90, 37, 45};
      return text + fmt::format("rotate({}) ", kTurns[below(4)]);
    }
    switch (below(5)) {
      case 0:
        return text + fmt::format("rotate([{:.2f}, {:.2f}, {:.2f}]) ",
                                  uniform(0, 360), uniform(0, 360),
                                  uniform(0, 360));
      case 1:
        return text + fmt::format("mirror([{:.2f}, {:.2f}, 1]) ",
                                  uniform(-1, 1), uniform(-1, 1));
      case 2:
        return text + fmt::format("scale([{:.2f}, {:.2f}, {:.2f}]) ",
                                  uniform(0.5, 2), uniform(0.5, 2),
                                  uniform(0.5, 2));
      case 3:
        return text + fmt::format(
                          "multmatrix([[1, {:.2f}, {:.2f}, 0], [0, 1, "
                          "{:.2f}, 0], [{:.2f}, 0, 1, 0]]) ",
                          uniform(-1, 1), uniform(-1, 1), uniform(-1, 1),
                          uniform(-0.5, 0.5));
      default:
        return text;
    }
  }

  std::string leaf() {
    if (kind_ == RandomKind::kThin) return thin_leaf();
    switch (below(is_grid() ? 4 : 7)) {
      case 0:
      case 1:
        return fmt::format("cube([{}, {}, {}]);", length(0.5, 5),
                           length(0.5, 5), length(0.5, 5));
      case 2:
        return fmt::format("cylinder(r = {}, h = {}, $fn = {});",
                           length(0.5, 2.5), length(1, 5),
                           is_grid() ? 4 : 3 + below(10));
      case 3:
        return fmt::format(
            "linear_extrude(height = {}) polygon([[0, 0], [{}, 0], [{}, {}], "
            "[0, {}]]);",
            length(1, 5), length(2, 4), length(0.25, 1.5), length(0.25, 1.5),
            length(2, 4));
      case 4:
        return fmt::format("sphere(r = {}, $fn = {});", length(0.5, 3),
                           5 + below(12));
      case 5:
        return fmt::format(
            "hull() {{ cube([{}, {}, {}]); translate([{}, {}, {}]) sphere(r = "
            "{}, $fn = {}); }}",
            length(0.5, 3), length(0.5, 3), length(0.5, 3), place(-2, 2),
            place(-2, 2), place(-2, 2), length(0.3, 1.5), 5 + below(8));
      default:
        return fmt::format("cylinder(r1 = {}, r2 = {}, h = {}, $fn = {});",
                           length(0.5, 2), below(2) == 0 ? "0" : length(0, 2),
                           length(1, 5), 3 + below(10));
    }
  }

  // A plate or slot whose least width is spread over 1e-4 to 1 mm.
  std::string thin_leaf() {
    const double width = std::pow(10.0, uniform(-4, 0));
    if (below(3) == 0) {
      return fmt::format(
          "difference() {{ cylinder(r = {0}, h = 6, $fn = 24, center = true); "
          "cylinder(r = {0} - {1:.6f}, h = 7, $fn = 24, center = true); }}",
          length(0.8, 3), std::min(width, 0.5));
    }
    return fmt::format("cube([{:.6f}, {}, {}], center = true);", width,
                       length(2, 6), length(4, 8));
  }

  RandomKind kind_;
  std::mt19937 random_;
  double shift_ = 0;  // off the grid [mm], in kNear
};

}  // namespace

const char* name_of(RandomKind kind) {
  switch (kind) {
    case RandomKind::kGrid:
      return "grid";
    case RandomKind::kTurnedGrid:
      return "turned_grid";
    case RandomKind::kGeneric:
      return "generic";
    case RandomKind::kThin:
      return "thin";
    case RandomKind::kNear:
      return "near";
  }
  return "";
}

std::string random_design(RandomKind kind, std::uint32_t seed,
                          std::size_t leaf_count) {
  return Writer(kind, seed).design(leaf_count);
}

}  // namespace lamina::oracle
