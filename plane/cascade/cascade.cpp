#include "plane/cascade/cascade.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

#include "plane/cascade/crossing_sample.h"
#include "plane/cascade/difference_levels.h"

namespace lamina::plane {
namespace {

// Points nearer than this [mm] are one where near ties were resolved: what is
// left of faces apart by less than a tie is that small. Elsewhere points are
// one where an event cluster can have moved them, kClusterWidth.
constexpr double kResolvedMergeDistance = 1e-8;

// A sweep is given up after so many swaps for each chain met so far, and some
// at the beginning: a share of those of all chains, and a few. Cascading costs
// a few swaps a chain for each time that it halves the program. Where a state
// is one number a swap costs less, so more of them are borne.
constexpr double kMostSwaps = 4;
constexpr double kMostSwapsOfSimple = 12;
constexpr double kFirstShare = 0.25;
constexpr double kFirstSwaps = 256;

// Halves of a scene whose sweep was given up are not tried where more than this
// share of those swaps are to be expected.
constexpr double kMostExpected = 0.25;

// Before that, after fewer swaps, it is asked how much of the chains lies where
// their leaves can matter. Where that is less than this share the layer is
// clipped, and its sweep begins again.
constexpr Patience kBeforeClipping = {1, 32};
constexpr double kMostWithin = 0.7;

// Where more of the chains than this share belong to leaves that others do not
// cover, all leaves stay.
constexpr double kMostUncovered = 0.8;

// Differences in each other are parted level by level where they are so many.
constexpr std::size_t kFewestLevels = 8;

// Whether half of the chains belong to one leaf, which cannot be parted.
bool is_mostly_one_leaf(std::span<const Chain> chains) {
  std::size_t longest = 0;
  std::size_t run = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const bool goes_on = i > 0 && chains[i].operand == chains[i - 1].operand;
    run = goes_on ? run + 1 : 1;
    longest = std::max(longest, run);
  }
  return 2 * longest >= chains.size();
}

}  // namespace

// The chains that a part of the program has of a layer.
struct Cascade::Chains {
  std::vector<Chain> chains;
  std::vector<ChainLoop> loops;

  void add(const ChainLoop& loop, std::span<const Chain> of_loop,
           std::uint32_t operand) {
    loops.push_back(loop);
    for (const Chain& chain : of_loop) {
      chains.push_back(chain);
      chains.back().operand = operand;
    }
  }
};

// A run of levels in a layer; valid while nothing is swept.
struct Cascade::Run {
  const Contours* result = nullptr;
  const Contours* all = nullptr;  // the part that lies in all levels
  bool is_kept = false;           // both are those of the layer before
};

// The levels of A - U - (B - V - (C - ...)): A without U, B without V, and so
// on. Where a place lies in the first k levels and not in the next one, it is
// in the result if k is odd. So two runs of levels, each with its result and
// the part that lies in all of its levels, make one.
struct Cascade::Levels {
  explicit Levels(DifferenceLevels levels);
  ~Levels();
  Levels(Levels&&) = delete;
  Levels& operator=(Levels&&) = delete;

  // Two runs that were made one; the levels of the second begin at its number.
  struct Joined {
    Contours result;
    Contours all;
    bool is_made = false;
  };

  const DifferenceLevels split;
  std::vector<std::unique_ptr<Group>> groups;
  std::vector<Joined> runs;
};

// A Boolean of the cascade: the whole program, or some operands of one operator
// of it.
class Cascade::Group {
 public:
  // The program must outlive the object.
  explicit Group(const BooleanProgram& program)
      : program_(program), states_(program, FillRule::kNonZero) {}

  ProgramStates& states() { return states_; }
  std::uint64_t states_met() const;

  // Parts the group in two where it has two children, at the first call.
  bool part();
  // The operator over the two halves.
  BooleanOp op() const { return program_.nodes[0].op; }
  Group& half(std::size_t i) { return *halves_[i]; }

  // The chains of each half, with the numbers that operands have there.
  std::array<Chains, 2> chains_of_halves(const LayerChains& layer) const;

  // Differences in each other, level by level; null where they are few.
  Levels* levels();

