#include "plane/program/program_states.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "plane/program/program_state.h"

namespace lamina::plane {
namespace {

constexpr std::size_t kFirstCapacity = 64;  // of the tables; a power of 2

// Cells are forgotten between two layers when they are more than this, and
// more than so many times those of the first layer since, so that the tables
// stay in the cache and still serve several layers.
constexpr std::size_t kFewCells = 4096;
constexpr std::size_t kLayersOfCells = 4;

// Within a layer, states that no entry has any more are forgotten when cells
// and crossings are more than this, or so many times what was left.
constexpr std::size_t kMostCost = std::size_t{1} << 19;
constexpr std::size_t kGrowthOfCost = 3;

std::size_t hash_of(std::uint32_t part, std::int32_t first,
                    std::int32_t second) {
  // splitmix64.
  // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult)
  std::uint64_t x = (std::uint64_t{static_cast<std::uint32_t>(first)} << 32 |
                     static_cast<std::uint32_t>(second)) +
                    part * 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}

template <typename Child>
std::int8_t weight_of(const BooleanProgram& program, const Child& child) {
  return static_cast<std::int8_t>(is_subtrahend(program.nodes, child) ? -1 : 1);
}

}  // namespace

ProgramStates::ProgramStates(const BooleanProgram& program, FillRule rule)
    : rule_(rule) {
  std::vector<std::vector<std::uint32_t>> operands(program.nodes.size());
  add_chains(program, operands);
  upward_crossings_.reserve(program.operands.size());
  for (const Operand& operand : program.operands) {
    const std::int8_t weight = weight_of(program, operand);
    if (operand.may_overlap_itself) {
      const auto part = static_cast<std::uint32_t>(parts_.size());
      parts_.push_back({.kind = Kind::kCount, .weight = weight});
      operands[operand.parent].push_back(part);
      upward_crossings_.push_back(part << 1);
    } else {
      upward_crossings_.push_back(operand.parent << 1 | (weight < 0 ? 1U : 0U));
    }
  }
  for (std::uint32_t i = 0; i < operands.size(); ++i) {
    if (operands[i].empty()) continue;
    Part& sum = parts_[pair_up(Kind::kSum, operands[i])];
    sum.parent = i;
    sum.is_second = true;
  }
  clear();
}

// Makes the parts of the operators, which have the operators' numbers, and of
// their chains. Each chain but that of the root is one of the `operands` of an
// operator.
void ProgramStates::add_chains(
    const BooleanProgram& program,
    std::vector<std::vector<std::uint32_t>>& operands) {
  // Find the largest operator below each.
  const auto count = static_cast<std::uint32_t>(program.nodes.size());
  std::vector<std::uint32_t> sizes(count, 1);
  std::vector<std::uint32_t> largest(count, 0);  // the root is below none
  for (std::uint32_t i = count; i-- > 1;) {
    const std::uint32_t parent = program.nodes[i].parent;
    sizes[parent] += sizes[i];
    std::uint32_t& other = largest[parent];
    if (other == 0 || sizes[i] >= sizes[other]) other = i;
  }
  parts_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Part& part = parts_[i];
    part.threshold = threshold_of(program.nodes[i]);
    if (largest[i] != 0) {
      part.next_weight = weight_of(program, program.nodes[largest[i]]);
    }
    part.outside = function_of(part, 0);
  }
  std::vector<std::uint32_t> chain;
  for (std::uint32_t i = 0; i < count; ++i) {
    const BooleanNode& node = program.nodes[i];
    if (i != 0 && largest[node.parent] == i) continue;
    chain.clear();
    for (std::uint32_t next = i; next != 0 || chain.empty();
         next = largest[next]) {
      chain.push_back(next);
    }
    const std::uint32_t whole = pair_up(Kind::kChain, chain);
    if (i == 0) {
      root_ = whole;
      parts_[whole].weight = 1;
    } else {
      operands[node.parent].push_back(whole);
      parts_[whole].weight = weight_of(program, node);
    }
  }
}

