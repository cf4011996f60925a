#pragma once
// Makes sections of a design that is given as text, judges each as it is made,
// and asks laws of them.
//
// Nothing here knows the right layers. A law compares sections of designs that
// depend on each other: wherever a point is well away from the boundaries of
// the operands, the result's loops must hold it or not, as the law says.

#include <functional>
#include <string>
#include <vector>

#include "base/vec.h"
#include "plane/contours.h"
#include "plane/tie_distance.h"
#include "slicer/slice/settings.h"

namespace lamina::support {

// A promise that did not hold, as a sentence with the designs.
struct BrokenLaw {
  std::string complaint;
};

// The design is refused with a message: it reaches too far, or is 2D.
struct Refused {
  std::string message;
};

// One set of loops for each height.
using Sections = std::vector<plane::Contours>;

// Where every edge of a loop must be: at most this far from where exact
// arithmetic has it, times the few faces that may tie in a row. Points nearer
// to a boundary are not asked [mm]: 10 · kTieDistance.
constexpr double kDoubt = 1e-5;

// Sections with all their vertices.
//
// throws  BrokenLaw where loops are not sound (contour_checks.h), reach out of
//         the scene's box, or a count of the sweep is not 0 that always is;
//         Refused; whatever a fault of the program throws, InternalError first
Sections sections_of(const std::string& design,
                     const std::vector<double>& heights, double pitch = 0);
// As the settings say, which give heights.
Sections sliced(const std::string& design, const slicer::Settings& settings);

// Those of the heights at which a section means one thing: no vertex of a leaf
// is nearer than kDoubt, or it is there but for rounding. Else the last bit of
// a matrix may decide what is above. Throws Refused.
std::vector<double> clear_heights(const std::string& design,
                                  const std::vector<double>& heights);

// Whether a point is inside, of whether it is inside of each operand.
using Rule = std::function<bool(const std::vector<bool>&)>;

// Asks beside all edges of result and operands, on both sides, and in the
// middle of each loop's vertices. All have the same heights.
//
// throws  BrokenLaw; `law` is its first word
void expect_rule(const std::string& law, const Sections& result,
                 const std::vector<Sections>& operands, const Rule& rule);

// Both are the same set.
void expect_same(const std::string& law, const Sections& result,
                 const Sections& operand);

// The areas of the left add up to those of the right, within kTieDistance on
// both sides of all their boundaries, those of `parts` included.
void expect_equal_areas(const std::string& law,
                        const std::vector<Sections>& left,
                        const std::vector<Sections>& right);

Sections mapped(Sections sections, const std::function<Vec2(Vec2)>& map);

}  // namespace lamina::support
