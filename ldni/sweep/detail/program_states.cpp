#include "ldni/sweep/detail/program_states.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "csg/program_state.h"

namespace lamina::ldni::detail {
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

}  // namespace

ProgramStates::ProgramStates(const csg::Scene& scene, FillRule rule)
    : rule_(rule) {
  // The operators' parts have the operators' numbers.
  parts_.resize(scene.program.size());
  std::vector<std::vector<std::uint32_t>> operands(scene.program.size());
  const auto weight_of = [&scene](const auto& child) {
    return static_cast<std::int8_t>(is_subtrahend(scene, child) ? -1 : 1);
  };
  for (std::uint32_t i = 0; i < scene.program.size(); ++i) {
    const csg::BooleanNode& node = scene.program[i];
    parts_[i].threshold = threshold_of(node);
    if (i == 0) continue;
    parts_[i].weight = weight_of(node);
    operands[node.parent].push_back(i);
  }
  upward_crossings_.reserve(scene.instances.size());
  for (const csg::Instance& instance : scene.instances) {
    const std::int8_t weight = weight_of(instance);
    if (scene.leaves[instance.leaf].may_overlap_itself) {
      const auto part = static_cast<std::uint32_t>(parts_.size());
      parts_.push_back({.kind = Kind::kCount, .weight = weight});
      operands[instance.parent].push_back(part);
      upward_crossings_.push_back(part << 1);
    } else {
      upward_crossings_.push_back(instance.parent << 1 |
                                  (weight < 0 ? 1U : 0U));
    }
  }
  for (std::uint32_t i = 0; i < operands.size(); ++i) add_sums(i, operands[i]);
  clear();
}

// Makes `children` the operands of the operator `parent`: pairs them up until
// one is left.
void ProgramStates::add_sums(std::uint32_t parent,
                             std::vector<std::uint32_t>& children) {
  while (children.size() > 1) {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i + 1 < children.size(); i += 2) {
      const auto sum = static_cast<std::uint32_t>(parts_.size());
      parts_.push_back({.kind = Kind::kSum});
      parts_[children[i]].parent = sum;
      parts_[children[i + 1]].parent = sum;
      parts_[children[i + 1]].is_second = true;
      children[pairs++] = sum;
    }
    if (children.size() % 2 == 1) children[pairs++] = children.back();
    children.resize(pairs);
  }
  if (children.empty()) return;
  parts_[children[0]].parent = parent;
  parts_[children[0]].is_second = true;
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
  for (std::uint32_t part = crossing >> 1; part != 0;
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
  if (cell.part == 0) ++states_met_;
  if (2 * cells_.size() > index_.size()) index_cells(2 * index_.size());
  return number;
}

std::int32_t ProgramStates::value_of(const Cell& cell) const {
  const auto value = [this](std::int32_t number) {
    return cells_[static_cast<std::size_t>(number)].value;
  };
  const Part& part = parts_[cell.part];
  bool holds = false;
  switch (part.kind) {
    case Kind::kSum:
      return value(cell.first) + value(cell.second);
    case Kind::kCount:
      holds = is_inside(cell.first, rule_);
      break;
    case Kind::kOperator:
      holds = cell.first + value(cell.second) >= part.threshold;
      break;
  }
  return holds ? part.weight : 0;
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
  // A cell stands behind those that it names.
  std::vector<Cell> old_cells = std::move(cells_);
  std::vector<std::uint32_t> kept(old_cells.size(), kNone);
  for (const State* state : live) kept[*state] = 0;
  const auto names_cells = [this](const Cell& cell) {
    const Kind kind = parts_[cell.part].kind;
    return std::pair(kind == Kind::kSum, kind != Kind::kCount);
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

}  // namespace lamina::ldni::detail
