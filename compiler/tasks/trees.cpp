#include "compiler/tasks/trees.h"

#include <iterator>
#include <numbers>
#include <set>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "base/text.h"
#include "compiler/compile.h"
#include "compiler/passes.h"
#include "compiler/sprues.h"
#include "compiler/stage_text.h"
#include "csg/design_text.h"
#include "slicer/contour/layer_measures.h"
#include "slicer/slice/scene_parts.h"
#include "slicer/slice/slice.h"
#include "slicer/thickness/solid_samples.h"

namespace lamina::compiler {
namespace {

// The pitch of the rays that find the points of a piece [mm].
constexpr double kPitch = 0.3;

// How much wider the trunk is at its foot.
constexpr double kFootShare = 2;
constexpr double kFootHeight = 5;  // [mm]

constexpr const char* kTrunk = R"(
// Metal flows in at the foot.
module tree_trunk(height, d) {{
  cylinder(d = d, h = height, $fn = 48);
  translate([0, 0, height]) sphere(d = d, $fn = 48);
  cylinder(d1 = {} * d, d2 = d, h = {}, $fn = 48);
}}

)";

constexpr const char* kStem =
    R"(// From the trunk to the root of a piece's sprues.
module tree_stem(from, to, d) {
  hull() {
    translate(from) sphere(d = d, $fn = 32);
    translate(to) sphere(d = d, $fn = 32);
  }
}

)";

void sample(const csg::Scene& scene, slicer::TreePiece& shape) {
  const slicer::SolidSamples samples = slicer::sample_solid(scene, kPitch);
  shape.cover = slicer::kCover * kPitch;
  for (const slicer::SurfacePoint& point : samples.points) {
    auto& points =
        is_sprue(scene.instances[point.instance]) ? shape.sprue : shape.points;
    points.push_back(point.place);
  }
}

// "multmatrix([[1, 0, 0, 2.5], …, [0, 0, 0, 1]])"
std::string matrix_text(const Affine& m) {
  std::string text = "multmatrix([";
  for (int row = 0; row < 3; ++row) {
    fmt::format_to(std::back_inserter(text),
                   "[{:.9g}, {:.9g}, {:.9g}, {:.6g}], ", m[0][row], m[1][row],
                   m[2][row], m[3][row]);
  }
  return text + "[0, 0, 0, 1]])";
}

double trunk_volume(double height, double d) {
  return std::numbers::pi * d * d *
         (height / 4 + d / 12 +
          kFootHeight * (kFootShare * kFootShare + kFootShare + 1 - 3) / 12);
}

}  // namespace

std::optional<TreePart> make_tree_part(Compilation& c) {
  if (!make_tree(c) || !c.report.sprues) return std::nullopt;
  const slicer::SpruePlan& plan = *c.report.sprues;
  TreePart part;
  part.csg = stage_text(c);
  const csg::Lowered lowered = lower_tree(c);
  const csg::Scene& scene = *lowered.scene();
  sample(scene, part.shape);
  part.shape.root = plan.root;
  part.shape.direction = plan.direction;
  part.shape.root_diameter = plan.root_diameter;
  const slicer::Settings settings = settings_of(c.request, {});
  part.shape.volume = slicer::volume_of(slicer::all_layers(scene, settings));
  part.volume = slicer::volume_of(
      slicer::all_layers(slicer::without(scene, is_sprue), settings));
  return part;
}

std::string tree_text(const slicer::CastingTree& tree,
                      std::span<const TreePart> parts,
                      std::span<const std::string> names,
                      const slicer::TreeSizes& sizes) {
  std::string text = fmt::format(
      "// A tree of {} for a flask {:g} mm wide and {:g} mm high inside. Each "
      "line\n// below the modules is a piece: edit, move or delete it.\n",
      counted(tree.placements.size(), "piece"), sizes.flask_diameter,
      sizes.flask_height);
  std::set<std::size_t> used;
  for (const auto& placement : tree.placements) used.insert(placement.piece);
  for (const std::size_t part : used) {
    text += fmt::format("\n// {}\nmodule piece_{}() {{\n{}}}\n",
                        on_one_line(names[part]), part + 1, parts[part].csg);
  }
  text += fmt::format(kTrunk, kFootShare, kFootHeight);
  text += kStem;
  text +=
      fmt::format("tree_trunk({}, {});\n", csg::design_text(tree.trunk_height),
                  csg::design_text(sizes.trunk));
  for (const slicer::TreePlacement& placement : tree.placements) {
    const slicer::TreePiece& piece = parts[placement.piece].shape;
    text += fmt::format(
        "{} piece_{}();\ntree_stem({}, {}, {});\n",
        matrix_text(placement.tree_from_piece), placement.piece + 1,
        csg::design_text(placement.stem),
        csg::design_text(placement.tree_from_piece * Vec4(piece.root, 1)),
        csg::design_text(piece.root_diameter));
  }
  return text;
}

double tree_volume(const slicer::CastingTree& tree,
                   std::span<const TreePart> parts,
                   const slicer::TreeSizes& sizes) {
  double volume = trunk_volume(tree.trunk_height, sizes.trunk);
  for (const slicer::TreePlacement& placement : tree.placements) {
    const slicer::TreePiece& piece = parts[placement.piece].shape;
    const Vec3 root = placement.tree_from_piece * Vec4(piece.root, 1);
    const double out = glm::length(Vec2(root));
    volume += piece.volume;
    if (out <= sizes.trunk / 2) continue;
    // Half of the root's ball is in the stem, and counted already.
    const double d = piece.root_diameter;
    const double length =
        (1 - sizes.trunk / 2 / out) * glm::distance(root, placement.stem);
    volume += std::max(0.0, std::numbers::pi * d * d * (length / 4 - d / 12));
  }
  return volume;
}

}  // namespace lamina::compiler
