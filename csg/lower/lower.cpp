#include "csg/lower/lower.h"

#include <cstddef>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "csg/limits.h"
#include "csg/lower/detail/cad_file.h"
#include "csg/lower/detail/lowerer.h"

namespace lamina::csg {
namespace {

// What a walk over the tree finds before it is lowered.
struct Survey {
  const Node* root_modifier = nullptr;  // first node with `!`
  std::size_t childless = 0;            // most of these are leaves
  bool has_parts = false;               // of CAD programs
};

void survey(const Node& node, Survey& result) {
  if (node.children.empty()) ++result.childless;
  const auto* import = std::get_if<Import>(&node.op);
  if (import && is_cad(import->params->format)) result.has_parts = true;
  for (const Node* child : node.children) {
    if (child->is_root && !result.root_modifier) result.root_modifier = child;
    survey(*child, result);
  }
}

std::vector<Note> call_chain(const CallSite* caller) {
  std::vector<Note> notes;
  for (const CallSite* call = caller; call; call = call->caller) {
    notes.push_back({call->range, fmt::format("called by '{}'", call->name)});
  }
  return notes;
}

// Calls work(); to a limit that it exceeds the place in the text is added.
template <typename Work>
auto add_place(SourceRange range, const CallSite* caller, const Work& work) {
  try {
    return work();
  } catch (const plane::LimitExceeded& limit) {
    throw GeometryError({Severity::kError, range, limit.diagnostic().message,
                         call_chain(caller)});
  }
}

// Whether the instance makes the scene's box too large.
bool stretches(const Box3& box, const Box3& whole) {
  for (int i = 0; i < 3; ++i) {
    if (box.low[i] == whole.low[i] && plane::is_too_far(box.low[i]))
      return true;
    if (box.high[i] == whole.high[i] && plane::is_too_far(box.high[i]))
      return true;
  }
  return false;
}

// Rejects a result that is too large. Subtrahends may have any size.
void check_range(const Scene& scene) {
  if (scene.box.is_empty()) return;
  for (const Instance& instance : scene.instances) {
    if (!stretches(instance.box, scene.box)) continue;
    add_place(instance.range, instance.caller, plane::fail_too_far);
  }
}

}  // namespace

void fail_unsupported(const Node& node, std::string_view module) {
  throw GeometryError({Severity::kError, node.range,
                       fmt::format("Module '{}' is not supported yet", module),
                       call_chain(node.caller)});
}

Lowerer::Lowerer(std::size_t instances, const LowerOptions& options,
                 SharedTables& shared, Diagnostics& diagnostics)
    : options_(options), shared_(shared), diagnostics_(diagnostics) {
  builder_.reserve(instances);
}

Shape Lowerer::lower(const Place& at) {
  return add_place(at.node.range, at.node.caller, [&] {
    if (begins_rigid(at.node)) return lower_rigid(at);
    return lower_node(at);
  });
}

Shape Lowerer::lower_node(const Place& at) {
  return std::visit([&](const auto& op) { return lower_op(op, at); },
                    at.node.op);
}

bool Lowerer::begins_rigid(const Node& node) const {
  if (!node.is_rigid || is_rigid_ || options_.scale == Vec3(1)) return false;
  const auto* group = std::get_if<Group>(&node.op);
  return group != nullptr ? group->is_call
                          : !std::holds_alternative<Transform>(node.op) &&
                                !std::holds_alternative<Color>(node.op);
}

// Its frame is where the scale puts it, and has the size that the design gives.
Shape Lowerer::lower_rigid(const Place& at) {
  const Affine& world = at.world;
  const Vec3 scale = options_.scale;
  const Affine moved = {world[0] / scale, world[1] / scale, world[2] / scale,
                        world[3]};
  is_rigid_ = true;
  Shape shape = lower_node({at.node, is_apart_ ? world : moved, at.joins});
  is_rigid_ = false;
  if (is_apart_ || shape.dimension == Dimension::kFlat) {
    diagnostics_.own_warning(
        at.node.range,
        is_apart_ ? "$rigid does nothing inside hull(), minkowski(), resize() "
                    "and projection(): give it to them"
                  : "$rigid does nothing for an outline: give it to the solid "
                    "that is made of it");
  }
  return shape;
}

Scene Lowerer::take_scene() {
  Scene scene;
  builder_.finish(scene);
  scene.leaves = leaves_.take();
  return scene;
}

Scene Lowerer::take_solids() {
  builder_.drop_flat();
  return take_scene();
}

Lowered lower(const Tree& tree, const LowerOptions& options,
              Diagnostics& diagnostics) {
  Survey found;
  survey(*tree.root, found);
  const Node* root = found.root_modifier ? found.root_modifier : tree.root;
  SharedTables shared;
  LowerOptions of_tree = options;
  of_tree.language = tree.language;
  if (!found.has_parts) of_tree.chordal_error_of_parts = 0;
  Lowerer lowerer(found.childless, of_tree, shared, diagnostics);
  const Affine& turn = options.world_from_design;
  const Vec3 scale = options.scale;
  Shape shape = lowerer.lower(
      {*root,
       {scale * turn[0], scale * turn[1], scale * turn[2], scale * turn[3]}});
  if (!shape.region.is_empty()) {
    for (plane::Contour& contour : shape.region.contours) {
      for (Vec2& point : contour) point *= Vec2(scale);
    }
    return {std::move(shape.region)};
  }
  Scene scene = lowerer.take_solids();
  if (scene.instances.empty()) return {};
  check_range(scene);
  return {std::move(scene)};
}

}  // namespace lamina::csg