  // Keeps the contours of the layer; those of the layer kept last, or null
  // where that had other chains.
  void keep(const LayerChains& layer, const Contours& contours);
  const Contours* find_kept(const LayerChains& layer) const;

 private:
  struct Child {
    Child(bool of_operand, std::uint32_t number)
        : is_operand(of_operand), index(number) {}

    bool is_operand = false;
    std::uint32_t index = 0;   // of the operand, or of the node
    std::uint32_t weight = 0;  // operands below
    Box2 box;                  // around theirs
    bool is_second = false;    // of the halves

    void add(const Operand& operand) {
      ++weight;
      box.add(operand.box);
    }
  };

  std::vector<Child> children() const;
  void choose_halves(std::vector<Child>& children) const;
  void make_halves(const std::vector<Child>& children);

  const BooleanProgram& program_;
  ProgramStates states_;
  bool may_part_ = true;
  bool may_have_levels_ = true;
  std::unique_ptr<Levels> levels_;
  std::array<BooleanProgram, 2> half_programs_;
  std::array<std::unique_ptr<Group>, 2> halves_;
  // An operand: its half, and its number there.
  std::vector<std::pair<bool, std::uint32_t>> places_;
  // The layer kept last; its points chain by chain.
  Chains kept_chains_;
  std::vector<Vec2> kept_points_;
  Contours kept_contours_;
};

std::uint64_t Cascade::Group::states_met() const {
  std::uint64_t sum = states_.states_met();
  for (const auto& half : halves_) {
    if (half != nullptr) sum += half->states_met();
  }
  if (levels_ != nullptr) {
    for (const auto& group : levels_->groups) sum += group->states_met();
  }
  return sum;
}

bool Cascade::Group::part() {
  if (halves_[0] != nullptr) return true;
  if (!may_part_) return false;
  std::vector<Child> all = children();
  may_part_ = all.size() > 1;
  if (!may_part_) return false;
  choose_halves(all);
  make_halves(all);
  for (std::size_t i = 0; i < 2; ++i) {
    halves_[i] = std::make_unique<Group>(half_programs_[i]);
  }
  return true;
}

std::vector<Cascade::Group::Child> Cascade::Group::children() const {
  // By node below the root, the child that it belongs to.
  std::vector<std::size_t> owners(program_.nodes.size());
  std::vector<Child> children;
  for (std::uint32_t i = 1; i < program_.nodes.size(); ++i) {
    const std::uint32_t parent = program_.nodes[i].parent;
    owners[i] = parent == 0 ? children.size() : owners[parent];
    if (parent == 0) children.emplace_back(false, i);
  }
  for (std::uint32_t i = 0; i < program_.operands.size(); ++i) {
    const Operand& operand = program_.operands[i];
    if (operand.parent == 0) {
      children.emplace_back(true, i);
      children.back().add(operand);
    } else {
      children[owners[operand.parent]].add(operand);
    }
  }
  return children;
}

// A difference: what is subtracted from, and all that is subtracted. Else so
// that each half lies together and has about half of the operands.
void Cascade::Group::choose_halves(std::vector<Child>& children) const {
  if (op() == BooleanOp::kDifference) {
    for (Child& child : children) {
      child.is_second =
          !(child.is_operand ? program_.operands[child.index].is_minuend
                             : program_.nodes[child.index].is_minuend);
    }
    return;
  }
  Box2 centers;
  std::uint32_t weight = 0;
  for (const Child& child : children) {
    centers.add(child.box.center());
    weight += child.weight;
  }
  const int axis = centers.size().x >= centers.size().y ? 0 : 1;
  std::ranges::stable_sort(children, {}, [axis](const Child& child) {
    return child.box.center()[axis];
  });
  std::uint32_t before = 0;
  for (Child& child : children) {
    child.is_second =
        &child != &children.front() && 2 * before + child.weight > weight;
    before += child.weight;
  }
  children.back().is_second = true;
}

