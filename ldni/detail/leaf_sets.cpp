#include "ldni/detail/leaf_sets.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace lamina::ldni::detail {
namespace {

constexpr std::size_t kFirstCapacity = 1024;  // of the tables; a power of 2

}  // namespace

LeafSets::LeafSets(const csg::Scene& scene, Rule rule)
    : rule_(rule), program_(scene) {
  is_counted_.reserve(scene.instances.size());
  for (const csg::Instance& instance : scene.instances) {
    is_counted_.push_back(scene.leaves[instance.leaf].may_overlap_itself);
  }
  marks_.assign(scene.instances.size(), 0);
  clear();
}

void LeafSets::clear() {
  sets_.assign(1, {});  // the empty set
  members_.clear();
  index_.assign(std::max(index_.size(), kFirstCapacity), kNone);
  index_[0] = kEmpty;  // hash 0
  steps_.assign(std::max(steps_.size(), kFirstCapacity), {});
  shift_ = 64 - std::countr_zero(steps_.size());
  step_count_ = 0;
}

std::uint64_t LeafSets::hash_of(const Member& member) {
  // splitmix64.
  std::uint64_t x = std::uint64_t{member.instance} << 32 |
                    static_cast<std::uint32_t>(member.count);
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9U;
  x = (x ^ x >> 27) * 0x94d049bb133111ebU;
  return x ^ x >> 31;
}

LeafSets::Id LeafSets::make_step(Id set, Step step) {
  write_members(set, step);
  std::uint64_t hash = 0;
  for (const Member& member : scratch_) hash += hash_of(member);
  const Id result = find_or_add(hash);
  // The way back is known too.
  const Step back = is_counted_[step >> 1] ? step ^ 1 : step;
  insert_step(set, step, result);
  insert_step(result, back, set);
  return result;
}

// Writes the members of the set after a step to scratch_.
void LeafSets::write_members(Id set, Step step) {
  const auto begin =
      members_.begin() + static_cast<std::ptrdiff_t>(sets_[set].first_member);
  scratch_.assign(begin, begin + sets_[set].size);
  const std::uint32_t instance = step >> 1;
  const auto it =
      std::lower_bound(scratch_.begin(), scratch_.end(), instance,
                       [](const Member& member, std::uint32_t wanted) {
                         return member.instance < wanted;
                       });
  const bool is_member = it != scratch_.end() && it->instance == instance;
  const std::int32_t before = is_member ? it->count : 0;
  std::int32_t after = 1 - before;
  if (is_counted_[instance]) after = before + ((step & 1) != 0 ? -1 : 1);
  if (!is_member) {
    scratch_.insert(it, {instance, after});
  } else if (after == 0) {
    scratch_.erase(it);
  } else {
    it->count = after;
  }
}

LeafSets::Id LeafSets::find_or_add(std::uint64_t hash) {
  const std::size_t mask = index_.size() - 1;
  std::size_t i = hash & mask;
  for (; index_[i] != kNone; i = (i + 1) & mask) {
    const Set& known = sets_[index_[i]];
    if (known.hash != hash || known.size != scratch_.size()) continue;
    const auto begin =
        members_.begin() + static_cast<std::ptrdiff_t>(known.first_member);
    if (std::equal(scratch_.begin(), scratch_.end(), begin)) return index_[i];
  }
  const Id id = static_cast<Id>(sets_.size());
  index_[i] = id;
  Set set;
  set.hash = hash;
  set.first_member = members_.size();
  set.size = static_cast<std::uint32_t>(scratch_.size());
  members_.insert(members_.end(), scratch_.begin(), scratch_.end());
  set.value = evaluate(set);
  sets_.push_back(set);
  if (2 * sets_.size() > index_.size()) grow_index();
  return id;
}

// Turns the program's present set into this one; neighbours on the ray differ
// by a leaf, so that is mostly a flip or two.
bool LeafSets::evaluate(const Set& set) {
  ++evaluations_;
  const Member* begin = members_.data() + set.first_member;
  const Member* end = begin + set.size;
  for (const Member* member = begin; member != end; ++member) {
    if (is_inside(*member)) marks_[member->instance] = evaluations_;
  }
  for (std::size_t i = program_.inside().size(); i-- > 0;) {
    const std::uint32_t instance = program_.inside()[i];
    if (marks_[instance] != evaluations_) program_.flip(instance, false);
  }
  for (const Member* member = begin; member != end; ++member) {
    if (is_inside(*member) && !program_.is_inside(member->instance)) {
      program_.flip(member->instance, true);
    }
  }
  return program_.value();
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
  std::size_t i = sets_[id].hash & mask;
  while (index_[i] != kNone) i = (i + 1) & mask;
  index_[i] = id;
}

void LeafSets::keep_only(std::vector<Id>& live) {
  const std::vector<Set> old_sets = std::move(sets_);
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
