#pragma once
// The states of the Boolean program: set membership classification (Tilove
// 1980) for all gaps of the ray at once.
//
// The state of a gap between two entries stands for all that the program can
// ever ask of it. The ray sees no leaves: passing a chain upwards leads from a
// state to another one, and a state is solid or not. A layer meets few states,
// and meets them again at every event point and in the next layer. So a state
// is kept once and known by a number, and a crossing is one look-up in a hash
// table of known crossings.
//
// A state is not the set of leaves that contain the gap. Every operator is the
// test
//     weighted number of children that hold >= threshold
// (program_state.h), so of those of its leaves that cannot overlap themselves
// it asks only how many contain the gap: the sum of weight · winding over the
// chains passed. A union of n leaves has n + 1 states, not 2ⁿ. A leaf that may
// overlap itself is not linear; it is a part of its own, with its count. So
//
//     state = (sum of each operator, count of each leaf that may overlap
//              itself).
//
// Two gaps of one state have one value, now and after the same chains.
//
// The state is stored as a tree of parts that mirrors the program. A part is a
// leaf's count, an operator, the sum over two groups of an operator's children,
// so that wide operators are balanced trees, or two groups of a chain, so that
// deep programs are balanced trees. A chain leads from an operator to the
// largest of its operators, to the largest of that one's, and so on (heavy
// paths, Sleator and Tarjan 1983). On it an operator is a function of whether
// the next one holds, and two groups of them are the one function after the
// other. A cell is one state of one part: two numbers, of its counts or of the
// cells of its parts below. Equal cells are stored once (hash consing, Ershov
// 1958), so a crossing makes at most one new cell for each part between the
// leaf's operator and the root, O(log² n) of them, and the value of a cell is
// known when it is made.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "plane/program/boolean_program.h"

namespace lamina::plane {

class ProgramStates {
 public:
  using State = std::uint32_t;
  using Crossing = std::uint32_t;
  // The state of what no operand contains; never solid.
  static constexpr State kOutside = 0;

  // rule  which counts of a leaf that may overlap itself are inside it
  ProgramStates(const BooleanProgram& program, FillRule rule);

  // The crossing of a chain of `operand`, upwards. Leaves that are counted
  // together have the same crossings.
  Crossing crossing_of(std::uint32_t operand, std::int32_t winding) const {
    return upward_crossings_[operand] ^ (winding < 0 ? 1U : 0U);
  }
  bool may_overlap_itself(std::uint32_t operand) const {
    return parts_[upward_crossings_[operand] >> 1].kind == Kind::kCount;
  }

  State state_above(State state, Crossing crossing) {
    const std::uint64_t key = key_of(state, crossing);
    for (std::size_t i = slot_of(key);; i = (i + 1) & (crossings_.size() - 1)) {
      if (crossings_[i].key == key) return crossings_[i].above;
      if (crossings_[i].key == kFree) return make_state(state, crossing);
    }
  }

  bool is_solid(State state) const { return cells_[state].value > 0; }

  // Whether a state is one number: the sum of the only operator.
  bool is_simple() const { return parts_.size() == 1; }

  // States met since construction; those that were forgotten count again.
  std::uint64_t states_met() const { return states_met_; }

  // Forgets the states of earlier layers where they are too many; only while
  // nobody holds one but kOutside.
  void begin_layer();
  // Whether it is time to call keep_only().
  bool is_full() const { return cost() > most_cost_; }
  // Forgets every state but kOutside and those that `live` points to, and
  // renumbers them there.
  void keep_only(std::span<State* const> live);

 private:
  enum class Kind : std::uint8_t {
    kOperator,  // first: the sum over its leaves; second: a cell, its operands
    kCount,     // first: the count of a leaf that may overlap itself
    kSum,       // first, second: cells
    kChain,     // first, second: cells
  };
  // Whether an operator of a chain, or a group of them, holds where what comes
  // next does not (bit 0), and where it does (bit 1). It comes to one where
  // nothing comes next.
  using Function = std::uint8_t;
  struct Part {
    Kind kind = Kind::kOperator;
    bool is_second = false;       // of the two parts of its parent
    std::int8_t weight = 0;       // in an operator's sum; within a chain 0
    std::int8_t next_weight = 0;  // of the next operator of the chain
    std::int32_t threshold = 1;   // of an operator
    std::uint32_t parent = 0;
    Function outside = 0;  // of what no leaf contains, within a chain
    std::array<Function, 2> outside_of_two{};  // of the parts of a kChain
  };
  // Cell 0 is that of every part that no leaf contains.
  struct Cell {
    std::uint32_t part = 0;
    std::int32_t first = 0;
    std::int32_t second = 0;
    // A sum's value is the sum, that of a part of a chain the function, any
    // other's its weight where it holds, or 0.
    std::int32_t value = 0;
  };
  struct KnownCrossing {
    std::uint64_t key = kFree;  // of the state below and the crossing
    State above = kOutside;
  };
  static constexpr std::uint64_t kFree = ~std::uint64_t{0};
  static constexpr std::uint32_t kNone = 0xffffffff;

  static std::uint64_t key_of(State state, Crossing crossing) {
    return std::uint64_t{state} << 32 | crossing;
  }
  std::size_t slot_of(std::uint64_t key) const {
    return (key * 0x9e3779b97f4a7c15U) >> shift_;
  }
  // What cells and crossings take in memory, in cells.
  std::size_t cost() const { return cells_.size() + crossing_count_; }
  void add_chains(const BooleanProgram& program,
                  std::vector<std::vector<std::uint32_t>>& operands);
  std::uint32_t pair_up(Kind kind, std::vector<std::uint32_t>& parts);
  static Function function_of(const Part& part, std::int32_t sum);
  static Function compose(Function outer, Function inner);
  void clear();
  State make_state(State below, Crossing crossing);
  State find_state(State below, Crossing crossing);
  std::uint32_t find_or_add(const Cell& cell);
  std::int32_t value_of(const Cell& cell) const;
  void index_cells(std::size_t capacity);
  void insert_crossing(State below, Crossing crossing, State above);
  void grow_crossings();

  const FillRule rule_;
  std::vector<Part> parts_;
  std::uint32_t root_ = 0;  // of them
  // By operand, what a chain of winding +1 changes: twice the part whose first
  // number it changes, and 1 more where that becomes less.
  std::vector<Crossing> upward_crossings_;
  std::vector<Cell> cells_;
  std::vector<std::uint32_t> index_;      // open hash of cells_
  std::vector<KnownCrossing> crossings_;  // open hash
  std::size_t crossing_count_ = 0;
  int shift_ = 0;
  std::vector<std::uint32_t> path_;  // cells of find_state, from the root down
  std::vector<std::uint32_t> path_parts_;
  std::uint64_t states_met_ = 0;
  std::size_t first_layer_cells_ = 0;  // 0: not yet known
  std::size_t most_cost_ = 0;
};

}  // namespace lamina::plane