void Cascade::Group::make_halves(const std::vector<Child>& children) {
  constexpr std::uint32_t kRoot = 0;
  // By node, its half and its number there.
  std::vector<std::pair<bool, std::uint32_t>> nodes(program_.nodes.size());
  places_.resize(program_.operands.size());
  std::array<std::uint32_t, 2> counts{};
  for (const Child& child : children) {
    ++counts[child.is_second ? 1 : 0];
    (child.is_operand ? places_ : nodes)[child.index].first = child.is_second;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    // What is subtracted is united; a difference's first child is alone.
    const BooleanOp op =
        this->op() == BooleanOp::kIntersection ? this->op() : BooleanOp::kUnion;
    half_programs_[i].nodes.push_back({op, 0, false, counts[i]});
  }
  for (std::uint32_t i = 1; i < program_.nodes.size(); ++i) {
    BooleanNode node = program_.nodes[i];
    const bool is_child = node.parent == kRoot;
    auto& [is_second, number] = nodes[i];
    if (!is_child) is_second = nodes[node.parent].first;
    BooleanProgram& program = half_programs_[is_second ? 1 : 0];
    if (is_child && counts[is_second ? 1 : 0] == 1) {
      // It is the half.
      number = kRoot;
      program.nodes[kRoot] = {node.op, 0, false, node.child_count};
      continue;
    }
    number = static_cast<std::uint32_t>(program.nodes.size());
    node.parent = is_child ? kRoot : nodes[node.parent].second;
    program.nodes.push_back(node);
  }
  // Those at the root have their places already.
  for (std::uint32_t i = 0; i < program_.operands.size(); ++i) {
    Operand operand = program_.operands[i];
    auto& [is_second, number] = places_[i];
    if (operand.parent != 0) is_second = nodes[operand.parent].first;
    operand.parent = nodes[operand.parent].second;
    BooleanProgram& program = half_programs_[is_second ? 1 : 0];
    number = static_cast<std::uint32_t>(program.operands.size());
    program.operands.push_back(operand);
  }
}

std::array<Cascade::Chains, 2> Cascade::Group::chains_of_halves(
    const LayerChains& layer) const {
  std::array<Chains, 2> halves;
  auto chain = layer.chains.begin();
  for (const ChainLoop& loop : layer.loops) {
    const auto [is_second, number] = places_[chain->operand];
    halves[is_second ? 1 : 0].add(loop, {chain, loop.chain_count}, number);
    chain += loop.chain_count;
  }
  return halves;
}

void Cascade::Group::keep(const LayerChains& layer, const Contours& contours) {
  kept_chains_.chains.assign(layer.chains.begin(), layer.chains.end());
  kept_chains_.loops.assign(layer.loops.begin(), layer.loops.end());
  kept_points_.clear();
  for (const Chain& chain : layer.chains) {
    const auto points = chain.points_in(layer.points);
    kept_points_.insert(kept_points_.end(), points.begin(), points.end());
  }
  kept_contours_ = contours;
}

const Contours* Cascade::Group::find_kept(const LayerChains& layer) const {
  if (!std::ranges::equal(layer.loops, kept_chains_.loops)) return nullptr;
  auto kept = kept_points_.begin();
  const auto is_kept = [&](const Chain& a, const Chain& b) {
    if (a.operand != b.operand || a.winding != b.winding ||
        a.point_count != b.point_count) {
      return false;
    }
    const auto points = a.points_in(layer.points);
    const auto begin = kept;
    kept += a.point_count;
    return std::equal(points.begin(), points.end(), begin);
  };
  return std::ranges::equal(layer.chains, kept_chains_.chains, is_kept)
             ? &kept_contours_
             : nullptr;
}

Cascade::Levels::Levels(DifferenceLevels levels)
    : split(std::move(levels)), runs(split.programs.size()) {
  for (const BooleanProgram& program : split.programs) {
    groups.push_back(std::make_unique<Group>(program));
  }
}

Cascade::Levels::~Levels() = default;

Cascade::Levels* Cascade::Group::levels() {
  if (may_have_levels_) {
    may_have_levels_ = false;
    DifferenceLevels levels = difference_levels(program_);
    if (levels.programs.size() >= kFewestLevels) {
      levels_ = std::make_unique<Levels>(std::move(levels));
    }
  }
  return levels_.get();
}

Cascade::Cascade(const BooleanProgram& program, const SweepOptions& options,
                 double patience)
    : options_(options),
      patience_(patience),
      ray_(options),
      root_(std::make_unique<Group>(program)),
      clips_(has_active_zones(program)),
      clipper_(program),
      covered_(program) {
  block_.layer_count = 1;
}

