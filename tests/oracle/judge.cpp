#include "tests/oracle/judge.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ostream.h>

template <>
struct fmt::formatter<lamina::oracle::RegionCounts> : fmt::ostream_formatter {};

namespace lamina::oracle {
namespace {

Verdict decide(const Comparison& comparison, const ExactRegion& expected,
               const ExactRegion& actual, const Allowance& allowance) {
  Verdict verdict;
  verdict.comparison = comparison;
  verdict.counts = comparison.expected_counts;
  if (comparison.expected_counts != comparison.actual_counts) {
    const auto settled_expected =
        count_regions(settle(expected, allowance.settle_distance));
    const auto settled_actual =
        count_regions(settle(actual, allowance.settle_distance));
    verdict.counts = settled_expected;
    verdict.was_settled = settled_expected == settled_actual;
    if (!verdict.was_settled) {
      verdict.complaint =
          fmt::format("expected {}, got {} (settled: {} and {}); ",
                      comparison.expected_counts, comparison.actual_counts,
                      settled_expected, settled_actual);
    }
  }
  // Where nothing is expected, slivers of rounding have a perimeter as well.
  const double perimeter =
      std::max(comparison.expected_perimeter, comparison.actual_perimeter);
  if (comparison.difference_area + comparison.overlap_area >
      allowance.distance * perimeter) {
    verdict.complaint += fmt::format(
        "the difference is {:.3g} mm² at a perimeter of {:.6g} mm, loops "
        "overlap in {:.3g} mm²; ",
        comparison.difference_area, perimeter, comparison.overlap_area);
  }
  if (!verdict.complaint.empty()) {
    verdict.complaint +=
        fmt::format("the largest difference is {:.3g} mm² at ({:.9g}, {:.9g})",
                    comparison.worst_area, comparison.worst_place.x,
                    comparison.worst_place.y);
  }
  return verdict;
}

}  // namespace

Verdict judge(const ExactRegion& expected, const plane::Contours& actual,
              const Allowance& allowance) {
  return decide(compare(expected, actual), expected, region_of_loops(actual),
                allowance);
}

Verdict judge(const ExactRegion& expected, const ExactRegion& actual,
              const Allowance& allowance) {
  return decide(compare(expected, actual), expected, actual, allowance);
}

}  // namespace lamina::oracle
