#pragma once
// Guided local search: pieces that overlap are moved to where they overlap
// least, until none does.
//
// The price of a place is the sum over all other pieces of the depth of the
// overlap (no_fit_table.h) times the pair's weight. A piece that overlaps is
// moved to the cheapest place that is found: the price of every fourth place of
// the plate is computed in each turn, and the best of these are improved step
// by step. After each round the weights of pairs that still overlap grow by up
// to their double, those of others shrink towards 1: so no pair goes on to
// overlap for ever, and the search leaves local minima.
//
// Source: Voudouris and Tsang 1999 for the method; Egeblad, Nielsen and Odgaard
// 2007 for packing with overlaps; Gardeyn and Vanden Berghe, "An open-source
// heuristic to reboot 2D nesting research", 2025, for weights by the share of
// the greatest overlap and for their decay. Departures: the depth is that of
// the no-fit polygon, not of circles inside; places are not drawn by lot but
// looked at on a lattice.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/vec.h"
#include "slicer/plate/detail/no_fit_table.h"
#include "slicer/plate/detail/turned_piece.h"

namespace lamina::slicer {

// The no-fit tables of turned pieces, made when they are asked for.
class NoFitTables {
 public:
  NoFitTables(std::span<const TurnedPiece> turned, double step);

  const NoFitTable& of(std::size_t a, std::size_t b);
  double step() const { return step_; }
  // What it took to make the tables so far, as GuidedSearch counts it.
  double work() const { return work_; }

 private:
  const std::vector<plane::Contour>& parts_of(std::size_t turned);

  std::span<const TurnedPiece> turned_;
  double step_;
  double work_ = 0;
  std::vector<std::vector<plane::Contour>> parts_;  // empty until they are cut
  std::unordered_map<std::size_t, std::unique_ptr<NoFitTable>> tables_;
};

// A copy of a piece at a place of the lattice.
struct LatticePiece {
  std::size_t turned = 0;
  CellPlace place;
};

class GuidedSearch {
 public:
  // turns  of each piece
  GuidedSearch(std::span<const TurnedPiece> turned, unsigned turns,
               NoFitTables& tables, std::uint32_t seed)
      : turned_(turned), turns_(turns), tables_(tables), random_(seed) {}

  // The area within which pieces lie; each fits it in one of its turns [mm].
  void set_area(Vec2 area) { area_ = area; }
  // Forgets all weights.
  void set_pieces(std::vector<LatticePiece> pieces);
  const std::vector<LatticePiece>& pieces() const { return pieces_; }

  // Moves pieces until none overlaps another one; false where many rounds in
  // turn did not lower the overlap, or the work is used up.
  //
  // patience  how many rounds in turn
  bool separate(std::size_t patience);
  // The pieces of the round with the least overlap.
  const std::vector<LatticePiece>& least_overlap() const {
    return least_overlap_;
  }

  // Exchanges the places of two pieces that differ.
  void exchange_two();
  // Shifts pieces behind a random column to the left, by so many columns.
  void shift_left(std::int32_t columns);

  // How many numbers may be looked at: about one in a nanosecond. The search
  // ends when they are used up: unlike seconds, this gives the same result on
  // every machine.
  void set_work(double work) {
    most_work_ = work + used_work_ + tables_.work();
  }
  // What is left of it.
  double work() const { return most_work_ - used_work_ - tables_.work(); }

 private:
  struct Candidate {
    double price;
    LatticePiece piece;
  };

  void use_work(double work) { used_work_ += work; }
  CellPlace last_place(std::size_t turned) const;
  bool fits(std::size_t turned) const;
  // Turns the piece if it does not fit, and moves it into the area.
  void keep_inside(LatticePiece& piece) const;
  std::uint8_t depth(std::size_t i, std::size_t k);
  double measure();
  void raise_weights();
  std::vector<std::size_t> draw_order();
  void move(std::size_t i);
  void find_tables(std::size_t i, std::size_t turned);
  void fill_grid(std::size_t i, CellPlace last);
  void find_candidates(std::size_t i, std::size_t turned);
  void find_near(std::size_t i, CellPlace place);
  double price(std::size_t i, CellPlace place) const;
  bool take_step(std::size_t i, std::int32_t step, CellPlace low,
                 CellPlace high, Candidate& candidate);
  Candidate improve(std::size_t i, LatticePiece piece);
  std::size_t draw_large();
  std::uint32_t random_below(std::size_t count) {
    return static_cast<std::uint32_t>(random_() % count);
  }

  std::span<const TurnedPiece> turned_;
  unsigned turns_;
  NoFitTables& tables_;
  std::mt19937 random_;
  Vec2 area_ = Vec2(0);
  double most_work_ = 0;
  double used_work_ = 0;
  std::vector<LatticePiece> pieces_;
  std::vector<LatticePiece> least_overlap_;
  std::vector<float> weights_;        // of pairs, both ways
  std::vector<std::uint8_t> depths_;  // of pairs, both ways
  CoarseGrid grid_;
  std::vector<const NoFitTable*> near_tables_;  // of piece k and the moved one
  std::vector<std::size_t> near_;               // pieces in reach
  std::vector<LatticePiece> candidates_;
  // The least sum of each column of the grid.
  std::vector<std::pair<std::uint16_t, std::int32_t>> columns_;
};

}  // namespace lamina::slicer
