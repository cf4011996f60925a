// Lack of memory at any one allocation: what comes back is right, or
// std::bad_alloc.

#include <cstddef>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "csg/facets.h"
#include "plane/region/boolean.h"
#include "plane/region/offset.h"

namespace {
// Allocations until one fails; none fails at 0.
std::size_t until_failure = 0;
}  // namespace

// Not inlined: GCC would see what `new` gave go to free().
[[gnu::noinline]] void* operator new(std::size_t size) {
  const bool fails = until_failure > 0 && --until_failure == 0;
  if (!fails) {
    if (void* const memory = std::malloc(size)) return memory;
  }
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace lamina::plane {
namespace {

// Lets each allocation within `make` fail, one in each call.
template <typename Make>
void expect_all_or_nothing(const Make& make) {
  const double whole = area(make());
  ASSERT_GT(whole, 0);
  std::size_t failures = 0;
  for (bool has_failed = true; has_failed;) {
    until_failure = failures + 1;
    has_failed = false;
    try {
      const Region region = make();
      has_failed = until_failure == 0;
      until_failure = 0;
      EXPECT_EQ(area(region), whole) << "allocation " << failures + 1;
    } catch (const std::bad_alloc&) {
      has_failed = true;
    }
    failures += has_failed;
  }
  EXPECT_GT(failures, 20U);
}

TEST(LackOfMemory, LeavesNoBooleanHalf) {
  const Region squares[] = {csg::square({4, 4}, true),
                            csg::square({6, 2}, true), csg::circle(1, 9)};
  expect_all_or_nothing([&] { return unite(squares); });
  expect_all_or_nothing([&] { return subtract(squares); });
  expect_all_or_nothing([&] { return intersect(squares); });
}

TEST(LackOfMemory, LeavesNoOffsetEmpty) {
  const Region part = csg::square({4, 3}, true);
  expect_all_or_nothing([&] { return offset(part, -1, Join::kMiter, 0.1); });
  expect_all_or_nothing([&] { return offset(part, 1, Join::kRound, 0.1); });
  const Contour path = {{0, 0}, {5, 5}, {5, 0}, {0, 5}};
  expect_all_or_nothing(
      [&] { return stroke(path, 1, Join::kRound, Cap::kRound, 0.1); });
}

}  // namespace
}  // namespace lamina::plane
