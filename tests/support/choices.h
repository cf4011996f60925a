#pragma once
// Where a generator of random designs gets its decisions: from a seed, the same
// on every machine, or from the bytes of a fuzzer, which then steers it.

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>

namespace lamina::support {

class Choices {
 public:
  virtual ~Choices() = default;
  // 0 to count - 1.
  virtual std::uint32_t below(std::uint32_t count) = 0;
  // In [0, 1).
  virtual double share() = 0;

  double between(double low, double high) {
    return low + (high - low) * share();
  }
};

// The standard's distributions differ from library to library; these do not.
class SeededChoices : public Choices {
 public:
  explicit SeededChoices(std::uint32_t seed) : random_(seed) {}

  std::uint32_t below(std::uint32_t count) override {
    return static_cast<std::uint32_t>(random_() % count);
  }
  double share() override { return static_cast<double>(random_()) / 0x1p32; }

 private:
  std::mt19937 random_;
};

// One byte a decision, two a share, so that a changed byte changes one thing.
// After the last byte every answer is 0: a generator for which 0 is the
// simplest choice comes to its end.
class ByteChoices : public Choices {
 public:
  explicit ByteChoices(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::uint32_t below(std::uint32_t count) override { return next() % count; }
  double share() override {
    const std::uint32_t high = next();
    return (high * 256 + next()) / 65536.0;
  }

 private:
  std::uint32_t next() {
    return place_ < bytes_.size() ? bytes_[place_++] : 0U;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t place_ = 0;
};

}  // namespace lamina::support
