#include "tests/support/scene_laws.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "tests/support/contour_checks.h"
#include "tests/support/random_design.h"
#include "tests/support/random_modules.h"
#include "tests/support/scene_sections.h"

namespace lamina::support {
namespace {

Sections cut(const Operands& t, const std::string& design) {
  return sections_of(design, t.heights);
}

std::string enclose(const std::string& head, const std::string& bodies) {
  return head + " {\n" + bodies + "}\n";
}

std::vector<double> moved(std::vector<double> heights, double factor,
                          double shift) {
  for (double& height : heights) height = factor * height + shift;
  return heights;
}

bool both(const std::vector<bool>& in) { return in[0] && in[1]; }
bool either(const std::vector<bool>& in) { return in[0] || in[1]; }
bool first_alone(const std::vector<bool>& in) { return in[0] && !in[1]; }

// --- Sets -------------------------------------------------------------------
void boolean_operators(const Operands& t) {
  const Sections a = cut(t, t.a);
  const Sections b = cut(t, t.b);
  const Sections sum = cut(t, enclose("union()", t.a + t.b));
  const Sections common = cut(t, enclose("intersection()", t.a + t.b));
  const Sections rest = cut(t, enclose("difference()", t.a + t.b));
  expect_rule("A or B", sum, {a, b}, either);
  expect_rule("A and B", common, {a, b}, both);
  expect_rule("A without B", rest, {a, b}, first_alone);
  expect_equal_areas("A or B, A and B", {sum, common}, {a, b});
  expect_equal_areas("A without B, A and B", {rest, common}, {a});
}

void solid_with_itself(const Operands& t) {
  const Sections a = cut(t, t.a);
  expect_same("A or A", cut(t, enclose("union()", t.a + t.a)), a);
  expect_same("A and A", cut(t, enclose("intersection()", t.a + t.a)), a);
  expect_rule("A without A", cut(t, enclose("difference()", t.a + t.a)), {a},
              [](const std::vector<bool>&) { return false; });
  for (const char* head : {"union()", "intersection()", "difference()",
                           "render()", "group()", "color([1, 0, 0])"}) {
    expect_same(head, cut(t, enclose(head, t.a)), a);
  }
}

void order_of_children(const Operands& t) {
  for (const char* head : {"union()", "intersection()"}) {
    const Sections one = cut(t, enclose(head, t.a + t.b + t.c));
    expect_same(head, cut(t, enclose(head, t.c + t.a + t.b)), one);
  }
  expect_same("subtrahends", cut(t, enclose("difference()", t.a + t.c + t.b)),
              cut(t, enclose("difference()", t.a + t.b + t.c)));
}

void distribution(const Operands& t) {
  const std::string b_or_c = enclose("union()", t.b + t.c);
  expect_same("without a union", cut(t, enclose("difference()", t.a + b_or_c)),
              cut(t, enclose("intersection()",
                             enclose("difference()", t.a + t.b) +
                                 enclose("difference()", t.a + t.c))));
  expect_same(
      "with a union", cut(t, enclose("intersection()", t.a + b_or_c)),
      cut(t, enclose("union()", enclose("intersection()", t.a + t.b) +
                                    enclose("intersection()", t.a + t.c))));
}

void cut_in_two(const Operands& t) {
  expect_same(
      "cut in two and united",
      cut(t, enclose("union()", enclose("difference()", t.a + t.b) +
                                    enclose("intersection()", t.a + t.b))),
      cut(t, t.a));
}

// --- Space ------------------------------------------------------------------
// By an angle, to the left, about z.
void turn(const Operands& t) {
  const Sections a = cut(t, t.a);
  for (const double angle_deg : {90.0, 37.0, 0.001}) {
    const double angle = angle_deg * std::numbers::pi / 180;
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    expect_same(fmt::format("turned by {}", angle_deg),
                cut(t, enclose(fmt::format("rotate({})", angle_deg), t.a)),
                mapped(a, [&](Vec2 p) {
                  return Vec2(c * p.x - s * p.y, s * p.x + c * p.y);
                }));
  }
}

void mirror_image(const Operands& t) {
  expect_same("mirrored in x", cut(t, enclose("mirror([1, 0, 0])", t.a)),
              mapped(cut(t, t.a), [](Vec2 p) { return Vec2(-p.x, p.y); }));
  expect_same("mirrored in x = y", cut(t, enclose("mirror([1, -1, 0])", t.a)),
              mapped(cut(t, t.a), [](Vec2 p) { return Vec2(p.y, p.x); }));
}

// By powers of two, so that heights of faces stay exact.
void shift_and_scale(const Operands& t) {
  const Sections a = cut(t, t.a);
  expect_same("shifted",
              sections_of(enclose("translate([0.5, -3, 0.25])", t.a),
                          moved(t.heights, 1, 0.25)),
              mapped(a, [](Vec2 p) { return p + Vec2(0.5, -3); }));
  expect_same("scaled",
              sections_of(enclose("scale(2)", t.a), moved(t.heights, 2, 0)),
              mapped(a, [](Vec2 p) { return 2.0 * p; }));
}

// --- Ways to the same layers -------------------------------------------------
void pitch_of_rays(const Operands& t) {
  const Sections plain = cut(t, t.a);
  for (const double pitch : {0.03, 0.5, 10.0}) {
    expect_same(fmt::format("at pitch {}", pitch),
                sections_of(t.a, t.heights, pitch), plain);
  }
}

void number_of_threads(const Operands& t) {
  slicer::Settings settings;
  for (int i = 0; i < 200; ++i) settings.heights.push_back(0.03 * i - 2);
  settings.threads = 1;
  const Sections one = sliced(t.a, settings);
  settings.threads = 3;
  const Sections three = sliced(t.a, settings);
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (one[i].points == three[i].points && one[i].ends == three[i].ends) {
      continue;
    }
    throw BrokenLaw{
        fmt::format("three threads differ at {}", settings.heights[i])};
  }
}

slicer::Settings settings_of(const Operands& t, double tolerance) {
  slicer::Settings settings;
  settings.heights = t.heights;
  settings.threads = 1;
  settings.tolerance = tolerance;
  return settings;
}

// Vertices that are left out move nothing by more than the tolerance, and no
// loop vanishes.
void left_out_vertices(const Operands& t) {
  const Sections exact = cut(t, t.a);
  constexpr double kTolerance = 0.01;
  const Sections simple = sliced(t.a, settings_of(t, kTolerance));
  for (std::size_t i = 0; i < exact.size(); ++i) {
    if (count_loops(exact[i]) == count_loops(simple[i]) &&
        (exact[i].is_empty() ||
         greatest_distance(exact[i], simple[i]) <= kTolerance + 1e-9)) {
      continue;
    }
    throw BrokenLaw{
        fmt::format("left-out vertices: wrong at {}", t.heights[i])};
  }
}

// Samples are points of the surface: the paper's vertices lie on the faithful
// contour.
void paper_contours(const Operands& t) {
  const Sections faithful = cut(t, t.a);
  slicer::Settings settings = settings_of(t, 0);
  settings.contour = slicer::ContourMode::kPaper;
  settings.ray_pitch = 0.11;
  const Sections paper = sliced(t.a, settings);
  for (std::size_t i = 0; i < paper.size(); ++i) {
    for (const Vec2& point : paper[i].points) {
      const double distance = distance_to_edges(faithful[i], point);
      if (distance <= kDoubt) continue;
      throw BrokenLaw{fmt::format("paper: ({}, {}) at {} is {} mm off", point.x,
                                  point.y, t.heights[i], distance)};
    }
  }
}

// --- Solids made from solids -------------------------------------------------
// Never empty and never flat: of an empty operand these modules take no notice,
// and what is flat counts for them only where no Boolean has dropped it.
std::string fattened(const std::string& design) {
  return enclose("union()", "cube(1);\n" + design);
}

void hulls(const Operands& t) {
  const std::string a = fattened(t.a);
  const std::string b = fattened(t.b);
  const std::string hull_a = enclose("hull()", a);
  const Sections hull = cut(t, hull_a);
  expect_rule("A and not its hull", Sections(t.heights.size()),
              {cut(t, a), hull}, first_alone);
  expect_same("hull of a hull", cut(t, enclose("hull()", hull_a)), hull);
  const Sections of_both = cut(t, enclose("hull()", a + b));
  expect_same("hull of hulls",
              cut(t, enclose("hull()", hull_a + enclose("hull()", b))),
              of_both);
  expect_same("hull of a union",
              cut(t, enclose("hull()", enclose("union()", a + b))), of_both);
}

void sums(const Operands& t) {
  const std::string a = fattened(t.a);
  const std::string b = fattened(t.b);
  const std::string ball = "sphere(r = 0.5, $fn = 4);\n";
  const Sections sum = cut(t, enclose("minkowski()", a + ball));
  expect_same("summands exchanged", cut(t, enclose("minkowski()", ball + a)),
              sum);
  expect_rule("A and not its sum", Sections(t.heights.size()), {cut(t, a), sum},
              first_alone);
  expect_rule("sum of a union",
              cut(t, enclose("minkowski()", enclose("union()", a + b) + ball)),
              {sum, cut(t, enclose("minkowski()", b + ball))}, either);
}

// A cut is what is just below or just above the plane.
void cuts(const Operands& t) {
  const double z = t.heights[0];
  const Sections around = sections_of(t.a, {z - 3e-9, z});
  const std::string moved =
      enclose(fmt::format("translate([0, 0, {}])", -z), t.a);
  const Sections cut = sections_of(
      enclose("linear_extrude(1) projection(cut = true)", moved), {0.5});
  expect_rule("cut", cut, {{around[0]}, {around[1]}}, either);
}

void shadows(const Operands& t) {
  const Sections shadow =
      sections_of(enclose("linear_extrude(1) projection()", t.a), {0.5});
  const Sections a = cut(t, t.a);
  for (const auto& layer : a) {
    expect_rule("A and not its shadow", Sections(1), {{layer}, shadow},
                first_alone);
  }
}

// --- Shapes -----------------------------------------------------------------
Sections extruded(const std::string& shape) {
  return sections_of(enclose("linear_extrude(1)", shape), {0.5});
}

void shape_operators(const Operands& t) {
  const Sections a = extruded(t.a);
  const Sections b = extruded(t.b);
  expect_rule("A or B", extruded(enclose("union()", t.a + t.b)), {a, b},
              either);
  expect_rule("A and B", extruded(enclose("intersection()", t.a + t.b)), {a, b},
              both);
  expect_rule("A without B", extruded(enclose("difference()", t.a + t.b)),
              {a, b}, first_alone);
}

void shape_offsets(const Operands& t) {
  const Sections a = extruded(t.a);
  const Sections none(1);
  for (const char* larger :
       {"offset(r = 0.5, $fn = 8)", "offset(delta = 0.5)", "hull()"}) {
    expect_rule(fmt::format("A and not {} A", larger), none,
                {a, extruded(enclose(larger, t.a))}, first_alone);
  }
  for (const char* smaller :
       {"offset(r = -0.5, $fn = 8)", "offset(delta = -0.5)"}) {
    expect_rule(fmt::format("{} A and not A", smaller), none,
                {extruded(enclose(smaller, t.a)), a}, first_alone);
  }
}

void shape_of_extrusion(const Operands& t) {
  const Sections a = extruded(t.a);
  expect_same("shadow",
              extruded(enclose("projection() linear_extrude(2)", t.a)), a);
  expect_same("cut",
              extruded(enclose("projection(cut = true) linear_extrude(2, "
                               "center = true)",
                               t.a)),
              a);
}

struct Law {
  const char* name;
  void (*check)(const Operands&);
  bool is_of_shapes = false;
};
constexpr Law kLaws[] = {{"operators", boolean_operators},
                         {"itself", solid_with_itself},
                         {"order", order_of_children},
                         {"distribution", distribution},
                         {"cut_in_two", cut_in_two},
                         {"turn", turn},
                         {"mirror", mirror_image},
                         {"shift_scale", shift_and_scale},
                         {"pitch", pitch_of_rays},
                         {"threads", number_of_threads},
                         {"tolerance", left_out_vertices},
                         {"paper", paper_contours},
                         {"hull", hulls},
                         {"sum", sums},
                         {"cut", cuts},
                         {"shadow", shadows},
                         {"shape_operators", shape_operators, true},
                         {"shape_offsets", shape_offsets, true},
                         {"shape_of_extrusion", shape_of_extrusion, true}};

// Steps of a quarter, where faces lie, or well beside.
std::vector<double> draw_heights(Choices& choices) {
  constexpr double kBeside[] = {0, 0, 0.0371, 0.1113};
  constexpr std::size_t kCount = 4;
  std::vector<double> heights;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double on_grid = 0.25 * choices.below(25) - 2;
    heights.push_back(on_grid + kBeside[choices.below(4)]);
  }
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  return heights;
}

