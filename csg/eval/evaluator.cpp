#include "csg/eval/evaluator.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include <fmt/format.h>

#include "csg/eval/builtin/conversions.h"
#include "csg/eval/resolve/resolver.h"
#include "csg/eval/run/interpreter.h"
#include "csg/eval/value/text.h"
#include "parser/loader.h"

namespace lamina::csg {

namespace {

// The `$` variables that are there before the program begins.
void bind_well_known(const EvaluateOptions& options, Interpreter& in) {
  const bool is_2021 = options.language == Language::k2021;
  const double zero[] = {0, 0, 0};
  const double aslant[] = {55, 0, 25};
  in.bind_dynamic(kFn, Value(0.0));
  in.bind_dynamic(kFa, Value(12.0));
  in.bind_dynamic(kFs, Value(2.0));
  in.bind_dynamic(kTime, Value(options.time));
  in.bind_dynamic(kPreview, Value(options.preview));
  in.bind_dynamic(kViewTranslation, Value::numbers(zero));
  in.bind_dynamic(kViewRotation, Value::numbers(is_2021 ? zero : aslant));
  in.bind_dynamic(kViewDistance, Value(is_2021 ? 500.0 : 140.0));
  in.bind_dynamic(kViewField, Value(22.5));
}

void run_program(const Unit& unit, Interpreter& in) {
  Frame frame{in};
  std::vector<Value> slots(unit.slot_count, Value::unset());
  frame.slots = slots.data();
  run_block(unit.body, frame);
}

bool assigns(const Unit& unit, std::uint32_t dynamic_index) {
  return std::any_of(unit.body.assignments.begin(), unit.body.assignments.end(),
                     [&](const Binding& binding) {
                       return binding.target.kind == Target::Kind::kDynamic &&
                              binding.target.index == dynamic_index;
                     });
}

// OpenSCAD sets its camera to what the design says, and says so.
void check_view(const Unit& unit, Interpreter& in) {
  bool is_set = false;
  const auto check = [&](std::uint32_t index, const char* name, bool is_point) {
    if (!assigns(unit, index)) return;
    const Value& value = in.dynamic(index);
    Vec3 point(0.0);
    if (value.is_undef()) return;
    if (is_point ? read_vec3(value, 0.0, point) : value.is_number()) {
      is_set = true;
      return;
    }
    in.warn({},
            fmt::format("Unable to convert {}={} to a {}", name, to_echo(value),
                        is_point ? "vec3 or vec2 of numbers" : "number"));
  };
  check(kViewRotation, "$vpr", true);
  check(kViewTranslation, "$vpt", true);
  check(kViewDistance, "$vpd", false);
  check(kViewField, "$vpf", false);
  // Layers have no camera: only previews say so.
  if (is_set && in.options().preview)
    in.warn({}, "Viewall and autocenter disabled in favor of $vp*");
}

}  // namespace

Tree evaluate(const ast::Program& program, const Loader& loader,
              const EvaluateOptions& options, Diagnostics& diagnostics) {
  Tree tree;
  tree.language = options.language;
  tree.arena = std::make_shared<Arena>();
  tree.calls = std::make_shared<Arena>();
  DynamicNames names;
  Resolver resolver(loader, names, options);
  const Unit& unit = resolver.unit_of(program);
  resolver.resolve(unit);
  Interpreter in(resolver, names, loader.file_access(), options, diagnostics,
                 *tree.arena, *tree.calls);
  in.set_design_folder(
      std::filesystem::absolute(program.source->path()).parent_path().string());
  bind_well_known(options, in);
  const auto report_failure = [&](const auto& pass) {
    try {
      pass(unit, in);
    } catch (const EvaluationFailure&) {
      in.drop_nodes(0);
      if (!in.newer()) diagnostics.report(in.take_failure());
    } catch (const TextTooDeep&) {
      in.drop_nodes(0);
      diagnostics.error({},
                        "Stack exhausted while trying to convert a vector to "
                        "EchoString");
    }
  };
  report_failure(run_program);
  if (!in.newer()) report_failure(check_view);
  InstantiationCode root;
  root.name = "group";
  in.make_node(Group{}, root, 0);
  tree.root = in.nodes_since(0)[0];
  tree.files = in.take_files();
  tree.newer = in.newer();
  tree.difference = in.difference();
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
