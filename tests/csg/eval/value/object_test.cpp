#include "csg/eval/value/object.h"

#include <algorithm>
#include <cstddef>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

// An object as a plain list.
using List = std::vector<std::pair<std::string, double>>;

List::iterator find(List& list, const std::string& key) {
  return std::find_if(list.begin(), list.end(),
                      [&](const auto& member) { return member.first == key; });
}

void set(List& list, const std::string& key, double value) {
  const auto place = find(list, key);
  if (place == list.end()) {
    list.emplace_back(key, value);
  } else {
    place->second = value;
  }
}

std::string key_name(int number) { return "k" + std::to_string(number); }

void expect_equal(const Value& object, const List& list) {
  const std::span<const Value> keys = object.as_object().keys.as_vector();
  ASSERT_EQ(keys.size(), list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(keys[i].as_string(), list[i].first);
    EXPECT_EQ(find_member(object, list[i].first).as_number(), list[i].second);
  }
}

TEST(ObjectBuilder, MakesOfOldObjectsNewOnesAndLeavesThoseAsTheyWere) {
  std::mt19937 random(1);
  const auto below = [&](int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random);
  };
  constexpr int kKeys = 40;
  std::vector<Value> objects{ObjectBuilder().finish()};
  std::vector<List> lists{{}};
  for (int round = 0; round < 2000; ++round) {
    // Mostly the last, so that objects grow; at times an older one.
    const int count = static_cast<int>(objects.size());
    const auto base =
        static_cast<std::size_t>(below(4) == 0 ? below(count) : count - 1);
    ObjectBuilder builder;
    List list;
    if (below(10) != 0) {
      builder.set_all(objects[base]);
      list = lists[base];
    }
    for (int edits = below(4); edits > 0; --edits) {
      const std::string key = key_name(below(kKeys));
      if (below(5) == 0) {
        builder.remove(key);
        const auto place = find(list, key);
        if (place != list.end()) list.erase(place);
      } else {
        builder.set(Value::string(key), Value(double{1} * round));
        set(list, key, round);
      }
    }
    if (below(10) == 0) {
      const auto other = static_cast<std::size_t>(below(count));
      builder.set_all(objects[other]);
      for (const auto& [key, value] : lists[other]) set(list, key, value);
    }
    objects.push_back(builder.finish());
    lists.push_back(std::move(list));
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    expect_equal(objects[i], lists[i]);
    for (int key = 0; key < kKeys; ++key) {
      EXPECT_EQ(has_member(objects[i], key_name(key)),
                find(lists[i], key_name(key)) != lists[i].end());
    }
  }
}

TEST(ObjectBuilder, CopiesNoKeysOfAnObjectThatGrows) {
  constexpr int kCount = 1000;
  std::vector<Value> objects{ObjectBuilder().finish()};
  std::set<const Value*> buffers;
  for (int i = 0; i < kCount; ++i) {
    ObjectBuilder builder;
    builder.set_all(objects.back());
    builder.set(Value::string(key_name(i)), Value(double{1} * i));
    objects.push_back(builder.finish());
    const Members& members = objects.back().as_object();
    EXPECT_EQ(members.places, objects[0].as_object().places);
    buffers.insert(members.keys.as_vector().data());
    buffers.insert(members.values.as_vector().data());
  }
  EXPECT_LT(buffers.size(), kCount / 10);
  EXPECT_FALSE(has_member(objects[500], key_name(500)));
  EXPECT_TRUE(has_member(objects[501], key_name(500)));
}

}  // namespace
}  // namespace lamina::csg
