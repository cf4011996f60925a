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

TEST(Value, GrowingAtEitherEndLeavesTheOldValueAsItWas) {
  std::mt19937 random(11);
  std::vector<Value> values = {Value::vector({})};
  std::vector<std::vector<double>> truth = {{}};
  for (int step = 0; step < 4000; ++step) {
    // Mostly the last one, so that buffers are shared.
    const std::size_t from =
        random() % 4 > 0 ? values.size() - 1 : random() % values.size();
    std::vector<Value> more;
    std::vector<double> numbers;
    for (std::uint32_t n = random() % 4; n > 0; --n) {
      numbers.push_back(step + 0.1 * n);
      more.emplace_back(numbers.back());
    }
    std::vector<double> expected =
        truth[from].size() > 300 ? std::vector<double>() : truth[from];
    const Value old = expected.empty() ? Value::vector({}) : values[from];
    if (random() % 2 == 0) {
      values.push_back(old.with_prepended(more));
      expected.insert(expected.begin(), numbers.begin(), numbers.end());
    } else {
      values.push_back(old.with_appended(more));
      expected.insert(expected.end(), numbers.begin(), numbers.end());
    }
    truth.push_back(expected);
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::span<const Value> elements = values[i].as_vector();
    ASSERT_EQ(elements.size(), truth[i].size());
    for (std::size_t k = 0; k < elements.size(); ++k) {
      ASSERT_EQ(elements[k].as_number(), truth[i][k]);
    }
  }
}

// As many elements are copied in all as a doubling buffer copies.
TEST(Value, GrowingAtBothEndsCopiesSeldom) {
  for (const int back_every : {0, 1, 2, 5}) {
    Value vector = Value::vector({});
    std::size_t copied = 0;
    for (int i = 0; i < 20000; ++i) {
      const Value one(static_cast<double>(i));
      const bool is_at_back = back_every > 0 && i % back_every == 0;
      const Value grown = is_at_back ? vector.with_appended({&one, 1})
                                     : vector.with_prepended({&one, 1});
      if (!grown.is_identical(vector)) copied += vector.as_vector().size();
      vector = grown;
    }
    EXPECT_LT(copied, 100000U) << back_every;
  }
}

TEST(VectorGrower, HasItsElementsInOrder) {
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round) {
    VectorGrower grower;
    std::vector<double> expected;
    for (int piece = 0; piece < 6; ++piece) {
      std::vector<double> numbers(random() % 40);
      for (double& number : numbers)
        number = static_cast<double>(random() % 1000);
      expected.insert(expected.end(), numbers.begin(), numbers.end());
      if (random() % 3 == 0) {
        for (const double number : numbers) grower.push(Value(number));
      } else {
        grower.push_all(Value::numbers(numbers));
      }
    }
    const Value vector = grower.finish();
    ASSERT_EQ(vector.as_vector().size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      ASSERT_EQ(vector.as_vector()[i].as_number(), expected[i]);
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
