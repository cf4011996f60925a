#include "slicer/supports/support_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "base/text.h"
#include "plane/loop_area.h"
#include "plane/predicates.h"
#include "plane/region/boolean.h"
#include "slicer/contour/layer_measures.h"

namespace lamina::slicer {
namespace {

// Pieces of neighbouring layers belong to one contact if they are no
// farther from each other [mm].
constexpr double kSameContact = 0.05;

// Pieces of less than this come from rounding and simplification [mm²].
constexpr double kLeastPiece = 1e-4;

// So much around a support is cut out of the part [mm].
constexpr double kAround = 0.01;

bool touch(Box2 a, const Box2& b, double margin = 0) {
  a.intersect({b.low - margin, b.high + margin});
  return !a.is_empty();
}

// What of a loop lies on one side of a line, after Sutherland and Hodgman 1974:
// parts that the line divides stay connected along it.
void cut(plane::Contour& loop, int axis, double sign, double limit) {
  plane::Contour kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec2 from = loop[i];
    const Vec2 to = loop[(i + 1) % loop.size()];
    const double a = sign * (from[axis] - limit);
    const double b = sign * (to[axis] - limit);
    if (a <= 0) kept.push_back(from);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) {
      Vec2 crossing = from + (to - from) * (a / (a - b));
      crossing[axis] = limit;
      kept.push_back(crossing);
    }
  }
  loop = std::move(kept);
}

// Loops that are asked again and again for what of them is in a box.
class BoxedLoops {
 public:
  explicit BoxedLoops(const plane::Contours& contours) : contours_(contours) {
    for (std::size_t i = 0; i < contours.loop_count(); ++i) {
      boxes_.push_back(box_of(contours.loop(i)));
    }
  }

  // What is in the box, as contours with winding numbers.
  std::vector<plane::Contour> cut_to(const Box2& box) const {
    std::vector<plane::Contour> all;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (!touch(boxes_[i], box)) continue;
      const auto loop = contours_.loop(i);
      // Most boxes are wholly beside a loop, or in it.
      const bool is_crossed = passes(loop, box);
      if (!is_crossed && winding_number(loop, box.center()) == 0) continue;
      plane::Contour rest(loop.begin(), loop.end());
      for (const int axis : {0, 1}) {
        cut(rest, axis, 1, box.high[axis]);
        cut(rest, axis, -1, box.low[axis]);
      }
      if (rest.size() > 2) all.push_back(std::move(rest));
    }
    return all;
  }

 private:
  // Whether the box of an edge touches the box.
  static bool passes(std::span<const Vec2> loop, const Box2& box) {
    Vec2 from = loop.back();
    for (const Vec2& to : loop) {
      const bool is_beside = (from.x < box.low.x && to.x < box.low.x) ||
                             (from.x > box.high.x && to.x > box.high.x) ||
                             (from.y < box.low.y && to.y < box.low.y) ||
                             (from.y > box.high.y && to.y > box.high.y);
      if (!is_beside) return true;
      from = to;
    }
    return false;
  }

  const plane::Contours& contours_;
  std::vector<Box2> boxes_;
};

// The solid within an outer loop.
plane::Region region_of(const plane::Contours& contours, std::size_t outer) {
  const auto loop = contours.loop(outer);
  const Box2 box = box_of(loop);
  plane::Region region;
  region.contours.emplace_back(loop.begin(), loop.end());
  for (std::size_t i = 0; i < contours.loop_count(); ++i) {
    const auto hole = contours.loop(i);
    if (signed_area(hole) >= 0 || !box.holds(box_of(hole))) continue;
    region.contours.emplace_back(hole.begin(), hole.end());
  }
  return region;
}

}  // namespace

double SupportMeasures::contact_area() const {
  double area = 0;
  for (const SupportContact& contact : contacts) area += contact.area;
  return area;
}

std::string size_text(const SupportMeasures& supports) {
  return fmt::format(
      "{:.4g} mm³ of supports touch the part at {}, {:.4g} mm² in all",
      supports.volume, counted(supports.contacts.size(), "place"),
      supports.contact_area());
}

double part_volume(double printed,
                   const std::optional<SupportMeasures>& supports) {
  return printed - (supports ? supports->volume : 0);
}

void SupportMeter::take(const Layer& layer) {
  ++layers_;
  measures_.volume +=
      (measure(layer.contours).area - measure(layer.part).area) *
      (layer.top - layer.bottom);
  if (layers_ > 1) {
    add(find_pieces(layer, last_), layer, layers_, false);
    add(find_pieces(last_, layer), last_, layers_ - 1, true);
  }
  last_ = layer;
}

// What of the part in one layer is over, or below, supports of another layer,
// and not over its own part there.
std::vector<SupportMeter::Piece> SupportMeter::find_pieces(
    const Layer& part, const Layer& supports) {
  std::vector<Piece> pieces;
  if (part.part.is_empty() || part.part == supports.part) return pieces;
  const BoxedLoops all(part.part);
  const BoxedLoops beside(supports.part);
  for (std::size_t i = 0; i < supports.supports.loop_count(); ++i) {
    const auto loop = supports.supports.loop(i);
    if (signed_area(loop) <= 0) continue;
    const Box2 box = box_of(loop);
    const Box2 around = {box.low - kAround, box.high + kAround};
    const std::vector<plane::Contour> near = all.cut_to(around);
    if (near.empty()) continue;
    plane::Region touched = plane::clip(near, region_of(supports.supports, i));
    if (touched.is_empty()) continue;
    const std::vector<plane::Contour> own = beside.cut_to(around);
    if (!own.empty()) {
      const std::array<plane::Region, 2> both = {
          touched, plane::from_contours(own, plane::FillRule::kNonZero)};
      touched = plane::subtract(both);
    }
    const double area = plane::area(touched);
    if (area < kLeastPiece) continue;
    Piece& piece = pieces.emplace_back();
    piece.area = area;
    for (const plane::Contour& contour : touched.contours) {
      piece.box.add(contour);
    }
  }
  return pieces;
}

// part  the layer that they are in
void SupportMeter::add(const std::vector<Piece>& pieces, const Layer& part,
                       std::uint32_t number, bool is_from_above) {
  for (const Piece& piece : pieces) {
    const auto grown =
        std::ranges::find_if(growing_, [&](const Growing& growing) {
          return growing.contact.is_from_above == is_from_above &&
                 growing.last_layer + 1 >= number &&
                 touch(growing.box, piece.box, kSameContact);
        });
    if (grown == growing_.end()) {
      growing_.push_back({{.place = piece.box.center(),
                           .layer = number,
                           .section_z = part.section_z,
                           .area = piece.area,
                           .is_from_above = is_from_above},
                          piece.box,
                          number});
      continue;
    }
    grown->contact.area += piece.area;
    grown->box.add(piece.box);
    grown->last_layer = number;
    if (is_from_above) {
      grown->contact.layer = number;
      grown->contact.section_z = part.section_z;
    }
    grown->contact.place = grown->box.center();
  }
}

SupportMeasures SupportMeter::finish() {
  for (const Growing& grown : growing_) {
    measures_.contacts.push_back(grown.contact);
  }
  std::ranges::stable_sort(
      measures_.contacts, {}, [](const SupportContact& contact) {
        return std::tuple(contact.layer, contact.place.x, contact.place.y);
      });
  return std::move(measures_);
}

}  // namespace lamina::slicer
