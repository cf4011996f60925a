#include "csg/eval/evaluator.h"

#include <filesystem>
#include <vector>

#include "csg/eval/interpreter.h"
#include "csg/eval/resolver.h"

namespace lamina::csg {

namespace {

// The `$` variables that are there before the program begins.
void bind_well_known(const EvaluateOptions& options, Interpreter& in) {
  const double zero[] = {0, 0, 0};
  in.bind_dynamic(kFn, Value(0.0));
  in.bind_dynamic(kFa, Value(12.0));
  in.bind_dynamic(kFs, Value(2.0));
  in.bind_dynamic(kTime, Value(options.time));
  in.bind_dynamic(kPreview, Value(options.preview));
  in.bind_dynamic(kViewTranslation, Value::numbers(zero));
  in.bind_dynamic(kViewRotation, Value::numbers(zero));
  in.bind_dynamic(kViewDistance, Value(500.0));
  in.bind_dynamic(kViewField, Value(22.5));
}

void run_program(Unit& unit, Interpreter& in) {
  Frame frame{in};
  std::vector<Value> slots(unit.activation.slot_count, Value::unset());
  frame.slots = slots.data();
  run_block(unit.body, frame);
}

}  // namespace

Tree evaluate(const ast::Program& program, const Loader& loader,
              const EvaluateOptions& options, Diagnostics& diagnostics) {
  Tree tree;
  tree.arena = std::make_shared<std::pmr::monotonic_buffer_resource>(1 << 16);
  Resolver resolver(loader);
  Unit& unit = resolver.unit_of(program);
  Interpreter in(resolver, options, diagnostics, *tree.arena);
  in.set_design_folder(
      std::filesystem::absolute(program.source->path()).parent_path().string());
  resolver.resolve(unit);
  in.grow_dynamic();
  bind_well_known(options, in);
  try {
    run_program(unit, in);
  } catch (EvaluationFailure& failure) {
    in.drop_nodes(0);
    diagnostics.report(std::move(failure.diagnostic));
  }
  InstantiationCode root;
  root.name = "group";
  in.make_node(Group{}, root, 0);
  tree.root = in.nodes_since(0)[0];
  return tree;
}

namespace {
// Preorder, as OpenSCAD looks for it: a node, then what is below it.
void find_roots(const Node& node, std::vector<const Node*>& roots) {
  for (const Node* child : node.children) {
    if (child->is_root) roots.push_back(child);
    find_roots(*child, roots);
  }
}
}  // namespace

const Node* select_root(const Tree& tree, Diagnostics& diagnostics) {
  std::vector<const Node*> roots;
  find_roots(*tree.root, roots);
  if (roots.empty()) return tree.root;
  for (const Node* other : roots) {
    if (other->range.source != roots[0]->range.source ||
        other->range.begin != roots[0]->range.begin) {
      diagnostics.warning(other->range, "More than one Root Modifier (!)");
      break;
    }
  }
  return roots[0];
}

}  // namespace lamina::csg
