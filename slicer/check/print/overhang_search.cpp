#include "slicer/check/print/overhang_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plane/loop_area.h"
#include "plane/predicates.h"

namespace lamina::slicer {
namespace {

constexpr double kNowhereNear = std::numeric_limits<double>::infinity();

// Places are so far apart [mm], where a layer needs no more than so many.
constexpr double kPlacePitch = 0.1;
constexpr double kMostPlaces = 512 * 512;

// A part has straight sides: so many columns, and places in one, tell of any.
constexpr double kMostOfPart = 64;

// In a column the next place follows after this share of the distance that the
// last one had beyond the reach: the greatest distance falls short by a tenth
// at most. Columns go by the greatest of the one before, and by half of that:
// what is greater may stand out to either side.
constexpr double kStride = 0.2;

// Segments to either side of a place that are looked at along a chain.
constexpr int kSegmentsAround = 16;

// By how many columns or places the search goes on where `length` [mm] holds
// more than enough of them.
double least_step(double length, double pitch) {
  const double enough = kMostOfPart * pitch;
  return length < 2 * enough ? 1.0 : std::floor(length / enough);
}

}  // namespace

// Successive vertices of either chain cut a ledge into trapezoids, its parts. A
// part where no place of the grid hangs over may still be a narrow bridge
// between them, so its middle is asked.
struct OverhangSearch::Part {
  explicit Part(const Ledge& its_ledge)
      : ledge(its_ledge),
        lower(its_ledge.lower),
        upper(its_ledge.upper),
        right(its_ledge.begin),
        right_width(upper.y_at(right) - lower.y_at(right)) {
    measure();
  }

  // False at the ledge's end, and where rounding puts that behind the end of a
  // chain.
  bool step() {
    if (right >= ledge.end) return false;
    const bool ends_lower = lower.right_x() == right;
    const bool ends_upper = upper.right_x() == right;
    if (ends_lower) {
      if (lower.is_last_segment()) return false;
      lower.step();
    }
    if (ends_upper) {
      if (upper.is_last_segment()) return false;
      upper.step();
    }
    measure();
    return true;
  }
  double greatest_width() const { return std::max(left_width, right_width); }

  const Ledge& ledge;
  plane::ChainCursor lower;
  plane::ChainCursor upper;
  double left = 0;
  double right = 0;
  double left_width = 0;  // in y
  double right_width = 0;