// Pairs parts up with their neighbours, again and again, until one is left.
std::uint32_t ProgramStates::pair_up(Kind kind,
                                     std::vector<std::uint32_t>& parts) {
  while (parts.size() > 1) {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i + 1 < parts.size(); i += 2) {
      Part pair{.kind = kind};
      const auto number = static_cast<std::uint32_t>(parts_.size());
      for (const std::size_t k : {0U, 1U}) {
        Part& part = parts_[parts[i + k]];
        part.parent = number;
        part.is_second = k == 1;
        pair.outside_of_two[k] = part.outside;
      }
      pair.outside = compose(pair.outside_of_two[0], pair.outside_of_two[1]);
      parts_.push_back(pair);
      parts[pairs++] = number;
    }
    if (parts.size() % 2 == 1) parts[pairs++] = parts.back();
    parts.resize(pairs);
  }
  return parts.front();
}

// Returns what an operator is whose other children come to `sum`.
ProgramStates::Function ProgramStates::function_of(const Part& part,
                                                   std::int32_t sum) {
  const bool without = sum >= part.threshold;
  const bool with = sum + part.next_weight >= part.threshold;
  return static_cast<Function>((without ? 1U : 0U) | (with ? 2U : 0U));
}

ProgramStates::Function ProgramStates::compose(Function outer, Function inner) {
  const unsigned without = outer >> (inner & 1U) & 1U;
  const unsigned with = outer >> (inner >> 1U) & 1U;
  return static_cast<Function>(without | with << 1U);
}

void ProgramStates::clear() {
  cells_.assign(1, {});
  index_.assign(std::max(index_.size(), kFirstCapacity), kNone);
  crossings_.assign(std::max(crossings_.size(), kFirstCapacity), {});
  shift_ = 64 - std::countr_zero(crossings_.size());
  crossing_count_ = 0;
}

void ProgramStates::begin_layer() {
  const std::size_t count = cells_.size();
  if (first_layer_cells_ == 0) first_layer_cells_ = count;
  if (count > std::max(kFewCells, kLayersOfCells * first_layer_cells_) ||
      cost() > kMostCost) {
    clear();
    first_layer_cells_ = 0;
  }
  most_cost_ = kMostCost;
}

ProgramStates::State ProgramStates::make_state(State below, Crossing crossing) {
  const State above = find_state(below, crossing);
  insert_crossing(below, crossing, above);
  insert_crossing(above, crossing ^ 1, below);  // the way back
  return above;
}

// Goes down from the root to the part that changes, and makes its cell and
// those above it anew.
ProgramStates::State ProgramStates::find_state(State below, Crossing crossing) {
  path_parts_.clear();
  for (std::uint32_t part = crossing >> 1; part != root_;
       part = parts_[part].parent) {
    path_parts_.push_back(part);
  }
  path_.assign(1, below);
  for (std::size_t i = path_parts_.size(); i-- > 0;) {
    const Cell& cell = cells_[path_.back()];
    path_.push_back(static_cast<std::uint32_t>(
        parts_[path_parts_[i]].is_second ? cell.second : cell.first));
  }
  Cell cell = cells_[path_.back()];
  cell.part = crossing >> 1;
  cell.first += (crossing & 1) == 0 ? 1 : -1;
  for (;;) {
    const auto number = static_cast<std::int32_t>(find_or_add(cell));
    path_.pop_back();
    if (path_.empty()) return static_cast<State>(number);
    const Part& part = parts_[cell.part];
    cell = cells_[path_.back()];
    cell.part = part.parent;
    (part.is_second ? cell.second : cell.first) = number;
  }
}

std::uint32_t ProgramStates::find_or_add(const Cell& cell) {
  if (cell.first == 0 && cell.second == 0) return 0;
  const std::size_t mask = index_.size() - 1;
  std::size_t i = hash_of(cell.part, cell.first, cell.second) & mask;
  for (; index_[i] != kNone; i = (i + 1) & mask) {
    const Cell& known = cells_[index_[i]];
    if (known.first == cell.first && known.second == cell.second &&
        known.part == cell.part) {
      return index_[i];
    }
  }
  const auto number = static_cast<std::uint32_t>(cells_.size());
  index_[i] = number;
  cells_.push_back({cell.part, cell.first, cell.second, value_of(cell)});
  if (cell.part == root_) ++states_met_;
  if (2 * cells_.size() > index_.size()) index_cells(2 * index_.size());
  return number;
}