std::string draw_design(Choices& choices) {
  constexpr std::uint32_t kGreatestCount = 6;
  // Half of them of modules of all kinds.
  const std::uint32_t kind = choices.below(2 * kRandomKindCount);
  const std::size_t leaf_count = 1 + choices.below(kGreatestCount);
  return random_design(kind < kRandomKindCount ? static_cast<RandomKind>(kind)
                                               : RandomKind::kModules,
                       choices, leaf_count) +
         "\n";
}

}  // namespace

std::size_t law_count() { return std::size(kLaws); }
const char* law_name(std::size_t law) { return kLaws[law].name; }

Operands draw_operands(std::size_t law, Choices& choices) {
  const auto draw = [&] {
    if (!kLaws[law].is_of_shapes) return draw_design(choices);
    return random_shape(choices, 1 + choices.below(6)) + "\n";
  };
  Operands operands;
  operands.heights = draw_heights(choices);
  operands.a = draw();
  operands.b = draw();
  operands.c = draw();
  return operands;
}

std::string try_law(std::size_t law, const Operands& operands,
                    LawTally& tally) {
  ++tally.trials;
  const auto told = [&](const std::string& complaint) {
    return fmt::format("{}: {}\nheights {}\nA:\n{}B:\n{}C:\n{}", law_name(law),
                       complaint, fmt::join(operands.heights, ", "), operands.a,
                       operands.b, operands.c);
  };
  try {
    Operands clear = operands;
    if (!kLaws[law].is_of_shapes) {
      for (const std::string* design :
           {&operands.a, &operands.b, &operands.c}) {
        clear.heights = clear_heights(*design, clear.heights);
      }
    }
    if (!clear.heights.empty()) kLaws[law].check(clear);
  } catch (const Refused& refused) {
    ++tally.refused;
    tally.last_refusal = refused.message;
  } catch (const BrokenLaw& broken) {
    return told(broken.complaint);
  } catch (const std::exception& error) {
    return told(error.what());
  }
  return {};
}

}  // namespace lamina::support
