#include "csg/solid/lower.h"

#include <cstddef>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "csg/solid/detail/lowerer.h"

namespace lamina::csg {
namespace {

// What a walk over the tree tells before it is lowered.
struct Survey {
  const Node* root_modifier = nullptr;  // first node with `!`
  std::size_t childless = 0;            // most of these are leaves
};

void survey(const Node& node, Survey& result) {
  if (node.children.empty()) ++result.childless;
  for (const Node* child : node.children) {
    if (child->is_root && !result.root_modifier) result.root_modifier = child;
    survey(*child, result);
  }
}

std::vector<Note> call_chain(const Node& node) {
  std::vector<Note> notes;
  for (const CallFrame* frame = node.caller; frame; frame = frame->caller) {
    notes.push_back({frame->range, fmt::format("called by '{}'", frame->name)});
  }
  return notes;
}

}  // namespace

void fail_unsupported(const Node& node, std::string_view module) {
  throw GeometryError({Severity::kError, node.range,
                       fmt::format("Module '{}' is not supported yet", module),
                       call_chain(node)});
}

Lowerer::Lowerer(std::size_t instances, const LowerOptions& options,
                 Diagnostics& diagnostics)
    : options_(options), diagnostics_(diagnostics) {
  builder_.reserve(instances);
}

Shape Lowerer::lower(const Node& node, const Affine& world) {
  return std::visit([&](const auto& op) { return lower_op(op, node, world); },
                    node.op);
}

Scene Lowerer::take_scene() {
  Scene scene;
  builder_.finish(scene);
  scene.leaves = leaves_.take();
  return scene;
}

Lowered lower(const Tree& tree, const LowerOptions& options,
              Diagnostics& diagnostics) {
  Survey found;
  survey(*tree.root, found);
  const Node* root = found.root_modifier ? found.root_modifier : tree.root;
  Lowerer lowerer(found.childless, options, diagnostics);
  Shape shape = lowerer.lower(*root, options.world_from_design);
  if (!shape.region.is_empty()) return {std::move(shape.region)};
  if (lowerer.has_parts()) return {lowerer.take_scene()};
  return {};
}

}  // namespace lamina::csg
