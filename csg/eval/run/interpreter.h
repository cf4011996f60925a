#pragma once
// The state of one evaluation, and the services that running code needs.

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "base/arena.h"
#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "csg/eval/code/code.h"
#include "csg/eval/code/dynamic_names.h"
#include "csg/eval/code/lazy_resolver.h"
#include "csg/eval/run/evaluate_options.h"
#include "csg/eval/run/random.h"
#include "csg/eval/value/lookup_tables.h"
#include "csg/eval/value/value.h"
#include "csg/tree.h"

namespace lamina::csg {

// A call's name in messages.
inline std::string shown_name(const InstantiationCode& code) {
  return std::string(code.name);
}
std::string shown_name(const CallCode& code);

// Thrown to end the evaluation; the interpreter keeps the message.
struct EvaluationFailure {};

class Interpreter {
 public:
  // All that it refers to must outlive it.
  //
  // names   of the `$` variables, which resolving may add to
  // arena   for nodes
  // calls   for the calls that nodes come from
  Interpreter(LazyResolver& resolver, DynamicNames& names,
              const FileAccess& access, const EvaluateOptions& options,
              Diagnostics& diagnostics, Arena& arena, Arena& calls);
  ~Interpreter();
  Interpreter(const Interpreter&) = delete;
  Interpreter& operator=(const Interpreter&) = delete;

  // --- Messages
  // `document` is that of the frame where OpenSCAD shows places relative to the
  // code's file, and null where it shows them relative to the design.
  void warn(SourceRange range, std::string message,
            const Source* document = nullptr, std::vector<Note> hints = {});
  void warn_of_arguments(const ArgumentPlan& plan, SourceRange range,
                         const Source* document);
  void warn_of_unknown(Named kind, SourceRange range, std::string_view name,
                       const Source* document = nullptr);
  void deprecate(SourceRange range, std::string message,
                 const Source* document = nullptr);
  void echo(std::string text);
  // A line without prefix and place.
  void note(std::string text);
  [[noreturn]] void fail(Diagnostic diagnostic);
  [[noreturn]] void fail(SourceRange range, std::string message,
                         const Source* document);

  [[noreturn]] void fail_recursion(SourceRange range, std::string_view kind,
                                   std::string_view name,
                                   const Source* document);
  // Says that what runs does nothing in 2021.01. Ends the evaluation where the
  // language is still to be found.
  void note_newer(SourceRange range, std::string_view what) {
    if (options_.finds_language && range.is_known()) fail_newer(range, what);
  }
  const std::optional<NewerSyntax>& newer() const { return newer_; }
  // Says that the other language takes something else here.
  void note_difference(SourceRange range, std::string_view what) {
    if (!difference_) difference_ = NewerSyntax{range, what};
  }
  const std::optional<NewerSyntax>& difference() const { return difference_; }
  // The message that ended the evaluation: an error or, under hard warnings, a
  // warning.
  Diagnostic take_failure() { return std::move(*failure_); }

  // Counts a call or a turn of a loop. Throws at one too many.
  void count_step() {
    if (steps_left_-- == 0) [[unlikely]]
      fail_steps();
  }

  // --- Calls being run
  std::uint32_t depth() const { return depth_; }
  // Whether calls are nested too deep, or the C++ stack is nearly used up.
  bool is_too_deep() const {
    return depth_ > options_.max_depth ||
           reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) <
               stack_limit_;
  }
  // Throws OpenSCAD's error in that case.
  void check_depth(SourceRange range, std::string_view kind,
                   std::string_view name, const Source* document) {
    if (is_too_deep()) fail_recursion(range, kind, name, document);
  }
  void enter_call() {
    count_step();
    ++depth_;
  }
  template <typename Code>
  void leave_call(const Code& code, const Source* document) {
    --depth_;
    if (failure_ != nullptr) note_call(shown_name(code), code.range, document);
  }