std::int32_t ProgramStates::value_of(const Cell& cell) const {
  const auto value = [this](std::int32_t number) {
    return cells_[static_cast<std::size_t>(number)].value;
  };
  const Part& part = parts_[cell.part];
  Function function = 0;
  switch (part.kind) {
    case Kind::kSum:
      return value(cell.first) + value(cell.second);
    case Kind::kCount:
      return is_inside(cell.first, rule_) ? part.weight : 0;
    case Kind::kOperator:
      function = function_of(part, cell.first + value(cell.second));
      break;
    case Kind::kChain: {
      const auto [outer, inner] = part.outside_of_two;
      const auto of = [&](std::int32_t number, Function outside) {
        return number == 0 ? outside : static_cast<Function>(value(number));
      };
      function = compose(of(cell.first, outer), of(cell.second, inner));
      break;
    }
  }
  return part.weight == 0 ? function : (function & 1) * part.weight;
}

void ProgramStates::index_cells(std::size_t capacity) {
  index_.assign(capacity, kNone);
  for (std::uint32_t number = 1; number < cells_.size(); ++number) {
    const Cell& cell = cells_[number];
    std::size_t i =
        hash_of(cell.part, cell.first, cell.second) & (capacity - 1);
    while (index_[i] != kNone) i = (i + 1) & (capacity - 1);
    index_[i] = number;
  }
}

void ProgramStates::insert_crossing(State below, Crossing crossing,
                                    State above) {
  if (2 * ++crossing_count_ > crossings_.size()) grow_crossings();
  const std::uint64_t key = key_of(below, crossing);
  std::size_t i = slot_of(key);
  while (crossings_[i].key != kFree && crossings_[i].key != key) {
    i = (i + 1) & (crossings_.size() - 1);
  }
  crossings_[i] = {key, above};
}

void ProgramStates::grow_crossings() {
  std::vector<KnownCrossing> old(2 * crossings_.size());
  std::swap(old, crossings_);
  --shift_;
  crossing_count_ = 0;
  for (const KnownCrossing& known : old) {
    if (known.key == kFree) continue;
    std::size_t i = slot_of(known.key);
    while (crossings_[i].key != kFree) i = (i + 1) & (crossings_.size() - 1);
    crossings_[i] = known;
    ++crossing_count_;
  }
  ++crossing_count_;  // the one about to come
}

void ProgramStates::keep_only(std::span<State* const> live) {
  // A cell comes after those that it names.
  std::vector<Cell> old_cells = std::move(cells_);
  std::vector<std::uint32_t> kept(old_cells.size(), kNone);
  for (const State* state : live) kept[*state] = 0;
  const auto names_cells = [this](const Cell& cell) {
    const Kind kind = parts_[cell.part].kind;
    return std::pair(kind == Kind::kSum || kind == Kind::kChain,
                     kind != Kind::kCount);
  };
  for (std::size_t i = old_cells.size(); i-- > 1;) {
    if (kept[i] == kNone) continue;
    const Cell& cell = old_cells[i];
    const auto [is_first_cell, is_second_cell] = names_cells(cell);
    if (is_first_cell) kept[static_cast<std::size_t>(cell.first)] = 0;
    if (is_second_cell) kept[static_cast<std::size_t>(cell.second)] = 0;
  }
  clear();
  kept[0] = 0;
  for (std::size_t i = 1; i < old_cells.size(); ++i) {
    if (kept[i] == kNone) continue;
    Cell cell = old_cells[i];
    const auto renumber = [&kept](std::int32_t& number) {
      number =
          static_cast<std::int32_t>(kept[static_cast<std::size_t>(number)]);
    };
    const auto [is_first_cell, is_second_cell] = names_cells(cell);
    if (is_first_cell) renumber(cell.first);
    if (is_second_cell) renumber(cell.second);
    kept[i] = static_cast<std::uint32_t>(cells_.size());
    cells_.push_back(cell);
  }
  for (State* state : live) *state = kept[*state];
  index_cells(std::max(index_.size(), std::bit_ceil(2 * cells_.size())));
  most_cost_ = std::max(kMostCost, kGrowthOfCost * cost());
}

}  // namespace lamina::plane