Cascade::~Cascade() = default;

void Cascade::sweep(const LayerChains& layer, Contours& contours) {
  ++counts_.layers;
  counts_.chains += layer.chains.size();
  for (const Chain& chain : layer.chains) counts_.points += chain.point_count;
  is_resolved_ = false;
  if (clips_) {
    clip_and_sweep(layer, contours);
  } else if (!sweep_at_once(root_->states(), layer, contours,
                            patience_for(*root_, layer))) {
    uncover_and_sweep(layer, contours);
  }
  if (is_resolved_) ++counts_.resolved_layers;
}

// Clips the layer if it proves to be worthwhile.
void Cascade::clip_and_sweep(const LayerChains& layer, Contours& contours) {
  const Patience first{patience_ * kBeforeClipping.swaps_per_chain,
                       patience_ * kBeforeClipping.first_swaps};
  if (sweep_at_once(root_->states(), layer, contours, first)) return;
  clipper_.begin(layer);
  if (clipper_.share_within() < kMostWithin) {
    const LayerChains clipped = clipper_.clip();
    if (!sweep_at_once(root_->states(), clipped, contours,
                       patience_for(*root_, clipped))) {
      uncover_and_sweep(clipped, contours);
    }
    return;
  }
  if (resume(contours, patience_for(*root_, layer))) return;
  uncover_and_sweep(layer, contours);
}

// Sweeps a layer whose sweep was given up: at once if few leaves show.
void Cascade::uncover_and_sweep(const LayerChains& layer, Contours& contours) {
  const double swaps = expected_swaps(layer);
  const LayerChains shown = covered_.leave_out(layer);
  if (static_cast<double>(shown.chains.size()) <
      kMostUncovered * static_cast<double>(layer.chains.size())) {
    sweep(*root_, shown, 0, contours);
  } else {
    sweep_halves(*root_, layer, swaps, contours);
  }
}

// `expected_swaps`: for each chain.
void Cascade::sweep(Group& group, const LayerChains& layer,
                    double expected_swaps, Contours& contours) {
  const Patience patience = patience_for(group, layer);
  if (expected_swaps <= kMostExpected * patience.swaps_per_chain) {
    if (sweep_at_once(group.states(), layer, contours, patience)) return;
    expected_swaps = this->expected_swaps(layer);
  }
  sweep_halves(group, layer, expected_swaps, contours);
}

// For each chain of a layer whose sweep was given up.
double Cascade::expected_swaps(const LayerChains& layer) const {
  return std::max(ray_.swaps_per_chain(),
                  sample_crossings_per_chain(layer, options_.tie_distance));
}

Patience Cascade::patience_for(Group& group, const LayerChains& layer) const {
  if (patience_ > 0 && is_mostly_one_leaf(layer.chains)) return {};
  const double most_swaps =
      patience_ *
      (group.states().is_simple() ? kMostSwapsOfSimple : kMostSwaps);
  return {most_swaps, patience_ * kFirstSwaps +
                          kFirstShare * most_swaps *
                              static_cast<double>(layer.chains.size())};
}

void Cascade::sweep_halves(Group& group, const LayerChains& layer,
                           double expected_swaps, Contours& contours) {
  if (Levels* levels = group.levels()) {
    sweep_levels(*levels, layer, contours);
    return;
  }
  if (!group.part()) {
    sweep_at_once(group.states(), layer, contours, {});
    return;
  }
  const auto halves = group.chains_of_halves(layer);
  Contours second;
  for (std::size_t i = 0; i < 2; ++i) {
    const LayerChains half{layer.points, halves[i].chains, halves[i].loops};
    const double share = static_cast<double>(half.chains.size()) /
                         static_cast<double>(layer.chains.size());
    sweep_half(group.half(i), half, share * expected_swaps,
               i == 0 ? contours : second);
  }
  merge(group.op(), second, contours);
}

void Cascade::sweep_levels(Levels& levels, const LayerChains& layer,
                           Contours& contours) {
  std::vector<Chains> chains(levels.groups.size());
  auto chain = layer.chains.begin();
  for (const ChainLoop& loop : layer.loops) {
    const auto [level, number] = levels.split.places[chain->operand];
    chains[level].add(loop, {chain, loop.chain_count}, number);
    chain += loop.chain_count;
  }
  contours = *sweep_run(levels, layer.points, chains, 0, false).result;
}