  // --- Variables
  // The value of a `$` variable; unset where nothing set it.
  const Value& dynamic(std::uint32_t index) {
    ++effects_;
    return dynamic_[index];
  }
  void bind_dynamic(std::uint32_t index, Value value);
  // For a tail call: replaces what was bound since `mark`, so that a loop of a
  // million calls leaves one entry.
  void rebind_dynamic(std::uint32_t index, Value value, std::size_t mark);
  std::size_t trail_size() const { return trail_.size(); }
  void unwind(std::size_t mark) {
    if (trail_.size() != mark) unwind_trail(mark);
  }
  void assign(const Target& target, Value&& value, Frame& frame) {
    if (target.kind == Target::Kind::kSlot &&
        (target.variable == nullptr || !target.variable->is_boxed)) [[likely]] {
      frame.slots[target.index] = std::move(value);
    } else {
      assign_unusual(target, std::move(value), frame);
    }
  }
  // Gives a boxed variable a fresh box, so that closures made from now on do
  // not share it with those made before.
  Value make_box();
  // The number of a well-known `$` variable: 0 for what is not a number.
  double dynamic_number(std::uint32_t index) {
    return dynamic(index).number_or_zero();
  }

  // Sets `$parent_modules` to the number of modules being instantiated.
  void bind_module_depth();

  // --- Calls
  // The variables of a used file, assigned anew, as OpenSCAD does for every
  // call, unless its assignments depend on nothing outside.
  Frame& enter_unit(const Unit& unit);
  // Resolves what is called for the first time.
  void ensure_resolved(const Function& function) {
    if (function.body == nullptr) [[unlikely]]
      resolve(function);
  }
  void ensure_resolved(const Module& module) {
    if (!module.is_resolved) [[unlikely]]
      resolve(module);
  }
  const LiteralCall& plan_for(const CallCode& call,
                              const FunctionLiteral& literal) {
    const LastPlan& last = last_plans_[call.number];
    return last.literal == &literal ? *last.plan : find_plan(call, literal);
  }
  // The value of a jump's fallback; unset until `set_tail_value`.
  const Value& tail_value(std::uint32_t number) const {
    return tail_values_[number];
  }
  void set_tail_value(std::uint32_t number, Value value) {
    tail_values_[number] = std::move(value);
  }
  // Whether the call at `range` asks for the first time.
  bool is_first_of_call(SourceRange range) {
    return calls_seen_.emplace(range.source, range.begin, range.end).second;
  }
  DynamicNames& dynamic_names() { return names_; }

  // --- Nodes
  std::size_t node_mark() const { return nodes_.size(); }
  // Replaces the nodes made since `mark` by one with these children. Fails
  // where the tree gets too many leaves.
  void make_node(decltype(Node::op) op, const InstantiationCode& code,
                 std::size_t mark);
  // Adds nodes that were made elsewhere, with so many leaves in all.
  void add_nodes(std::span<const Node* const> nodes, std::size_t leaves,
                 SourceRange range);
  // Leaves that the tree can still get.
  std::size_t leaves_left() const {
    return options_.max_leaves - std::size_t{leaf_count_};
  }
  Arena& node_arena() { return arena_; }
  void drop_nodes(std::size_t mark) { nodes_.resize(mark); }
  std::span<const Node* const> nodes_since(std::size_t mark) const {
    return {nodes_.data() + mark, nodes_.size() - mark};
  }
  // Copies that live as long as the tree.
  template <typename T>
  const T* keep(const T& value) {
    return arena_.make(value);
  }
  template <typename T>
  std::span<const T> keep_all(std::span<const T> values) {
    return arena_.copy(values);
  }
  std::string_view keep_text(std::string_view text) {
    return arena_.copy(text);
  }
  // Designs turn many parts alike: recent matrices are kept once.
  const Mat4* keep_matrix(const Mat4& matrix);

  // --- Files
  // What the design may read.
  const FileAccess& file_access() const { return access_; }
  // Remembers a path that a module or function names.
  void add_file(const std::string& path);
  std::vector<std::string> take_files() { return std::move(files_); }

  // --- Modules being instantiated
  std::vector<std::string_view>
      module_names;  // of user modules, innermost last
  const CallSite* current_call = nullptr;
  const CallSite* keep_call(const CallSite& call) { return calls_.make(call); }

  // For rands() and lookup().
  MersenneTwister random;
  LookupTables& lookup_tables() { return lookup_tables_; }
  std::uint64_t& effects() { return effects_; }
  const EvaluateOptions& options() const { return options_; }
  Language language() const { return options_.language; }
  bool is_2021() const { return options_.language == Language::k2021; }
  const std::string& design_folder() const { return design_folder_; }
  void set_design_folder(std::string folder) {
    design_folder_ = std::move(folder);
  }

