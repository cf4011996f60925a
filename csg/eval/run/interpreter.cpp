#include "csg/eval/run/interpreter.h"

#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <sanitizer/asan_interface.h>

#include "csg/eval/value/operators.h"
#include "csg/support_tip.h"

namespace lamina::csg {

namespace {
std::uintptr_t lowest_stack(std::uintptr_t highest, std::size_t bytes) {
  // Stack for building a message, below the last frame that passed the check.
  constexpr std::size_t kReserve = 64 << 10;
  const std::size_t usable = bytes > 2 * kReserve ? bytes - kReserve : kReserve;
  return highest > usable ? highest - usable : 0;
}
}  // namespace

Interpreter::Interpreter(LazyResolver& resolver, DynamicNames& names,
                         const FileAccess& access,
                         const EvaluateOptions& options,
                         Diagnostics& diagnostics, Arena& arena, Arena& calls)
    : random(options.seed),
      resolver_(resolver),
      names_(names),
      access_(access),
      options_(options),
      diagnostics_(diagnostics),
      arena_(arena),
      calls_(calls),
      stack_begin_(
          reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0))),
      stack_limit_(lowest_stack(stack_begin_, options.stack_bytes)),
      steps_left_(options.max_steps) {
  make_room();
}

// Frees boxes in cycles: once a box is empty, the closures that it held let go.
Interpreter::~Interpreter() {
  while (boxes_.next != nullptr) {
    Box* box = boxes_.next;
    {
      const Value let_go = std::move(box->value);
      box->value = Value();
    }
    // Another value may still hold it.
    if (boxes_.next == box) box->leave_list();
  }
}

// --- Messages ---------------------------------------------------------------

void Interpreter::report_warning(Diagnostic warning) {
  ++effects_;
  // The calls that lead to a hard warning are noted like those of an error.
  if (diagnostics_.has_hard_warnings()) fail(std::move(warning));
  diagnostics_.report(std::move(warning));
}

void Interpreter::warn(SourceRange range, std::string message,
                       const Source* document, std::vector<Note> hints) {
  report_warning({.severity = Severity::kWarning,
                  .range = range,
                  .message = std::move(message),
                  .hints = std::move(hints),
                  .document = document});
}

void Interpreter::warn_of_arguments(const ArgumentPlan& plan, SourceRange range,
                                    const Source* document) {
  for (const ArgumentWarning& warning : plan.warnings) {
    warn(range, warning.words, document, hint_of(warning.hint));
  }
}

void Interpreter::warn_of_unknown(Named kind, SourceRange range,
                                  std::string_view name,
                                  const Source* document) {
  constexpr std::array<std::string_view, 3> kWords = {"variable", "function",
                                                      "module"};
  const bool is_variable = kind == Named::kVariable;
  Diagnostic warning{
      .severity = Severity::kWarning,
      .range = range,
      .message = fmt::format(
          "Ignoring unknown {} {}", kWords[static_cast<std::size_t>(kind)],
          quoted_name(name, is_variable ? language() : Language::k2021, "'")),
      .document = document};
  warning.hints = hint_of(
      is_variable && range.is_defined_by_option()
          ? "a text needs quotes that the shell leaves: -D 'name=\"text\"'"
          : resolver_.did_you_mean(kind, name));
  report_warning(std::move(warning));
}

// Reports each text once for each place.
void Interpreter::deprecate(SourceRange range, std::string message,
                            const Source* document) {
  ++effects_;
  std::string place = "-";
  if (range.is_known()) {
    place = fmt::format("{}:{}", range.source->path(),
                        range.source->line_column(range.begin).line);
  }
  if (!deprecations_.emplace(std::move(place), message).second) return;
  diagnostics_.report({.severity = Severity::kDeprecated,
                       .range = range,
                       .message = std::move(message),
                       .document = document});
}

void Interpreter::echo(std::string text) {
  ++effects_;
  diagnostics_.echo(std::move(text));
}

void Interpreter::note(std::string text) {
  ++effects_;
  diagnostics_.report({Severity::kPlain, {}, std::move(text)});
}

void Interpreter::fail(SourceRange range, std::string message,
                       const Source* document) {
  fail({.range = range, .message = std::move(message), .document = document});
}

void Interpreter::fail(Diagnostic diagnostic) {
  failure_ = std::make_unique<Diagnostic>(std::move(diagnostic));
  throw_failure();
}

