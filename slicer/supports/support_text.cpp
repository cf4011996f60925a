#include "slicer/supports/support_text.h"

#include <iterator>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "csg/design_text.h"
#include "slicer/supports/raft_label.h"

namespace lamina::slicer {
namespace {

using csg::design_text;

// All of it is in one module, so that no name of the design means anything
// else.
constexpr const char* kBegin = R"(
// Supports, one per line: edit, move or delete them. The comment names what each
// one holds.
module lamina_supports() {
)";

constexpr const char* kModules =
    R"(  $support = support_tip;  // lamina judges by it

  // A cone between two balls.
  module support_rod(from, to, d1, d2) {
    hull() {
      translate(from) sphere(d = d1, $fn = 16);
      translate(to) sphere(d = d2, $fn = 16);
    }
  }

  // How thick the end of a cone inside the part is, for it to touch the part
  // with the tip's diameter, and not to come out of the other side.
  function support_end(inside, neck, tip, depth) =
    min(2 * depth, tip - (support_pillar - tip) * depth /
                         (norm(neck - inside) - depth));

  // A way down: from inside the part, down the head, past bends, to the foot on
  // the bed; or, if it lands, to a second tip inside the part; or, if it joins,
  // to another pillar. A tip is as deep in the part as half of its diameter.
  module support_of(path, lands = false, joins = false, tip = support_tip,
                    depth = 0) {
    last = len(path) - 1;
    deep = depth > 0 ? depth : tip / 2;
    for (i = [0 : last - 1])
      support_rod(path[i], path[i + 1],
                  i == 0 ? support_end(path[0], path[1], tip, deep)
                         : support_pillar,
                  lands && i == last - 1
                    ? support_end(path[last], path[last - 1], tip, deep)
                    : support_pillar);
    if (!lands && !joins)
      translate(path[last] - [0, 0, support_foot_height])
        cylinder(d1 = support_foot, d2 = support_pillar,
                 h = support_foot_height, $fn = 32);
  }
)";

constexpr const char* kBraceModule = R"(
  // A rod between two pillars.
  module support_brace(from, to)
    support_rod(from, to, support_brace_d, support_brace_d);
)";

constexpr const char* kRaftModule = R"(
  // A plate that joins the feet; its sides lean outwards, so that a scraper can
  // get under it.
  module support_raft(feet) hull()
    for (foot = feet) translate(foot)
      cylinder(d1 = support_foot, d2 = support_foot + 2 * support_foot_height,
               h = support_foot_height, $fn = 32);
)";

constexpr const char* kLabeledRaftModule = R"(
  // A plate that joins the feet, with a name engraved in its top. `tab`, x, y,
  // width and depth, is a part of the plate that is there for the name alone.
  module support_raft(feet, name, origin, turn = 0, tab = undef) {
    low = support_foot_height - support_label_depth;
    translate([0, 0, feet[0][2]]) {
      hull() for (foot = feet) translate([foot[0], foot[1], 0])
        cylinder(d1 = support_foot, d2 = support_foot + 2 * low, h = low,
                 $fn = 32);
      if (tab != undef)
        translate([tab[0], tab[1], 0]) cube([tab[2], tab[3], low]);
      translate([0, 0, low])
        linear_extrude(height = support_label_depth) difference() {
          union() {
            hull() for (foot = feet) translate([foot[0], foot[1]])
              circle(d = support_foot + 2 * low, $fn = 32);
            if (tab != undef)
              translate([tab[0], tab[1]]) square([tab[2], tab[3]]);
          }
          translate(origin) rotate(turn)
            text(name, size = support_label_size);
        }
    }
  }
)";

class TextMaker {
 public:
  explicit TextMaker(const SupportPlan& plan) : plan_(plan) {}

  std::string make(const Affine& design_from_job) {
    add_head();
    for (const Support& support : plan_.supports) add_support(support);
    for (const auto& [from, to] : plan_.braces) {
      add("  support_brace({}, {});\n", design_text(from), design_text(to));
    }
    if (plan_.sizes.has_raft) add_raft();
    text_ += "}\n";
    if (design_from_job != Affine(1.0)) {
      const Affine& m = design_from_job;
      text_ += "multmatrix([";
      for (int row = 0; row < 3; ++row) {
        add("[{}, {}, {}, {}], ", m[0][row], m[1][row], m[2][row], m[3][row]);
      }
      text_ += "[0, 0, 0, 1]]) ";
    }
    text_ += "lamina_supports();\n";
    return std::move(text_);
  }

 private:
  template <typename... Parts>
  void add(fmt::format_string<Parts...> words, Parts&&... parts) {
    fmt::format_to(std::back_inserter(text_), words,
                   std::forward<Parts>(parts)...);
  }

  void add_head() {
    const SupportSizes& sizes = plan_.sizes;
    text_ += kBegin;
    add("  support_tip = {:g};  // diameter where it touches the part [mm]\n"
        "  support_pillar = {:g};  // diameter\n",
        sizes.tip, sizes.pillar);
    if (!plan_.braces.empty()) {
      add("  support_brace_d = {:g};  // diameter\n", sizes.brace);
    }
    add("  support_foot = {:g};  // diameter on the bed\n"
        "  support_foot_height = {:g};\n",
        sizes.foot, sizes.foot_height);
    if (plan_.label) {
      add("  support_label_size = {:g};  // of letters in the raft\n"
          "  support_label_depth = {:g};\n",
          kLabelSize, kLabelDepth);
    }
    text_ += kModules;
    if (!plan_.braces.empty()) text_ += kBraceModule;
    if (sizes.has_raft) text_ += plan_.label ? kLabeledRaftModule : kRaftModule;
    text_ += '\n';
  }

  void add_support(const Support& support) {
    text_ += "  support_of([";
    for (std::size_t i = 0; i < support.path.size(); ++i) {
      text_ += (i == 0 ? "" : ", ") + design_text(support.path[i]);
    }
    text_ += ']';
    if (support.end == SupportEnd::kPart) text_ += ", lands = true";
    if (support.end == SupportEnd::kPillar) text_ += ", joins = true";
    if (support.tip != plan_.sizes.tip)
      add(", tip = {}", design_text(support.tip));
    if (support.depth != support.tip / 2) {
      add(", depth = {}", design_text(support.depth));
    }
    text_ += ");";
    if (!support.holds.empty()) add("  // {}", support.holds);
    text_ += '\n';
  }

  void add_raft() {
    text_ += "  support_raft([";
    bool is_first = true;
    for (const Support& support : plan_.supports) {
      if (support.end != SupportEnd::kFoot) continue;
      const Vec3 foot = support.path.back();
      text_ += is_first ? "" : ", ";
      text_ += design_text({foot.x, foot.y, plan_.bed});
      is_first = false;
    }
    text_ += ']';
    if (plan_.label) add_label(*plan_.label);
    text_ += ");\n";
  }

  void add_label(const RaftLabel& label) {
    add(", {}, [{}, {}]", in_quotes(label.text), design_text(label.origin.x),
        design_text(label.origin.y));
    if (label.is_upright) text_ += ", turn = 90";
    if (!label.tab) return;
    const Vec2 size = label.tab->high - label.tab->low;
    add(", tab = [{}, {}, {}, {}]", design_text(label.tab->low.x),
        design_text(label.tab->low.y), design_text(size.x),
        design_text(size.y));
  }

  const SupportPlan& plan_;
  std::string text_;
};

}  // namespace

std::string support_text(const SupportPlan& plan,
                         const Affine& design_from_job) {
  return TextMaker(plan).make(design_from_job);
}

}  // namespace lamina::slicer
