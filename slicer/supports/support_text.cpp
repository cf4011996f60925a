#include "slicer/supports/support_text.h"

#include <iterator>

#include <fmt/format.h>

namespace lamina::slicer {
namespace {

// Names that no design is likely to have.
constexpr const char* kModules = R"(
// A cone between two balls.
module support_rod(from, to, d1, d2) {
  hull() {
    translate(from) sphere(d = d1, $fn = 16);
    translate(to) sphere(d = d2, $fn = 16);
  }
}

// A way down: from inside the part, down the head, past bends, to the foot on
// the bed; or, if it lands, to a second tip inside the part.
module support_of(path, lands = false) {
  last = len(path) - 1;
  for (i = [0 : last - 1])
    support_rod(path[i], path[i + 1], i == 0 ? support_tip : support_pillar,
                lands && i == last - 1 ? support_tip : support_pillar);
  if (!lands)
    translate(path[last] - [0, 0, support_foot_height])
      cylinder(d1 = support_foot, d2 = support_pillar, h = support_foot_height,
               $fn = 32);
}

)";

// "[1.5, -2, 0.125]": as short as a micrometre allows.
std::string words(Vec3 place) {
  const auto number = [](double value) {
    std::string text = fmt::format("{:.3f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? std::string("0") : text;
  };
  return fmt::format("[{}, {}, {}]", number(place.x), number(place.y),
                     number(place.z));
}

}  // namespace

std::string support_text(const SupportPlan& plan,
                         const Affine& design_from_job) {
  const SupportSizes& sizes = plan.sizes;
  std::string text = fmt::format(
      "\n// Supports: one a line, to be edited, moved or left out.\n"
      "support_tip = {:g};  // diameter where it touches the part [mm]\n"
      "support_pillar = {:g};  // diameter\n"
      "support_foot = {:g};  // diameter on the bed\n"
      "support_foot_height = {:g};\n{}",
      sizes.tip, sizes.pillar, sizes.foot, sizes.foot_height, kModules);
  const auto out = std::back_inserter(text);
  const bool is_turned = design_from_job != Affine(1.0);
  if (is_turned) {
    const Affine& m = design_from_job;
    text += "multmatrix([";
    for (int row = 0; row < 3; ++row) {
      fmt::format_to(out, "[{}, {}, {}, {}], ", m[0][row], m[1][row], m[2][row],
                     m[3][row]);
    }
    text += "[0, 0, 0, 1]]) {\n";
  }
  for (const Support& support : plan.supports) {
    text += is_turned ? "  support_of([" : "support_of([";
    for (std::size_t i = 0; i < support.path.size(); ++i) {
      text += (i == 0 ? "" : ", ") + words(support.path[i]);
    }
    fmt::format_to(out, "]{});\n", support.stands_on_part ? ", true" : "");
  }
  if (is_turned) text += "}\n";
  return text;
}

}  // namespace lamina::slicer
