#include "slicer/supports/detail/wish_cover.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/geometric.hpp>

namespace lamina::slicer::detail {

WishCover::WishCover(const std::vector<Wish>& wishes, double greatest)
    : wishes_(wishes), cell_(greatest), holders_(wishes.size()) {
  for (std::uint32_t k = 0; k < wishes.size(); ++k) {
    cells_[cell_of(wishes[k].place)].push_back(k);
  }
}

void WishCover::add(std::size_t candidate, const std::vector<Vec2>& places,
                    double radius) {
  Choice choice = {candidate, 0, {}};
  for (const Vec2 place : places) {
    const std::size_t before = choice.held.size();
    add_around(place, radius, choice.held);
    if (choice.held.size() > before) ++choice.contacts;
  }
  if (choice.contacts == 0) return;
  std::ranges::sort(choice.held);
  choice.held.erase(std::ranges::unique(choice.held).begin(),
                    choice.held.end());
  queue_.push({worth_of(choice), choices_.size()});
  choices_.push_back(std::move(choice));
}

std::vector<std::size_t> WishCover::choose() {
  std::vector<std::size_t> chosen;
  while (!queue_.empty()) {
    Ranked best = queue_.top();
    queue_.pop();
    // What a choice is worth only becomes less, so that it is the best if it
    // still is when it is counted again (Minoux 1978).
    best.worth = worth_of(choices_[best.choice]);
    if (best.worth == 0) continue;
    if (!queue_.empty() && best < queue_.top()) {
      queue_.push(best);
      continue;
    }
    chosen.push_back(best.choice);
    count(choices_[best.choice], 1);
  }
  leave_out_spare(chosen);
  join_pairs(chosen);
  leave_out_spare(chosen);
  for (std::size_t& choice : chosen) choice = choices_[choice].candidate;
  return chosen;
}

WishCover::Cell WishCover::cell_of(Vec2 place) const {
  return {static_cast<int>(std::floor(place.x / cell_)),
          static_cast<int>(std::floor(place.y / cell_))};
}

void WishCover::add_around(Vec2 place, double radius,
                           std::vector<std::uint32_t>& held) const {
  const Cell cell = cell_of(place);
  for (int x = cell.first - 1; x <= cell.first + 1; ++x) {
    for (int y = cell.second - 1; y <= cell.second + 1; ++y) {
      const auto found = cells_.find({x, y});
      if (found == cells_.end()) continue;
      std::ranges::copy_if(
          found->second, std::back_inserter(held), [&](std::uint32_t k) {
            return glm::distance(wishes_[k].place, place) <= radius;
          });
    }
  }
}

// How many wishes that nothing holds yet each of its contacts holds.
double WishCover::worth_of(const Choice& choice) const {
  const auto left = std::ranges::count_if(
      choice.held, [&](std::uint32_t k) { return holders_[k] == 0; });
  return static_cast<double>(left) / static_cast<double>(choice.contacts);
}

void WishCover::count(const Choice& choice, std::int32_t change) {
  for (const std::uint32_t k : choice.held) holders_[k] += change;
}

void WishCover::leave_out_spare(std::vector<std::size_t>& chosen) {
  std::erase_if(chosen, [&](std::size_t number) {
    const Choice& choice = choices_[number];
    const bool is_needed = std::ranges::any_of(
        choice.held, [&](std::uint32_t k) { return holders_[k] == 1; });
    if (!is_needed) count(choice, -1);
    return !is_needed;
  });
}

std::vector<std::uint32_t> WishCover::only_held_by(const Choice& one,
                                                   const Choice& other) const {
  std::vector<std::uint32_t> held;
  std::ranges::set_union(one.held, other.held, std::back_inserter(held));
  std::erase_if(held, [&](std::uint32_t k) {
    const std::int32_t own =
        (std::ranges::binary_search(one.held, k) ? 1 : 0) +
        (std::ranges::binary_search(other.held, k) ? 1 : 0);
    return holders_[k] > own;
  });
  return held;
}

void WishCover::join_pairs(std::vector<std::size_t>& chosen) {
  constexpr std::size_t kMost = 64;  // the pairs of more are too many
  if (chosen.size() > kMost) return;
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    for (std::size_t b = a + 1; b < chosen.size(); ++b) {
      const Choice& one = choices_[chosen[a]];
      const Choice& other = choices_[chosen[b]];
      const std::vector<std::uint32_t> both = only_held_by(one, other);
      if (both.empty()) continue;  // they will be left out
      const auto better =
          std::ranges::find_if(choices_, [&](const Choice& choice) {
            return choice.contacts < one.contacts + other.contacts &&
                   std::ranges::includes(choice.held, both);
          });
      if (better == choices_.end()) continue;
      count(one, -1);
      count(other, -1);
      count(*better, 1);
      chosen[a] = static_cast<std::size_t>(better - choices_.begin());
      chosen.erase(chosen.begin() + static_cast<std::ptrdiff_t>(b));
      b = a;
    }
  }
}

}  // namespace lamina::slicer::detail