void Interpreter::fail_newer(SourceRange range, std::string_view what) {
  newer_ = NewerSyntax{range, what};
  throw_failure();
}

void Interpreter::throw_failure() {
  // Tell AddressSanitizer that the exception leaves these frames: on a stack as
  // large as this one it does not see that. In other builds this does nothing.
  void* const here = __builtin_frame_address(0);
  ASAN_UNPOISON_MEMORY_REGION(
      here, stack_begin_ - reinterpret_cast<std::uintptr_t>(here));
  throw EvaluationFailure();
}

void Interpreter::note_call(std::string_view name, SourceRange range,
                            const Source* document) {
  constexpr std::size_t kMostNotes = 12;
  if (failure_->notes.size() == kMostNotes) return;
  failure_->notes.push_back(
      {range, fmt::format("called by '{}'", name), document});
}

void Interpreter::fail_recursion(SourceRange range, std::string_view kind,
                                 std::string_view name,
                                 const Source* document) {
  Diagnostic diagnostic{
      .range = range,
      .message = fmt::format("Recursion detected calling {} '{}'", kind, name),
      .document = document};
  if (depth_ > options_.max_depth) {
    diagnostic.hints.push_back(
        {range, fmt::format("{} calls are nested, the limit of --max-depth",
                            options_.max_depth)});
  }
  fail(std::move(diagnostic));
}

void Interpreter::fail_steps() {
  fail({},
       fmt::format("Evaluation takes more than {} steps", options_.max_steps),
       nullptr);
}

// --- Variables --------------------------------------------------------------

void Interpreter::make_room() {
  const CodeCounts counts = resolver_.counts();
  dynamic_.resize(names_.size(), Value::unset());
  unit_values_.resize(counts.units);
  last_plans_.resize(counts.calls);
  tail_values_.resize(counts.tail_defaults, Value::unset());
}

void Interpreter::bind_dynamic(std::uint32_t index, Value value) {
  dynamic_[index].swap(value);
  trail_.push_back({index, std::move(value)});
}

void Interpreter::rebind_dynamic(std::uint32_t index, Value value,
                                 std::size_t mark) {
  for (std::size_t i = trail_.size(); i > mark; --i) {
    if (trail_[i - 1].index == index) {
      dynamic_[index] = std::move(value);
      return;
    }
  }
  bind_dynamic(index, std::move(value));
}

void Interpreter::unwind_trail(std::size_t mark) {
  while (trail_.size() > mark) {
    dynamic_[trail_.back().index] = std::move(trail_.back().value);
    trail_.pop_back();
  }
}

void Interpreter::assign_unusual(const Target& target, Value value,
                                 Frame& frame) {
  if (target.kind == Target::Kind::kSlot) {
    frame.slots[target.index].as_box().value = std::move(value);
  } else if (target.kind == Target::Kind::kDynamic) {
    bind_dynamic(target.index, std::move(value));
  }
}

void Interpreter::bind_module_depth() {
  const std::optional<std::uint32_t> index = names_.find("$parent_modules");
  if (!index || *index >= dynamic_.size()) return;
  bind_dynamic(*index, Value(static_cast<double>(module_names.size())));
}

Value Interpreter::make_box() {
  auto* box = new Box;
  box->previous = &boxes_;
  box->next = boxes_.next;
  if (box->next != nullptr) box->next->previous = box;
  boxes_.next = box;
  return Value::adopt(Type::kBox, box, 0);
}

void Interpreter::add_file(const std::string& path) {
  if (!known_files_.insert(path).second) return;
  files_.push_back(path);
  file_access().note_input(path);
}

const LiteralCall& Interpreter::find_plan(const CallCode& call,
                                          const FunctionLiteral& literal) {
  const LiteralCall& plan = resolver_.plan_for(call, literal);
  make_room();
  last_plans_[call.number] = {&literal, &plan};
  return plan;
}

// --- Used files -------------------------------------------------------------

void Interpreter::note_own_dynamic(const Unit& unit, std::uint32_t index,
                                   const Value& of_caller, const Value& own) {
  if (difference_ || are_equal(of_caller, own)) return;
  for (const Binding& binding : unit.body.assignments) {
    if (binding.target.kind == Target::Kind::kDynamic &&
        binding.target.index == index) {
      note_difference(binding.range,
                      "only 2021.01 sets it for calls from other files");
    }
  }
}

