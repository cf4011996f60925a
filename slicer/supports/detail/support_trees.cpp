#include "slicer/supports/detail/support_trees.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace lamina::slicer::detail {
namespace {

// Pillars lean no farther than this [mm], and no more of them to one.
constexpr double kFarthestBranch = 10;
constexpr std::size_t kMostBranches = 3;

// What saves less than this is not worth a joint [mm³].
constexpr double kLeastSaving = 3;

class TreeMaker {
 public:
  TreeMaker(std::span<const Isometry> symmetries, const SupportRouter& router,
            const SupportSizes& sizes, double bed,
            std::vector<Support>& supports)
      : symmetries_(symmetries),
        router_(router),
        sizes_(sizes),
        bed_(bed),
        supports_(supports) {
    find_images();
  }

  void make() {
    struct Candidate {
      Merge merge;
      double saving = 0;
    };
    std::vector<Candidate> candidates;
    for (std::size_t i = 0; i < supports_.size(); ++i) {
      for (std::size_t k = 0; k < supports_.size(); ++k) {
        const double saving = saving_of({i, k});
        if (saving > kLeastSaving) candidates.push_back({{i, k}, saving});
      }
    }
    // Rounding must not decide.
    std::ranges::stable_sort(candidates, std::greater<>(),
                             [](const Candidate& candidate) {
                               return std::round(1e3 * candidate.saving);
                             });
    for (const Candidate& candidate : candidates) {
      if (const auto all = orbit_of(candidate.merge)) accept(*all);
    }
    for (const auto& [branch, trunk] : trunks_) {
      Support& support = supports_[branch];
      support.path.back() = joint_of({branch, trunk});
      support.end = SupportEnd::kPillar;
    }
  }

 private:
  // A branch, and the trunk that it leans to.
  using Merge = std::pair<std::size_t, std::size_t>;

  Vec3 top_of(std::size_t i) const { return supports_[i].pillar_top(); }

  Vec3 joint_of(const Merge& merge) const {
    const Vec3 top = top_of(merge.first);
    const Vec2 trunk = Vec2(top_of(merge.second));
    return {trunk, top.z - glm::distance(Vec2(top), trunk)};
  }

  // Of a merge that is possible [mm³]; else 0.
  double saving_of(const Merge& merge) const {
    const auto [branch, trunk] = merge;
    if (branch == trunk || supports_[branch].end != SupportEnd::kFoot ||
        supports_[trunk].end != SupportEnd::kFoot) {
      return 0;
    }
    const Vec3 top = top_of(branch);
    const double distance = glm::distance(Vec2(top), Vec2(top_of(trunk)));
    const double joint = top.z - distance;
    if (distance > kFarthestBranch || joint > top_of(trunk).z ||
        joint < bed_ + sizes_.foot_height + sizes_.pillar) {
      return 0;
    }
    const double section = std::numbers::pi / 4 * sizes_.pillar * sizes_.pillar;
    return section * (top.z - bed_ - distance * std::numbers::sqrt2);
  }

  // images_[k][i]: the image of support i under symmetry k.
  void find_images() {
    for (const Isometry& symmetry : symmetries_) {
      auto& images = images_.emplace_back();
      for (const Support& support : supports_) {
        images.push_back(find_image(support, symmetry));
      }
    }
  }

  std::optional<std::size_t> find_image(const Support& support,
                                        const Isometry& symmetry) const {
    const Support image = image_of(support, symmetry);
    for (std::size_t k = 0; k < supports_.size(); ++k) {
      if (has_same_way(image, supports_[k])) return k;
    }
    return std::nullopt;
  }

  // A merge with its images; no value where one of them is not possible, or
  // they contradict each other.
  std::optional<std::vector<Merge>> orbit_of(const Merge& merge) const {
    std::map<std::size_t, std::size_t> orbit;
    for (const auto& images : images_) {
      const auto branch = images[merge.first];
      const auto trunk = images[merge.second];
      if (!branch || !trunk) return std::nullopt;
      const auto [known, is_new] = orbit.try_emplace(*branch, *trunk);
      if (!is_new && known->second != *trunk) return std::nullopt;
    }
    for (const auto& [branch, trunk] : orbit) {
      if (trunks_.contains(branch) || trunks_.contains(trunk) ||
          branches_.contains(branch) || orbit.contains(trunk) ||
          !is_free({branch, trunk})) {
        return std::nullopt;
      }
      std::size_t more = 0;
      for (const auto& other : orbit) more += other.second == trunk ? 1 : 0;
      const auto known = branches_.find(trunk);
      if (more + (known == branches_.end() ? 0 : known->second) >
          kMostBranches) {
        return std::nullopt;
      }
    }
    return std::vector<Merge>(orbit.begin(), orbit.end());
  }

  bool is_free(const Merge& merge) const {
    Support leaning = supports_[merge.first];
    leaning.path.back() = joint_of(merge);
    leaning.end = SupportEnd::kPillar;
    return router_.is_free(leaning);
  }

  void accept(const std::vector<Merge>& merges) {
    for (const auto& [branch, trunk] : merges) {
      trunks_[branch] = trunk;
      ++branches_[trunk];
    }
  }

  std::span<const Isometry> symmetries_;
  const SupportRouter& router_;
  const SupportSizes& sizes_;
  const double bed_;
  std::vector<Support>& supports_;
  std::vector<std::vector<std::optional<std::size_t>>> images_;
  std::map<std::size_t, std::size_t> trunks_;    // of each branch
  std::map<std::size_t, std::size_t> branches_;  // how many a trunk has
};

}  // namespace

void merge_pillars(std::span<const Isometry> symmetries,
                   const SupportRouter& router, const SupportSizes& sizes,
                   double bed, std::vector<Support>& supports) {
  TreeMaker(symmetries, router, sizes, bed, supports).make();
}

}  // namespace lamina::slicer::detail