 private:
  void report_warning(Diagnostic warning);
  struct Saved {
    std::uint32_t index;
    Value value;
  };

  void assign_unusual(const Target& target, Value value, Frame& frame);
  // Notes a difference where the caller has another value of the `$` variable
  // that the file sets.
  void note_own_dynamic(const Unit& unit, std::uint32_t index,
                        const Value& of_caller, const Value& own);
  [[noreturn]] void fail_steps();
  [[noreturn]] void fail_newer(SourceRange range, std::string_view what);
  // Leaves for the evaluator.
  [[noreturn]] void throw_failure();
  [[noreturn]] void fail_leaves(SourceRange range);
  void note_call(std::string_view name, SourceRange range,
                 const Source* document);
  void unwind_trail(std::size_t mark);
  template <typename Code>
  [[gnu::noinline]] void resolve(const Code& code) {
    resolver_.resolve(code);
    make_room();
  }
  const LiteralCall& find_plan(const CallCode& call,
                               const FunctionLiteral& literal);
  // Extends the tables to what resolving brought up.
  void make_room();
  // The value of `$support` for the tree.
  float support_tip() const;

  LazyResolver& resolver_;
  DynamicNames& names_;
  const FileAccess& access_;
  const EvaluateOptions& options_;
  Diagnostics& diagnostics_;
  Arena& arena_;
  Arena& calls_;
  std::uintptr_t stack_begin_;  // the stack grows down from here
  std::uintptr_t stack_limit_;
  std::uint32_t depth_ = 0;
  std::uint64_t steps_left_;
  std::unique_ptr<Diagnostic> failure_;  // while it makes its way out
  std::optional<NewerSyntax> newer_;     // likewise
  std::optional<NewerSyntax> difference_;
  std::string design_folder_;
  std::vector<Value> dynamic_;
  std::vector<Saved> trail_;
  // Counts what makes a result depend on more than the text: messages, reads of
  // `$` variables, random numbers.
  std::uint64_t effects_ = 0;
  std::vector<const Node*> nodes_;
  std::uint32_t leaf_count_ = 0;
  std::array<const Mat4*, 64> recent_matrices_{};  // by hash
  std::set<std::pair<std::string, std::string>> deprecations_;
  std::vector<std::string> files_;
  std::set<std::string> known_files_;
  std::set<std::tuple<const Source*, std::uint32_t, std::uint32_t>> calls_seen_;
  Box boxes_;  // sentinel of the list of all boxes
  // Variables of used files, alive as long as closures may refer to them.
  struct UnitFrame {
    Frame frame;
    std::vector<Value> slots;
  };
  std::deque<UnitFrame> unit_frames_;
  // The variables of a file whose assignments depend on nothing outside, and
  // the values that it gives to `$` variables.
  struct UnitValues {
    Frame* frame = nullptr;
    std::vector<std::pair<std::uint32_t, Value>> dynamic_values;
  };
  std::vector<UnitValues> unit_values_;
  // How the arguments of a call met the function literal that it called last.
  struct LastPlan {
    const FunctionLiteral* literal = nullptr;
    const LiteralCall* plan = nullptr;
  };
  std::vector<LastPlan> last_plans_;
  std::vector<Value> tail_values_;
  LookupTables lookup_tables_;
};

// A call while it runs. A failure that passes by is given a note of it, as in
// OpenSCAD's TRACE lines. A destructor adds that note: to catch and throw again
// would cost too much a hundred thousand calls deep.
template <typename Code>
class ActiveCall {
 public:
  ActiveCall(const Code& code, Frame& frame) : code_(code), frame_(frame) {
    frame.in.enter_call();
  }
  ~ActiveCall() { frame_.in.leave_call(code_, frame_.document); }
  ActiveCall(const ActiveCall&) = delete;
  ActiveCall& operator=(const ActiveCall&) = delete;

 private:
  const Code& code_;
  Frame& frame_;
};

