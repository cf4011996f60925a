#include "ldni/sweep/detail/program_states.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace lamina::ldni::detail {
namespace {

constexpr std::size_t kFirstCapacity = 1024;  // of the tables; a power of 2

// States are forgotten between two layers when they are more than this, and
// more than so many times those of the first layer since, so that the tables
// stay in the cache and still serve several layers.
constexpr std::size_t kFewStates = 4096;
constexpr std::size_t kLayersOfStates = 4;

// Within a layer, states that no entry has any more are forgotten when all cost
// more than this (8 bytes each), or so many times what was left.
constexpr std::size_t kMostCost = std::size_t{1} << 21;
constexpr std::size_t kGrowthOfCost = 3;

// splitmix64.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}

}  // namespace

ProgramStates::ProgramStates(const csg::Scene& scene, Rule rule)
    : rule_(rule),
      program_(scene),
      marks_(scene.instances.size()),
      counts_(scene.instances.size()) {
  may_overlap_itself_.reserve(scene.instances.size());
  for (const csg::Instance& instance : scene.instances) {
    may_overlap_itself_.push_back(
        scene.leaves[instance.leaf].may_overlap_itself);
  }
  clear();
}

void ProgramStates::clear() {
  records_.assign(1, {});  // kOutside: the empty set, which is never solid
  values_.assign(1, Value::kEmpty);
  members_.clear();
  index_.assign(std::max(index_.size(), kFirstCapacity), kNone);
  index_[0] = kOutside;  // hash 0
  crossings_.assign(std::max(crossings_.size(), kFirstCapacity), {});
  shift_ = 64 - std::countr_zero(crossings_.size());
  crossing_count_ = 0;
}

void ProgramStates::begin_layer() {
  const std::size_t count = records_.size();
  if (first_layer_states_ == 0) first_layer_states_ = count;
  if (count > std::max(kFewStates, kLayersOfStates * first_layer_states_) ||
      cost() > kMostCost) {
    clear();
    first_layer_states_ = 0;
  }
  most_cost_ = kMostCost;
}

ProgramStates::State ProgramStates::make_state(State below, Crossing crossing) {
  const State above = find_or_add(hash_above(below, crossing), below, crossing);
  // The way back is known too.
  const Crossing back =
      may_overlap_itself_[crossing >> 1] ? crossing ^ 1 : crossing;
  insert_crossing(below, crossing, above);
  insert_crossing(above, back, below);
  return above;
}

ProgramStates::Hash ProgramStates::hash_above(State state,
                                              Crossing crossing) const {
  Hash hash = records_[state].hash;
  const std::uint32_t instance = crossing >> 1;
  for (std::uint64_t i = 0; i < 2; ++i) {
    const std::uint64_t key = mix(i << 32 | instance);
    if (!may_overlap_itself_[instance]) {
      hash.toggled[i] ^= key;
    } else if ((crossing & 1) == 0) {
      hash.counted[i] += key;
    } else {
      hash.counted[i] -= key;
    }
  }
  return hash;
}

ProgramStates::State ProgramStates::find_or_add(const Hash& hash, State base,
                                                Crossing crossing) {
  const std::size_t mask = index_.size() - 1;
  std::size_t i = hash.slot() & mask;
  for (; index_[i] != kNone; i = (i + 1) & mask) {
    if (records_[index_[i]].hash == hash) return index_[i];
  }
  const auto state = static_cast<State>(records_.size());
  index_[i] = state;
  records_.push_back({hash, base, crossing});
  values_.push_back(Value::kUnknown);
  if (2 * records_.size() > index_.size()) index_records(2 * index_.size());
  return state;
}

void ProgramStates::index_records(std::size_t capacity) {
  index_.assign(capacity, kNone);
  for (State state = 0; state < records_.size(); ++state) {
    std::size_t i = records_[state].hash.slot() & (capacity - 1);
    while (index_[i] != kNone) i = (i + 1) & (capacity - 1);
    index_[i] = state;
  }
}

// Turns the program's present set into this one; neighbours on the ray differ
// by a leaf, so that is mostly a flip or two.
void ProgramStates::evaluate(State state) {
  ++evaluations_;
  write_members(state);
  for (std::size_t i = program_.inside().size(); i-- > 0;) {
    const std::uint32_t instance = program_.inside()[i];
    const bool stays = marks_[instance] == evaluations_ &&
                       is_inside({instance, counts_[instance]});
    if (!stays) program_.flip(instance, false);
  }
  const Member* member = members_.data() + records_[state].first_member;
  for (const Member* end = member + records_[state].size; member != end;
       ++member) {
    if (is_inside(*member) && !program_.is_inside(member->instance)) {
      program_.flip(member->instance, true);
    }
  }
  values_[state] = program_.value() ? Value::kSolid : Value::kEmpty;
}

// Goes back to a state whose members are written, then counts the crossings on
// the way, in any order.
void ProgramStates::write_members(State state) {
  met_.clear();
  State known = state;
  for (; values_[known] == Value::kUnknown; known = records_[known].base) {
    const Crossing crossing = records_[known].crossing;
    count(crossing >> 1, (crossing & 1) != 0 ? -1 : 1);
  }
  const std::size_t first = records_[known].first_member;
  for (std::size_t i = first; i < first + records_[known].size; ++i) {
    count(members_[i].instance, members_[i].count);
  }
  Record& record = records_[state];
  record.first_member = members_.size();
  for (const std::uint32_t instance : met_) {
    if (counts_[instance] != 0) {
      members_.push_back({instance, counts_[instance]});
    }
  }
  record.size =
      static_cast<std::uint32_t>(members_.size() - record.first_member);
}

void ProgramStates::count(std::uint32_t instance, std::int32_t change) {
  if (marks_[instance] != evaluations_) {
    marks_[instance] = evaluations_;
    counts_[instance] = 0;
    met_.push_back(instance);
  }
  if (may_overlap_itself_[instance]) {
    counts_[instance] += change;
  } else {
    counts_[instance] ^= 1;
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
  for (const State* state : live) is_solid(*state);
  const std::vector<Record> old_records = std::move(records_);
  const std::vector<Value> old_values = std::move(values_);
  const std::vector<Member> old_members = std::move(members_);
  std::vector<State> new_states(old_records.size(), kNone);
  new_states[kOutside] = kOutside;
  clear();
  for (State* state : live) {
    State& kept = new_states[*state];
    if (kept == kNone) {
      Record record = old_records[*state];
      const auto begin = old_members.begin() +
                         static_cast<std::ptrdiff_t>(record.first_member);
      record.first_member = members_.size();
      members_.insert(members_.end(), begin, begin + record.size);
      kept = static_cast<State>(records_.size());
      records_.push_back(record);
      values_.push_back(old_values[*state]);
    }
    *state = kept;
  }
  index_records(std::max(index_.size(), std::bit_ceil(2 * records_.size())));
  most_cost_ = std::max(kMostCost, kGrowthOfCost * cost());
}

}  // namespace lamina::ldni::detail
