#include "csg/eval/value/value.h"

#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

TEST(Value, AppendingLeavesTheOldValueAsItWas) {
  const Value ab = Value::string("ab");
  const Value abc = ab.with_appended("c");
  const Value abd = ab.with_appended("d");
  const Value abce = abc.with_appended("e");
  EXPECT_EQ(ab.as_string(), "ab");
  EXPECT_EQ(abc.as_string(), "abc");
  EXPECT_EQ(abd.as_string(), "abd");
  EXPECT_EQ(abce.as_string(), "abce");
}

TEST(Value, AppendingAtTheEndOfABufferSharesIt) {
  const std::string a(100, 'a');
  const Value ab = Value::string(a).with_appended("b");
  const Value abc = ab.with_appended("c");
  EXPECT_EQ(ab.as_string().data(), abc.as_string().data());
  // The place behind "…ab" is taken now.
  EXPECT_NE(ab.with_appended("d").as_string().data(), abc.as_string().data());
}

TEST(Value, AppendingElementsObeysTheSameLaw) {
  std::mt19937 random(7);
  std::vector<Value> values = {Value::vector({})};
  std::vector<std::vector<double>> truth = {{}};
  for (int step = 0; step < 2000; ++step) {
    const std::size_t from = random() % values.size();
    const std::size_t more = random() % values.size();
    if (truth[from].size() + truth[more].size() > 500) continue;
    const Value number(static_cast<double>(step));
    values.push_back(values[from]
                         .with_appended(values[more].as_vector())
                         .with_appended(std::span<const Value>(&number, 1)));
    truth.push_back(truth[from]);
    truth.back().insert(truth.back().end(), truth[more].begin(),
                        truth[more].end());
    truth.back().push_back(step);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::span<const Value> elements = values[i].as_vector();
    ASSERT_EQ(elements.size(), truth[i].size());
    for (std::size_t k = 0; k < elements.size(); ++k) {
      ASSERT_EQ(elements[k].as_number(), truth[i][k]);
    }
  }
}

// Characters by a walk from the beginning.
std::vector<std::string> characters(const std::string& text) {
  std::vector<std::string> all;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) all.emplace_back();
    all.back() += c;
  }
  return all;
}

TEST(Value, FindsEveryCharacterOfUnicodeText) {
  const std::vector<std::string> alphabet = {"a", "é", "水", "🂡", "z"};
  std::mt19937 random(11);
  for (const std::size_t first : {std::size_t{0}, std::size_t{200}}) {
    std::string text(first, 'x');
    for (int i = 0; i < 500; ++i) text += alphabet[random() % alphabet.size()];
    const std::vector<std::string> truth = characters(text);
    // Grown in two steps, so that the index has to grow, too.
    Value value = Value::string(text.substr(0, first));
    value = value.with_appended(text.substr(first));
    ASSERT_EQ(value.character_count(), truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      ASSERT_EQ(value.character(static_cast<std::uint32_t>(i)).as_string(),
                truth[i]);
    }
  }
}

TEST(Range, CountsLikeOpenScad) {
  const auto count = [](double begin, double step, double end) {
    return Value::range(begin, step, end).as_range().count();
  };
  constexpr std::uint32_t kEndless = 4294967295U;
  EXPECT_EQ(count(0, 1, 10), 11);
  EXPECT_EQ(count(0, 0.1, 1), 11);  // 1 / 0.1 may be just below 10
  EXPECT_EQ(count(5, 1, 0), 0);
  EXPECT_EQ(count(5, -1, 0), 6);
  EXPECT_EQ(count(0, 0, 1), kEndless);
  EXPECT_EQ(count(0, 1, 1e12), kEndless);
}

}  // namespace
}  // namespace lamina::csg