// Restores the `$` variables at the end of a scope.
class DynamicScope {
 public:
  explicit DynamicScope(Interpreter& in) : in_(in), mark_(in.trail_size()) {}
  ~DynamicScope() { in_.unwind(mark_); }
  DynamicScope(const DynamicScope&) = delete;
  DynamicScope& operator=(const DynamicScope&) = delete;
  std::size_t mark() const { return mark_; }

 private:
  Interpreter& in_;
  std::size_t mark_;
};

// The slots of a frame, on the C++ stack of the function that makes one:
//   Value* memory = LAMINA_FRAME_MEMORY(count);
//   const FrameSlots slots(frame, memory, count);
#define LAMINA_FRAME_MEMORY(count) \
  (static_cast<Value*>(__builtin_alloca((count) * sizeof(Value))))
class FrameSlots {
 public:
  FrameSlots(Frame& frame, Value* memory, std::uint32_t count)
      : slots_(memory), count_(count) {
    for (std::uint32_t i = 0; i < count; ++i) {
      new (memory + i) Value(Value::unset());
    }
    frame.slots = memory;
  }
  ~FrameSlots() {
    for (std::uint32_t i = 0; i < count_; ++i) slots_[i].~Value();
  }
  FrameSlots(const FrameSlots&) = delete;
  FrameSlots& operator=(const FrameSlots&) = delete;

 private:
  Value* slots_;
  std::uint32_t count_;
};

// The frame that many static links away.
inline Frame* follow_links(Frame& frame, std::uint32_t hops) {
  Frame* outer = &frame;
  for (; hops > 0; --hops) outer = outer->link;
  return outer;
}

// --- Running code -----------------------------------------------------------

inline Value run(const Expression* code, Frame& frame) {
  return code->run(*code, frame);
}
// Not inline: most messages are never made, and their code would slow the hot
// functions.
void warn(Frame& frame, SourceRange range, std::string message);
inline bool is_plain(const Value& value) {
  return !value.is_unset() && value.type() != Type::kBox;
}
// Finds the value of an expression in memory, without a copy, or runs the
// expression into `spill`. Nothing that runs in the meantime moves the value:
// variables of inner scopes have slots of their own, and vectors do not change.
const Value& look_further(const Expression* code, Frame& frame, Value& spill);
[[gnu::always_inline]] inline const Value& look(const Expression* code,
                                                Frame& frame, Value& spill) {
  if (code->kind == Expression::Kind::kLocal &&
      is_plain(frame.slots[code->slot])) {
    return frame.slots[code->slot];
  }
  if (code->kind == Expression::Kind::kConstant) {
    return *static_cast<const Constant*>(code)->value;
  }
  return look_further(code, frame, spill);
}
// Whether `if` takes the value of an expression for true.
inline bool is_true(const Expression* code, Frame& frame) {
  Value spill;
  return look(code, frame, spill).is_true();
}

// Runs `body` in the frame of a call, turning tail calls of the same function
// into jumps.
Value run_body(const Callable& callable, std::string_view name,
               SourceRange range, Frame& frame);

// Run the parts of `{ … }`, or both: assignments, then instantiations, whose
// nodes go on top of the list.
void run_assignments(const Block& block, Frame& frame);
void run_statements(const Block& block, Frame& frame);
void run_block(const Block& block, Frame& frame);
void instantiate(const InstantiationCode& code, Frame& frame);

// Gives a variable that closures share a fresh box.
inline void prepare(const Target& target, Frame& frame) {
  if (target.variable != nullptr && target.variable->is_boxed) {
    frame.slots[target.index] = frame.in.make_box();
  }
}

// Evaluates let-like bindings one after the other.
void run_bindings(Bindings bindings, Frame& frame);

// Whether a call warns of its arguments each time or only the first time.
enum class Repeats : std::uint8_t { kReported, kSilent };

// Stores arguments and defaults of a call into the callee's frame.
void pass_arguments(const ArgumentPlan& plan,
                    std::span<const Parameter> parameters,
                    std::span<const WrittenArgument> arguments,
                    SourceRange range, Frame& caller, Frame& callee,
                    Repeats repeats = Repeats::kReported);

// "a = 1, 2" as echo prints its arguments.
std::string echo_text(std::span<const WrittenArgument> arguments, Frame& frame);
void run_assert(const AssertCode& code, Frame& frame);

}  // namespace lamina::csg
