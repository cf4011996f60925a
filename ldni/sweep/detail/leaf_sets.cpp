#include "ldni/sweep/detail/leaf_sets.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace lamina::ldni::detail {
namespace {

constexpr std::size_t kFirstCapacity = 1024;  // of the tables; a power of 2

// splitmix64.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}

}  // namespace

LeafSets::LeafSets(const csg::Scene& scene, Rule rule)
    : rule_(rule), program_(scene) {
  is_counted_.reserve(scene.instances.size());
  for (const csg::Instance& instance : scene.instances) {
    is_counted_.push_back(scene.leaves[instance.leaf].may_overlap_itself);
  }
  marks_.assign(scene.instances.size(), 0);
  counts_.assign(scene.instances.size(), 0);
  clear();
}

void LeafSets::clear() {
  sets_.assign(1, {});  // the empty set, for which no program holds
  values_.assign(1, Value::kEmpty);
  members_.clear();
  index_.assign(std::max(index_.size(), kFirstCapacity), kNone);
  index_[0] = kEmpty;  // hash 0
  steps_.assign(std::max(steps_.size(), kFirstCapacity), {});
  shift_ = 64 - std::countr_zero(steps_.size());
  step_count_ = 0;
}

LeafSets::Id LeafSets::make_step(Id set, Step step) {
  const Id result = find_or_add(hash_after(set, step), set, step);
  // The way back is known too.
  const Step back = is_counted_[step >> 1] ? step ^ 1 : step;
  insert_step(set, step, result);
  insert_step(result, back, set);
  return result;
}

LeafSets::Hash LeafSets::hash_after(Id set, Step step) const {
  Hash hash = sets_[set].hash;
  const std::uint32_t instance = step >> 1;
  for (std::uint64_t i = 0; i < 2; ++i) {
    const std::uint64_t key = mix(i << 32 | instance);
    if (!is_counted_[instance]) {
      hash.toggled[i] ^= key;
    } else if ((step & 1) == 0) {
      hash.counted[i] += key;
    } else {
      hash.counted[i] -= key;
    }
  }
  return hash;
}

LeafSets::Id LeafSets::find_or_add(const Hash& hash, Id base, Step step) {
  const std::size_t mask = index_.size() - 1;
  std::size_t i = hash.slot() & mask;
  for (; index_[i] != kNone; i = (i + 1) & mask) {
    if (sets_[index_[i]].hash == hash) return index_[i];
  }
  const Id id = static_cast<Id>(sets_.size());
  index_[i] = id;
  Set set;
  set.hash = hash;
  set.base = base;
  set.step = step;
  sets_.push_back(set);
  values_.push_back(Value::kUnknown);
  if (2 * sets_.size() > index_.size()) grow_index();
  return id;
}

// Turns the program's present set into this one; neighbours on the ray differ
// by a leaf, so that is mostly a flip or two.
void LeafSets::evaluate(Id id) {
  ++evaluations_;
  write_members(id);
  const Set& set = sets_[id];
  const Member* begin = members_.data() + set.first_member;
  const Member* end = begin + set.size;
  for (std::size_t i = program_.inside().size(); i-- > 0;) {
    const std::uint32_t instance = program_.inside()[i];
    const bool stays = marks_[instance] == evaluations_ &&
                       is_inside({instance, counts_[instance]});
    if (!stays) program_.flip(instance, false);
  }
  for (const Member* member = begin; member != end; ++member) {
    if (is_inside(*member) && !program_.is_inside(member->instance)) {
      program_.flip(member->instance, true);
    }
  }
  values_[id] = program_.value() ? Value::kSolid : Value::kEmpty;
}

// Goes back to a set whose members are written, then counts the steps on the
// way, in any order.
void LeafSets::write_members(Id id) {
  met_.clear();
  Id known = id;
  for (; values_[known] == Value::kUnknown; known = sets_[known].base) {
    const Step step = sets_[known].step;
    std::int32_t& count = count_of(step >> 1);
    if (is_counted_[step >> 1]) {
      count += (step & 1) != 0 ? -1 : 1;
    } else {
      count ^= 1;
    }
  }
  const std::size_t first = sets_[known].first_member;
  for (std::size_t i = first; i < first + sets_[known].size; ++i) {
    const Member& member = members_[i];
    std::int32_t& count = count_of(member.instance);
    if (is_counted_[member.instance]) {
      count += member.count;
    } else {
      count ^= 1;
    }
  }
  Set& set = sets_[id];
  set.first_member = members_.size();
  for (const std::uint32_t instance : met_) {
    if (counts_[instance] != 0) {
      members_.push_back({instance, counts_[instance]});
    }
  }
  set.size = static_cast<std::uint32_t>(members_.size() - set.first_member);
}

std::int32_t& LeafSets::count_of(std::uint32_t instance) {
  if (marks_[instance] != evaluations_) {
    marks_[instance] = evaluations_;
    counts_[instance] = 0;
    met_.push_back(instance);
  }
  return counts_[instance];
}

void LeafSets::insert_step(Id set, Step step, Id result) {
  if (2 * ++step_count_ > steps_.size()) grow_steps();
  const std::uint64_t key = std::uint64_t{set} << 32 | step;
  std::size_t i = slot_of(key);
  while (steps_[i].key != kFree && steps_[i].key != key) {
    i = (i + 1) & (steps_.size() - 1);
  }
  steps_[i] = {key, result};
}

void LeafSets::grow_steps() {
  std::vector<KnownStep> old(2 * steps_.size());
  std::swap(old, steps_);
  --shift_;
  step_count_ = 0;
  for (const KnownStep& known : old) {
    if (known.key == kFree) continue;
    std::size_t i = slot_of(known.key);
    while (steps_[i].key != kFree) i = (i + 1) & (steps_.size() - 1);
    steps_[i] = known;
    ++step_count_;
  }
  ++step_count_;  // the one about to come
}

void LeafSets::grow_index() {
  index_.assign(2 * index_.size(), kNone);
  for (Id id = 0; id < sets_.size(); ++id) add_to_index(id);
}

void LeafSets::add_to_index(Id id) {
  const std::size_t mask = index_.size() - 1;
  std::size_t i = sets_[id].hash.slot() & mask;
  while (index_[i] != kNone) i = (i + 1) & mask;
  index_[i] = id;
}

void LeafSets::keep_only(std::vector<Id>& live) {
  for (const Id id : live) value(id);
  const std::vector<Set> old_sets = std::move(sets_);
  const std::vector<Value> old_values = std::move(values_);
  const std::vector<Member> old_members = std::move(members_);
  std::vector<Id> new_ids(old_sets.size(), kNone);
  new_ids[kEmpty] = kEmpty;
  clear();
  for (Id& id : live) {
    if (new_ids[id] == kNone) {
      new_ids[id] = static_cast<Id>(sets_.size());
      Set set = old_sets[id];
      const auto begin =
          old_members.begin() + static_cast<std::ptrdiff_t>(set.first_member);
      set.first_member = members_.size();
      members_.insert(members_.end(), begin, begin + set.size);
      sets_.push_back(set);
      values_.push_back(old_values[id]);
      if (2 * sets_.size() > index_.size()) {
        grow_index();
      } else {
        add_to_index(new_ids[id]);
      }
    }
    id = new_ids[id];
  }
}

}  // namespace lamina::ldni::detail