 private:
  void measure() {
    left = right;
    left_width = right_width;
    right = std::min({lower.right_x(), upper.right_x(), ledge.end});
    right_width = upper.y_at(right) - lower.y_at(right);
  }
};

void OverhangSearch::find(const plane::Contours& below,
                          const plane::Contours& above,
                          std::span<const Ledge> ledges, double reach,
                          std::vector<Overhang>& found) {
  if (ledges.empty()) return;
  below_ = &below;
  reach_ = reach;
  box_ = box_of(above.points);
  pitch_ = std::max(kPlacePitch, least_pitch(ledges));
  is_tree_filled_ = false;
  guess_ = 0;
  for (const Ledge& ledge : ledges) {
    search(ledge);
    if (overhang_.distance > 0) found.push_back(overhang_);
  }
}

// From which on the ledges take no more than the most places, their columns
// counted as one each besides.
double OverhangSearch::least_pitch(std::span<const Ledge> ledges) const {
  double length = 0;
  for (const Ledge& ledge : ledges) length += ledge.end - ledge.begin;
  const auto pitch_for = [&](double area) {
    return (length + std::sqrt(length * length + 4 * kMostPlaces * area)) /
           (2 * kMostPlaces);
  };
  // They hardly ever fill the layer's box.
  const double box_pitch = pitch_for(box_.size().x * box_.size().y);
  if (box_pitch <= kPlacePitch) return box_pitch;
  double area = 0;
  for (const Ledge& ledge : ledges) {
    Part part(ledge);
    do {
      area += (part.right - part.left) *
              std::max((part.left_width + part.right_width) / 2, 0.0);
    } while (part.step());
  }
  return pitch_for(area);
}

void OverhangSearch::search(const Ledge& ledge) {
  overhang_ = {};
  overhang_.region = ledge.region;
  column_ = -kNowhereNear;
  asked_vertex_ = Vec2(kNowhereNear);
  does_vertex_hang_over_ = false;
  Part part(ledge);
  if (part.greatest_width() > reach_) {
    if (!ledge.is_lower_held && part.lower.left_x() >= part.left) {
      ask_vertex(part, *part.lower.left());
    }
    if (!ledge.is_upper_held && part.upper.left_x() >= part.left) {
      ask_vertex(part, *part.upper.left());
    }
  }
  do {
    if (part.greatest_width() > reach_) search_part(part);
  } while (part.step());
}

void OverhangSearch::search_part(const Part& part) {
  const double area = overhang_.area;
  search_columns(part);
  if (!part.ledge.is_lower_held && part.lower.right_x() == part.right) {
    ask_vertex(part, part.lower.left()[1]);
  }
  if (!part.ledge.is_upper_held && part.upper.right_x() == part.right) {
    ask_vertex(part, part.upper.left()[1]);
  }
  if (overhang_.area == area) ask_middle(part);
}

void OverhangSearch::search_columns(const Part& part) {
  if (column_ * pitch_ < part.left) column_ = std::ceil(part.left / pitch_);
  const double least = least_step(part.right - part.left, pitch_);
  for (double columns = 1; column_ * pitch_ < part.right;) {
    if (columns > 1) {
      columns = std::min(columns, std::ceil(part.right / pitch_) - column_);
    }
    const double beyond = search_column(part, column_ * pitch_, columns);
    column_ += columns;
    columns = least;
    if (beyond > 0) {
      columns = std::max(least, std::floor(kStride / 2 * beyond / pitch_));
    }
  }
}

// The stretch of a column that no held chain above or below is within reach of.
// Where loops of a file cross, a ledge may reach beyond its layer.
double OverhangSearch::low_at(const Part& part, double x) const {
  return std::max(part.lower.y_at(x) + (part.ledge.is_lower_held ? reach_ : 0),
                  box_.low.y);
}
double OverhangSearch::high_at(const Part& part, double x) const {
  return std::min(part.upper.y_at(x) - (part.ledge.is_upper_held ? reach_ : 0),
                  box_.high.y);
}

// Returns how far beyond the reach the farthest place is that was asked.
//
// columns  for which this one stands: from here on to the right
double OverhangSearch::search_column(const Part& part, double x,
                                     double columns) {
  const double low = low_at(part, x);
  const double high = high_at(part, x);
  double farthest = 0;
  if (!(low <= high)) return farthest;
  const double last_row = std::floor(high / pitch_);
  if (last_row * pitch_ < low) return farthest;
  const double least = least_step(high - low, pitch_);
  for (double row = std::ceil(low / pitch_); row <= last_row;) {
    const Vec2 place(x, row * pitch_);
    const double distance = ask(part, place);
    if (distance <= reach_) {
      row += least;
      continue;
    }
    // What is nearer than that to the place hangs over as well.
    const double rows =
        std::max(least, std::floor(kStride * (distance - reach_) / pitch_));
    const double end = std::min(row + rows, last_row + 1);
    farthest = std::max(farthest, distance - reach_);
    overhang_.area += (end - row) * columns * pitch_ * pitch_;
    overhang_.box.add(Vec2(x, (end - 1) * pitch_));
    overhang_.box.add(Vec2(x + (columns - 1) * pitch_, row * pitch_));
    row = end;
  }
  return farthest;
}

// Asks the middle of a part, or of its free side if it has one whose vertex has
// not hung over.
void OverhangSearch::ask_middle(const Part& part) {
  const Ledge& ledge = part.ledge;
  if (ledge.has_free_side() && does_vertex_hang_over_) return;
  double left = part.left;
  double right = part.right;
  if (!(right - left > 2 * reach_)) return;
  // Leave the ends out that the two chains hold.
  const double held = reach_ * (static_cast<int>(ledge.is_lower_held) +
                                static_cast<int>(ledge.is_upper_held));
  const double begin = part.left_width - held;
  const double end = part.right_width - held;
  if (!(std::max(begin, end) > 0)) return;
  if (begin < 0) left += (right - left) * begin / (begin - end);
  if (end < 0) right = part.left + (right - part.left) * begin / (begin - end);
  const double width = right - left;
  if (!(width > 2 * reach_)) return;
  const double x = left + width / 2;
  const double low = low_at(part, x);
  const double high = high_at(part, x);
  const double height = high - low;
  if (!(height > 0)) return;
  const Vec2 place(x, !ledge.has_free_side() ? low + height / 2
                      : ledge.is_lower_held  ? high
                                             : low);
  const double distance = ask(part, place);
  if (distance <= reach_) return;
  // It is a strip along the part, as wide as its middle tells.
  for (const double end_x : {left, right}) {
    overhang_.box.add(Vec2(end_x, low_at(part, end_x)));
    overhang_.box.add(Vec2(end_x, high_at(part, end_x)));
  }
  overhang_.area += std::min(width * height, (ledge.has_free_side() ? 1 : 2) *
                                                 (distance - reach_) *
                                                 std::max(width, height));
}

// Asks a vertex of a free side, if the last one asked is not near.
void OverhangSearch::ask_vertex(const Part& part, Vec2 vertex) {
  const Vec2 away = vertex - asked_vertex_;
  if (std::abs(away.x) + std::abs(away.y) < pitch_) return;
  asked_vertex_ = vertex;
  does_vertex_hang_over_ = ask(part, vertex) > reach_;
}

// The distance from what holds the place; within reach, that from any such.
double OverhangSearch::ask(const Part& part, Vec2 place) {
  double distance = distance_to_chains(part, place);
  if (distance <= reach_) return distance;
  if (!is_tree_filled_) tree_.fill(*below_, plane::EdgeTree::Bundles::kRuns);
  is_tree_filled_ = true;
  distance = std::min(distance, tree_.distance(guess_, place));
  if (distance > reach_) tree_.lower(place, reach_, distance, guess_);
  if (distance <= reach_) return distance;
  overhang_.box.add(place);
  if (distance > overhang_.distance) {
    overhang_.distance = distance;
    overhang_.place = place;
  }
  return distance;
}

// The distance from those parts of the two chains near the place that hold it.
// Where chains are steep they are within reach, though not above or below.
double OverhangSearch::distance_to_chains(const Part& part, Vec2 place) const {
  const Ledge& ledge = part.ledge;
  double least = kNowhereNear;
  if (ledge.is_lower_held) {
    look_around(part.lower, ledge.lower.left(), place, least);
  }
  if (ledge.is_upper_held && least > reach_) {
    look_around(part.upper, ledge.upper.left(), place, least);
  }
  return least;
}

// Looks from a segment of a chain to both sides.
void OverhangSearch::look_around(const plane::ChainCursor& from,
                                 const Vec2* first, Vec2 place,
                                 double& least) const {
  const auto look = [&](const Vec2* segment) {
    least = std::min(least, distance_to_segment(place, segment[0], segment[1]));
  };
  const Vec2* left = from.left();
  const Vec2* right = from.left() + 1;
  for (int i = 0; i < kSegmentsAround && least > reach_; ++i) {
    const bool goes_left = left >= first && left[1].x >= place.x - reach_;
    const bool goes_right = right < from.last() && right->x <= place.x + reach_;
    if (!goes_left && !goes_right) return;
    if (goes_left) look(left--);
    if (goes_right) look(right++);
  }
}

}  // namespace lamina::slicer
