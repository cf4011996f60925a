#pragma once
// Few contacts that hold many places: a greedy cover, and what can be left out
// of it again.
//
// Each time those contacts are chosen that hold the most of what is left,
// counted for each of them; contacts that look the same come together. Then
// choices are left out whose places others hold as well, and one choice is put
// in the place of two where it holds what only these do.

#include <cstddef>
#include <cstdint>
#include <map>
#include <queue>
#include <utility>
#include <vector>

#include "base/vec.h"

namespace lamina::slicer::detail {

// A place that must be within reach of a contact.
struct Wish {
  Vec2 place = Vec2(0);
  double out = 0;           // how far it is from what is below [mm]
  bool is_contact = false;  // a contact stands there in any case
};

class WishCover {
 public:
  // wishes   the first is preferred among equal ones; must outlive it
  // greatest of all radii [mm]
  WishCover(const std::vector<Wish>& wishes, double greatest);

  // Adds contacts that can be chosen together, at these places.
  //
  // candidate  the caller's name for them
  // radius     within which they hold wishes [mm]
  void add(std::size_t candidate, const std::vector<Vec2>& places,
           double radius);

  // Returns what was chosen, by the caller's names.
  std::vector<std::size_t> choose();

 private:
  struct Choice {
    std::size_t candidate = 0;
    std::size_t contacts = 0;
    std::vector<std::uint32_t> held;  // wishes, ascending
  };
  struct Ranked {
    double worth = 0;
    std::size_t choice = 0;

    bool operator<(const Ranked& other) const {
      return worth != other.worth ? worth < other.worth : choice > other.choice;
    }
  };
  using Cell = std::pair<int, int>;

  Cell cell_of(Vec2 place) const;
  void add_around(Vec2 place, double radius,
                  std::vector<std::uint32_t>& held) const;
  double worth_of(const Choice& choice) const;
  void leave_out_spare(std::vector<std::size_t>& chosen);
  void join_pairs(std::vector<std::size_t>& chosen);
  std::vector<std::uint32_t> only_held_by(const Choice& one,
                                          const Choice& other) const;
  void count(const Choice& choice, std::int32_t change);

  const std::vector<Wish>& wishes_;
  const double cell_;                  // its width [mm]
  std::vector<std::int32_t> holders_;  // of each wish: choices so far
  std::map<Cell, std::vector<std::uint32_t>> cells_;
  std::vector<Choice> choices_;
  std::priority_queue<Ranked> queue_;
};

}  // namespace lamina::slicer::detail
