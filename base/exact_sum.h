#pragma once
// Sums and products of doubles without rounding.
//
// Source: Shewchuk, "Adaptive precision floating-point arithmetic and fast
// robust geometric predicates", 1997, Grow-Expansion with zeros left out.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace lamina {

inline int sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// A sum of doubles, kept exactly: none of its terms overlaps another one, and
// they grow. It has no more terms than were added, a product counting as two.
// No sum may overflow, no product underflow.
template <std::size_t kMostTerms>
class ExactSum {
 public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + terms_[i];
      const double part = sum - x;
      const double rest = (x - (sum - part)) + (terms_[i] - part);
      if (rest != 0) terms_[kept++] = rest;
      x = sum;
    }
    size_ = kept;
    if (x != 0) terms_[size_++] = x;
  }
  void add_product(double p, double q) {
    const double product = p * q;
    add(std::fma(p, q, -product));
    add(product);
  }
  template <std::size_t kLeft, std::size_t kRight>
  void add_product(const ExactSum<kLeft>& p, const ExactSum<kRight>& q) {
    static_assert(2 * kLeft * kRight <= kMostTerms);
    for (const double left : p.terms()) {
      for (const double right : q.terms()) add_product(left, right);
    }
  }

  std::span<const double> terms() const { return {terms_.data(), size_}; }
  int sign() const { return size_ == 0 ? 0 : lamina::sign(terms_[size_ - 1]); }

 private:
  std::array<double, kMostTerms> terms_;  // the first size_ of them
  std::size_t size_ = 0;
};

}  // namespace lamina
