#include "slicer/casting/sprue_text.h"

#include <iterator>
#include <string>

#include <fmt/format.h>

#include "csg/design_text.h"

namespace lamina::slicer {
namespace {

using csg::design_text;

// All of it is in one module, so that no name of the design means anything
// else.
constexpr const char* kBegin = R"(
// Sprues, one per line: edit, move or delete them. The comment names what each
// one feeds.
module lamina_sprues() {
)";

constexpr const char* kSprueModule = R"(
  // A cone from the root to the gate, a ball of diameter d that reaches into the
  // piece, and on to the middle of the piece, which is `thickness` thick there.
  module sprue(gate, d, end, thickness) {
    hull() {
      translate(sprue_root) sphere(d = sprue_root_d, $fn = 32);
      translate(gate) sphere(d = d, $fn = 24);
    }
    hull() {
      translate(gate) sphere(d = d, $fn = 24);
      translate(end) sphere(d = thickness, $fn = 24);
    }
  }
)";

constexpr const char* kDiscModule = R"(
  // A plate on which the piece stands; `up` points to the piece.
  module sprue_disc(d, up, thickness) {
    translate(sprue_root)
      rotate([0, acos(up[2]), atan2(up[1], up[0])])
        translate([0, 0, -sprue_root_d / 2]) cylinder(d = d, h = thickness, $fn = 64);
  }
)";

}  // namespace

std::string sprue_text(const SpruePlan& plan) {
  std::string text = kBegin;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "  sprue_root = {};  // where it joins a tree\n"
                 "  sprue_root_d = {};  // diameter there [mm]\n",
                 design_text(plan.root), design_text(plan.root_diameter));
  text += kSprueModule;
  if (plan.has_disc) text += kDiscModule;
  text += '\n';
  for (const Sprue& sprue : plan.sprues) {
    fmt::format_to(out, "  sprue({}, {}, {}, {});  // {:.0f} mm³{}\n",
                   design_text(sprue.gate), design_text(sprue.diameter),
                   design_text(sprue.end), design_text(sprue.thickness),
                   sprue.feeds, sprue.at.empty() ? "" : ", " + sprue.at);
  }
  if (plan.has_disc) {
    const Vec3 up = -plan.direction;
    fmt::format_to(out, "  sprue_disc({}, [{}, {}, {}], {});\n",
                   design_text(kDiscShare * plan.root_diameter), up.x, up.y,
                   up.z, design_text(kDiscThickness));
  }
  return text + "}\nlamina_sprues();\n";
}

}  // namespace lamina::slicer
