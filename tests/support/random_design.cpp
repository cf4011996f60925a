#include "tests/support/random_design.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "tests/support/random_modules.h"

namespace lamina::support {
namespace {

// A text whose parts are made from left to right, as compilers must do between
// braces, not between parentheses: a design depends on its choices alone.
struct InOrder {
  template <typename... Parts>
  explicit InOrder(fmt::format_string<Parts...> pattern, Parts&&... parts)
      : text(fmt::format(pattern, std::forward<Parts>(parts)...)) {}

  std::string text;
};

class Writer {
 public:
  Writer(RandomKind kind, Choices& choices) : kind_(kind), choices_(choices) {}

  std::string design(std::size_t leaf_count) {
    if (kind_ == RandomKind::kNear) shift_ = std::pow(10.0, uniform(-9, -5));
    std::string body = tree(leaf_count, 0);
    if (kind_ != RandomKind::kTurnedGrid) return body;
    return InOrder{"rotate([{:.3f}, {:.3f}, {:.3f}])\n{}",
                   below(2) == 0 ? 0 : uniform(-40, 40),
                   below(2) == 0 ? 0 : uniform(-40, 40), uniform(0, 360), body}
        .text;
  }

 private:
  bool is_grid() const {
    return kind_ == RandomKind::kGrid || kind_ == RandomKind::kTurnedGrid ||
           kind_ == RandomKind::kNear;
  }

  std::uint32_t below(std::uint32_t count) { return choices_.below(count); }
  double uniform(double low, double high) {
    return choices_.between(low, high);
  }

  // A length, on the grid where there is one.
  std::string length(double low, double high) {
    const double value = uniform(low, high);
    if (!is_grid()) return InOrder{"{:.4f}", value}.text;
    return InOrder{"{}", std::max(std::round(value * 4), 1.0) / 4}.text;
  }
  std::string place(double low, double high) {
    const double value = uniform(low, high);
    if (!is_grid()) return InOrder{"{:.4f}", value}.text;
    const double on_grid = std::round(value * 4) / 4;
    if (kind_ != RandomKind::kNear || below(2) == 0) {
      return InOrder{"{}", on_grid}.text;
    }
    return InOrder{"{:.12f}", on_grid + (below(2) == 0 ? shift_ : -shift_)}
        .text;
  }

  std::string tree(std::size_t leaf_count, std::size_t depth) {
    const std::string indent(2 * depth, ' ');
    if (leaf_count == 1)
      return InOrder{"{}{}{}\n", indent, transform(), leaf()}.text;
    constexpr const char* kOperators[] = {"union", "union", "difference",
                                          "difference", "intersection"};
    // A large intersection of random parts is empty.
    const char* op = kOperators[below(leaf_count > 6 ? 4 : 5)];
    std::string text = InOrder{"{}{}{}() {{\n", indent, transform(), op}.text;
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
    return InOrder{"translate([{}, {}, {}]) ", place(-3, 3), place(-3, 3),
                   place(-2, 2)}
        .text;
  }

  std::string transform() {
    std::string text = translation();
    if (is_grid()) {
      switch (below(6)) {
        case 0:
          return text + InOrder{"rotate({}) ", 90 * below(4)}.text;
        case 1:
          return text +
                 InOrder{"rotate([{}, {}, 0]) ", 90 * below(4), 90 * below(4)}
                     .text;
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
      return text + InOrder{"rotate({}) ", kTurns[below(4)]}.text;
    }
    switch (below(5)) {
      case 0:
        return text + InOrder{"rotate([{:.2f}, {:.2f}, {:.2f}]) ",
                              uniform(0, 360), uniform(0, 360), uniform(0, 360)}
                          .text;
      case 1:
        return text + InOrder{"mirror([{:.2f}, {:.2f}, 1]) ", uniform(-1, 1),
                              uniform(-1, 1)}
                          .text;
      case 2:
        return text + InOrder{"scale([{:.2f}, {:.2f}, {:.2f}]) ",
                              uniform(0.5, 2), uniform(0.5, 2), uniform(0.5, 2)}
                          .text;
      case 3:
        return text +
               InOrder{
                   "multmatrix([[1, {:.2f}, {:.2f}, 0], [0, 1, "
                   "{:.2f}, 0], [{:.2f}, 0, 1, 0]]) ",
                   uniform(-1, 1), uniform(-1, 1), uniform(-1, 1),
                   uniform(-0.5, 0.5)}
                   .text;
      default:
        return text;
    }
  }

  std::string leaf() {
    if (kind_ == RandomKind::kThin) return thin_leaf();
    switch (below(is_grid() ? 4 : 7)) {
      case 0:
      case 1:
        return InOrder{"cube([{}, {}, {}]);", length(0.5, 5), length(0.5, 5),
                       length(0.5, 5)}
            .text;
      case 2:
        return InOrder{"cylinder(r = {}, h = {}, $fn = {});", length(0.5, 2.5),
                       length(1, 5), is_grid() ? 4 : 3 + below(10)}
            .text;
      case 3:
        return InOrder{
            "linear_extrude(height = {}) polygon([[0, 0], [{}, 0], [{}, {}], "
            "[0, {}]]);",
            length(1, 5),
            length(2, 4),
            length(0.25, 1.5),
            length(0.25, 1.5),
            length(2, 4)}
            .text;
      case 4:
        return InOrder{"sphere(r = {}, $fn = {});", length(0.5, 3),
                       5 + below(12)}
            .text;
      case 5:
        return InOrder{
            "hull() {{ cube([{}, {}, {}]); translate([{}, {}, {}]) sphere(r = "
            "{}, $fn = {}); }}",
            length(0.5, 3),
            length(0.5, 3),
            length(0.5, 3),
            place(-2, 2),
            place(-2, 2),
            place(-2, 2),
            length(0.3, 1.5),
            5 + below(8)}
            .text;
      default:
        return InOrder{"cylinder(r1 = {}, r2 = {}, h = {}, $fn = {});",
                       length(0.5, 2), below(2) == 0 ? "0" : length(0, 2),
                       length(1, 5), 3 + below(10)}
            .text;
    }
  }

  // A plate or slot whose least width is spread over 1e-4 to 1 mm.
  std::string thin_leaf() {
    const double width = std::pow(10.0, uniform(-4, 0));
    if (below(3) == 0) {
      return InOrder{
          "difference() {{ cylinder(r = {0}, h = 6, $fn = 24, center = true); "
          "cylinder(r = {0} - {1:.6f}, h = 7, $fn = 24, center = true); }}",
          length(0.8, 3), std::min(width, 0.5)}
          .text;
    }
    return InOrder{"cube([{:.6f}, {}, {}], center = true);", width,
                   length(2, 6), length(4, 8)}
        .text;
  }

  RandomKind kind_;
  Choices& choices_;
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
    case RandomKind::kModules:
      return "modules";
  }
  return "";
}

std::string random_design(RandomKind kind, Choices& choices,
                          std::size_t leaf_count) {
  if (kind == RandomKind::kModules) return random_modules(choices, leaf_count);
  return Writer(kind, choices).design(leaf_count);
}

std::string random_design(RandomKind kind, std::uint32_t seed,
                          std::size_t leaf_count) {
  SeededChoices choices(seed);
  return random_design(kind, choices, leaf_count);
}

}  // namespace lamina::support