// Sweeps the levels from `begin` on, as many as there are chains of.
Cascade::Run Cascade::sweep_run(Levels& levels, std::span<const Vec2> points,
                                std::span<const Chains> chains,
                                std::size_t begin, bool needs_all) {
  if (chains.size() == 1) {
    Group& group = *levels.groups[begin];
    const LayerChains layer{points, chains[0].chains, chains[0].loops};
    const bool is_kept = group.find_kept(layer) != nullptr;
    Contours contours;
    if (!is_kept) sweep_half(group, layer, 0, contours);
    const Contours* kept = group.find_kept(layer);
    return {kept, kept, is_kept};
  }
  const std::size_t half = chains.size() / 2;
  const Run first = sweep_run(levels, points, chains.first(half), begin, true);
  const Run second =
      sweep_run(levels, points, chains.subspan(half), begin + half, needs_all);
  Levels::Joined& joined = levels.runs[begin + half];
  const bool is_kept = joined.is_made && first.is_kept && second.is_kept;
  if (!is_kept) {
    // Where all of the first levels are, the second ones decide.
    Contours below = *first.all;
    merge(BooleanOp::kIntersection, *second.result, below);
    joined.result = *first.result;
    merge(half % 2 == 0 ? BooleanOp::kUnion : BooleanOp::kDifference, below,
          joined.result);
    if (needs_all) {
      joined.all = *first.all;
      merge(BooleanOp::kIntersection, *second.all, joined.all);
    }
    joined.is_made = true;
  }
  return {&joined.result, &joined.all, is_kept};
}

// A half often has the chains that it had in the layer before, as where only
// the rest of the scene is not upright.
void Cascade::sweep_half(Group& half, const LayerChains& layer,
                         double expected_swaps, Contours& contours) {
  if (const Contours* kept = half.find_kept(layer)) {
    contours = *kept;
    return;
  }
  sweep(half, layer, expected_swaps, contours);
  half.keep(layer, contours);
}

bool Cascade::sweep_at_once(ProgramStates& states, const LayerChains& layer,
                            Contours& contours, const Patience& patience) {
  ray_.begin(layer, states);
  return resume(contours, patience);
}

// Goes on with the sweep that was given up last.
bool Cascade::resume(Contours& contours, const Patience& patience) {
  if (!ray_.resume(contours, patience)) return false;
  if (ray_.has_jumps()) {
    if (!resolver_) {
      const SweepOptions resolved{.tie_distance = kClusterWidth,
                                  .merge_distance = kResolvedMergeDistance,
                                  .least_area = options_.least_area};
      resolver_.emplace(resolved, FillRule::kPositive);
    }
    resolver_->resolve(contours);
    is_resolved_ = true;
  }
  return true;
}

void Cascade::merge(BooleanOp op, const Contours& second, Contours& contours) {
  auto& states = merges_[static_cast<std::size_t>(op)];
  if (!states) states.emplace(program_of(op, 2), FillRule::kNonZero);
  builder_.begin(block_);
  std::uint32_t number = 0;
  for (const Contours* operand : {&std::as_const(contours), &second}) {
    for (std::size_t i = 0; i < operand->loop_count(); ++i) {
      const auto loop = operand->loop(i);
      builder_.loop().assign(loop.begin(), loop.end());
      builder_.close_loop(0, number, 1);
    }
    ++number;
  }
  builder_.finish(block_);
  sweep_at_once(*states, block_.chains_of(0), contours, {});
}

SweepCounts Cascade::counts() const {
  SweepCounts counts = counts_;
  const SweepCounts swept = ray_.counts();
  counts += swept;
  counts.states = root_->states_met();
  if (!resolver_) return counts;
  // Second sweeps count only what went wrong.
  const SweepCounts resolved = resolver_->counts();
  counts.unbalanced_clusters += resolved.unbalanced_clusters;
  counts.repaired_clusters += resolved.repaired_clusters;
  counts.capped_clusters += resolved.capped_clusters;
  return counts;
}

}  // namespace lamina::plane