// In 2021 what is called sees the `$` variables that its file sets; in 2026
// only the file's own assignments do.
Frame& Interpreter::enter_unit(const Unit& unit) {
  if (!unit.is_resolved) resolve(unit);
  if (const UnitValues& known = unit_values_[unit.number];
      known.frame != nullptr) {
    if (is_2021()) {
      for (const auto& [index, value] : known.dynamic_values) {
        note_own_dynamic(unit, index, dynamic_[index], value);
        bind_dynamic(index, value);
      }
    }
    return *known.frame;
  }
  unit_frames_.push_back({Frame{*this}, {}});
  UnitFrame& made = unit_frames_.back();
  made.slots.resize(unit.slot_count, Value::unset());
  made.frame.slots = made.slots.data();
  made.frame.document = unit.document;
  const std::uint64_t effects = effects_;
  const std::size_t mark = trail_.size();
  run_assignments(unit.body, made.frame);
  if (effects_ == effects) {
    UnitValues& known = unit_values_[unit.number];
    for (std::size_t i = mark; i < trail_.size(); ++i) {
      known.dynamic_values.emplace_back(trail_[i].index,
                                        dynamic_[trail_[i].index]);
    }
    known.frame = &made.frame;
  }
  if (!is_2021()) {
    unwind(mark);
  } else {
    for (std::size_t i = mark; i < trail_.size(); ++i) {
      const auto& [index, of_caller] = trail_[i];
      note_own_dynamic(unit, index, of_caller, dynamic_[index]);
    }
  }
  return made.frame;
}

// --- Nodes ------------------------------------------------------------------

const Mat4* Interpreter::keep_matrix(const Mat4& matrix) {
  const double mix = matrix[0].x + 3 * matrix[0].y + 5 * matrix[1].z +
                     7 * matrix[3].x + 11 * matrix[3].y + 13 * matrix[3].z;
  const std::size_t slot =
      (std::bit_cast<std::uint64_t>(mix) * 0x9e3779b97f4a7c15u) >> 58;
  const Mat4*& kept = recent_matrices_[slot];
  // Bits must be equal: -0 is not 0 in `.csg`.
  // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): what is wanted
  if (kept == nullptr || std::memcmp(kept, &matrix, sizeof matrix) != 0) {
    kept = keep(matrix);
  }
  return kept;
}

void Interpreter::add_nodes(std::span<const Node* const> nodes,
                            std::size_t leaves, SourceRange range) {
  if (leaves > leaves_left()) fail_leaves(range);
  leaf_count_ += static_cast<std::uint32_t>(leaves);
  nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
}

void Interpreter::fail_leaves(SourceRange range) {
  // The root of what has been made until now still becomes a node.
  leaf_count_ = options_.max_leaves + 1;
  fail(range,
       fmt::format("Too many leaves: more than the {} that --max-leaves allows",
                   options_.max_leaves),
       nullptr);
}

float Interpreter::support_tip() const {
  const Value& value = dynamic_[kSupport];
  if (value.is_undef()) return kNoSupportTip;
  std::optional<double> tip;
  if (value.is_string()) tip = support_tip_named(value.as_string());
  if (value.is_number() &&
      (value.as_number() == 0 || (value.as_number() >= kLeastSupportTip &&
                                  value.as_number() <= kGreatestSupportTip))) {
    tip = value.as_number();
  }
  return static_cast<float>(
      tip.value_or(std::numeric_limits<double>::quiet_NaN()));
}

void Interpreter::make_node(decltype(Node::op) op,
                            const InstantiationCode& code, std::size_t mark) {
  if (mark == nodes_.size()) {
    if (leaf_count_ == options_.max_leaves) fail_leaves(code.range);
    ++leaf_count_;
  }
  Node* node = arena_.make(Node());
  node->op = op;
  node->children = keep_all(nodes_since(mark));
  node->range = code.range;
  node->caller = current_call;
  node->support_tip = support_tip();
  node->is_visible = dynamic_[kVisible].is_true();
  node->is_rigid = dynamic_[kRigid].is_true();
  node->is_root = code.modifiers.root;
  node->is_highlight = code.modifiers.highlight;
  node->is_background = code.modifiers.background;
  nodes_.resize(mark);
  nodes_.push_back(node);
}

}  // namespace lamina::csg
