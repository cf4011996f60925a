#include "csg/eval/value/lookup_tables.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

Value pair(double key, double value) {
  const double numbers[] = {key, value};
  return Value::numbers(numbers);
}

// Rows in any order, some with equal keys, some that are no pairs.
Value random_table(std::mt19937& random, std::size_t size) {
  std::vector<Value> rows = {pair(3, 1)};
  while (rows.size() < size) {
    const double key = static_cast<double>(random() % 50);
    switch (random() % 8) {
      case 0:
        rows.push_back(Value(key));
        break;
      case 1:
        rows.push_back(pair(std::numeric_limits<double>::quiet_NaN(), 1));
        break;
      case 2:
        rows.push_back(pair(key, static_cast<double>(random() % 9)));
        break;
      default:
        rows.push_back(pair(key / 7, static_cast<double>(random() % 9)));
    }
  }
  return Value::vector(rows);
}

TEST(LookupTables, ATableThatIsAskedAgainGivesWhatItGaveAtFirst) {
  std::mt19937 random(5);
  LookupTables asked;
  for (int turn = 0; turn < 40; ++turn) {
    const Value table = random_table(random, 1 + random() % 200);
    for (double key = -1; key < 52; key += 0.25) {
      LookupTables fresh;
      EXPECT_EQ(asked.find(table, key), fresh.find(table, key))
          << table.as_vector().size() << " rows, key " << key;
    }
  }
}

TEST(LookupTables, AsLongATableOfOtherRowsIsAnother) {
  std::vector<Value> rows;
  for (int i = 0; i < 100; ++i) rows.push_back(pair(i, i));
  const Value table = Value::vector(rows);
  const Value longer = table.with_appended(std::vector<Value>{pair(200, 1)});
  LookupTables tables;
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_EQ(tables.find(table, 150), 99);
    EXPECT_EQ(tables.find(longer, 200), 1);
    EXPECT_EQ(tables.find(table, 1.5), 1.5);
  }
}

TEST(LookupTables, AFirstRowThatIsNoPairHasNothing) {
  std::vector<Value> rows(100, pair(1, 1));
  rows.front() = Value(2.0);
  LookupTables tables;
  EXPECT_EQ(tables.find(Value::vector(rows), 1), std::nullopt);
  EXPECT_EQ(tables.find(Value::vector({}), 1), std::nullopt);
}

}  // namespace
}  // namespace lamina::csg
