#pragma once
// The tables of lookup(): pairs of a key and a value, in any order.
//
// OpenSCAD reads the whole table at each call. So does the first call here; but
// designs ask one table again and again, and then a long one is sorted once.
// Values never change, so a table that is held is the table that was sorted.

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "csg/eval/value/value.h"

namespace lamina::csg {

class LookupTables {
 public:
  // Interpolates between the greatest key up to `key` and the least one from
  // it on; beyond the ends the outermost value holds. Of equal keys the first
  // counts. Rows that are no pair of numbers are passed over, but where the
  // first is none there is nothing.
  //
  // table  a vector
  std::optional<double> find(const Value& table, double key);

 private:
  struct Pair {
    double key = 0;
    double value = 0;
  };
  struct Neighbours {
    Pair low;   // greatest key up to what was asked; else the first pair
    Pair high;  // least key from there on; else the first pair
  };
  struct Known {
    Value table;
    std::vector<Pair> sorted;  // empty at first
  };

  static std::optional<Pair> pair_of(const Value& row);
  static Neighbours read_all(Pair first, std::span<const Value> rows,
                             double key);
  static std::vector<Pair> sort(std::span<const Value> rows);
  static Neighbours search(Pair first, std::span<const Pair> sorted,
                           double key);
  Neighbours neighbours(const Value& table, Pair first, double key);

  std::vector<Known> known_;  // long tables, asked last first
};

}  // namespace lamina::csg
