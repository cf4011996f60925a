#include "slicer/casting/casting_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "slicer/thickness/ball_finder.h"

namespace lamina::slicer {
namespace {

// Heights, angles above the horizontal, turns about the sprue, and directions
// around the trunk that are tried, in this order.
constexpr double kHeightStep = 2;                  // [mm]
constexpr std::array kTilts = {45.0, 60.0, 75.0};  // [degrees]
constexpr int kTurns = 8;
constexpr int kSides = 24;

// Stems are no longer than needed, in such steps, and than this [mm].
constexpr double kStemStep = 0.5;
constexpr double kLongestStem = 30;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Two unit vectors that stand on the third, and on each other.
std::array<Vec3, 2> across(Vec3 axis) {
  const Vec3 other = std::abs(axis.z) < 0.9 ? Vec3(0, 0, 1) : Vec3(1, 0, 0);
  const Vec3 u = glm::normalize(glm::cross(other, axis));
  return {u, glm::cross(axis, u)};
}

// The turn that takes `from` to `to` and then turns about it [radians].
glm::dmat3 turn_to(Vec3 from, Vec3 to, double angle) {
  const auto [u, v] = across(from);
  const auto [s, t] = across(to);
  const Vec3 x = std::cos(angle) * s + std::sin(angle) * t;
  const glm::dmat3 source(u, v, from);
  return glm::dmat3(x, glm::cross(to, x), to) * glm::transpose(source);
}

// Points in cells, so that most of them need not be looked at one by one.
class PointCells {
 public:
  explicit PointCells(std::vector<Vec3> points) : points_(std::move(points)) {
    const auto cell_of = [](Vec3 point) {
      const Vec3 cell = glm::floor(point / kCell);
      return std::tuple(cell.x, cell.y, cell.z);
    };
    std::ranges::sort(points_, {}, [&](Vec3 point) {
      return std::tuple(cell_of(point), point.x, point.y, point.z);
    });
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (i > 0 && cell_of(points_[i]) == cell_of(points_[i - 1])) continue;
      cells_.push_back({.begin = i});
    }
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      Cell& cell = cells_[c];
      cell.end = c + 1 < cells_.size() ? cells_[c + 1].begin : points_.size();
      Box3 box;
      for (std::size_t i = cell.begin; i < cell.end; ++i) box.add(points_[i]);
      cell.middle = box.center();
      cell.radius = glm::length(box.size()) / 2;
    }
  }

  const std::vector<Vec3>& points() const { return points_; }

  // Whether there is a point with is_bad(place, 0), as they stand at `at`:
  // is_bad(middle, radius) is true for a ball if it is for any place in it.
  template <typename IsBad>
  bool has(const Affine& at, const IsBad& is_bad) const {
    return std::ranges::any_of(cells_, [&](const Cell& cell) {
      if (!is_bad(Vec3(at * Vec4(cell.middle, 1)), cell.radius)) return false;
      return std::any_of(
          points_.begin() + static_cast<std::ptrdiff_t>(cell.begin),
          points_.begin() + static_cast<std::ptrdiff_t>(cell.end),
          [&](Vec3 point) { return is_bad(Vec3(at * Vec4(point, 1)), 0.0); });
    });
  }

 private:
  static constexpr double kCell = 2.5;  // [mm]
  struct Cell {
    Vec3 middle = Vec3(0);
    double radius = 0;
    std::size_t begin = 0;
    std::size_t end = 0;
  };
  std::vector<Vec3> points_;
  std::vector<Cell> cells_;
};

// A piece, and the piece with its sprue, of which one can ask for the nearest
// point to a place.
struct Shape {
  explicit Shape(const TreePiece& its_piece)
      : piece(its_piece.points), whole(all_points(its_piece)) {
    Box3 box;
    for (const Vec3 point : whole.points()) {
      surface.push_back({.place = point});
      box.add(point);
    }
    middle = box.center();
    for (const Vec3 point : whole.points()) {
      radius = std::max(radius, glm::distance(point, middle));
    }
    finder = std::make_unique<BallFinder>(surface);
  }

  static std::vector<Vec3> all_points(const TreePiece& piece) {
    std::vector<Vec3> points = piece.points;
    points.insert(points.end(), piece.sprue.begin(), piece.sprue.end());
    return points;
  }

  PointCells piece;
  PointCells whole;
  std::vector<SurfacePoint> surface;
  std::unique_ptr<BallFinder> finder;
  Vec3 middle = Vec3(0);
  double radius = 0;
};

// A placed piece, for others to keep away from. It is asked in its own frame.
struct Standing {
  const TreePiece* piece = nullptr;
  const Shape* shape = nullptr;
  Affine tree_from_piece{1.0};
  glm::dmat3 turn_back{1.0};
  Vec3 middle = Vec3(0);
  std::array<Vec3, 2> stem;

  Vec3 in_piece(Vec3 place) const {
    return turn_back * (place - tree_from_piece[3]);
  }
};

// Of a place from a segment.
double distance_to(const std::array<Vec3, 2>& segment, Vec3 place) {
  const Vec3 along = segment[1] - segment[0];
  const double share =
      glm::dot(place - segment[0], along) / glm::dot(along, along);
  return glm::distance(place, segment[0] + std::clamp(share, 0.0, 1.0) * along);
}

class Planter {
 public:
  Planter(std::span<const TreePiece> pieces, const TreeSizes& sizes)
      : pieces_(pieces), sizes_(sizes) {
    for (const TreePiece& piece : pieces) shapes_.emplace_back(piece);
    reach_ = sizes.flask_diameter / 2 - sizes.wall;
    ceiling_ = sizes.flask_height - sizes.top;
  }

  CastingTree plant(std::vector<std::size_t>& wanted) {
    std::stable_sort(wanted.begin(), wanted.end(),
                     [&](std::size_t a, std::size_t b) {
                       return pieces_[a].volume > pieces_[b].volume;
                     });
    std::vector<std::size_t> left;
    std::vector<bool> has_failed(pieces_.size(), false);
    for (const std::size_t piece : wanted) {
      if (has_failed[piece] || !place(piece)) {
        has_failed[piece] = true;  // an equal one does not fit, either
        left.push_back(piece);
      }
    }
    wanted = std::move(left);
    for (const TreePlacement& placement : tree_.placements) {
      tree_.trunk_height =
          std::max(tree_.trunk_height, placement.stem.z + sizes_.trunk / 2);
    }
    return std::move(tree_);
  }

 private:
  bool place(std::size_t piece) {
    for (double height = sizes_.foot / 2; height < ceiling_;
         height += kHeightStep) {
      for (const double tilt : kTilts) {
        for (int turn = 0; turn < kTurns; ++turn) {
          if (place_around(piece, height, radians(tilt), turn)) return true;
        }
      }
    }
    return false;
  }

  // On one of the sides of the trunk, if there is a stem that is long enough
  // and not too long.
  bool place_around(std::size_t piece, double height, double tilt, int turn) {
    for (double stem = sizes_.trunk / 4; stem < kLongestStem;
         stem += kStemStep) {
      const Fit fit = fit_of(placement(piece, height, tilt, turn, 0, stem));
      if (fit == Fit::kTooFar) return false;
      if (fit == Fit::kTooNear) continue;
      for (int side = 0; side < kSides; ++side) {
        if (stand(placement(piece, height, tilt, turn, side, stem)))
          return true;
      }
      return false;
    }
    return false;
  }

  TreePlacement placement(std::size_t number, double height, double tilt,
                          int turn, int side, double stem) const {
    const TreePiece& piece = pieces_[number];
    const double azimuth = radians(360.0 * side / kSides);
    const glm::dmat3 around(Vec3(std::cos(azimuth), std::sin(azimuth), 0),
                            Vec3(-std::sin(azimuth), std::cos(azimuth), 0),
                            Vec3(0, 0, 1));
    const Vec3 along(std::cos(tilt), 0, std::sin(tilt));
    const glm::dmat3 rotation =
        around *
        turn_to(-piece.direction, along, radians(360.0 * turn / kTurns));
    const Vec3 begin(0, 0, height);
    const Vec3 root = begin + stem * (around * along);
    return {
        number,
        {rotation[0], rotation[1], rotation[2], root - rotation * piece.root},
        begin};
  }

  enum class Fit { kTooNear, kWell, kTooFar };

  // Of the trunk and the flask, on whatever side.
  Fit fit_of(const TreePlacement& placement) const {
    const Affine& at = placement.tree_from_piece;
    const PointCells& points = shapes_[placement.piece].piece;
    const double cover = pieces_[placement.piece].cover;
    if (points.has(at, [&](Vec3 place, double radius) {
          const double far = radius + cover;
          return std::hypot(place.x, place.y) + far > reach_ ||
                 place.z + far > ceiling_;
        })) {
      return Fit::kTooFar;
    }
    const bool is_near = points.has(at, [&](Vec3 place, double radius) {
      const double far = radius + cover;
      return std::hypot(place.x, place.y) - far <
                 sizes_.trunk / 2 + sizes_.gap ||
             place.z - far < sizes_.foot;
    });
    return is_near ? Fit::kTooNear : Fit::kWell;
  }

  // Adds a piece if it is apart from the others.
  bool stand(const TreePlacement& placement) {
    const TreePiece& piece = pieces_[placement.piece];
    const Shape& shape = shapes_[placement.piece];
    const Affine& at = placement.tree_from_piece;
    const Standing standing = {&piece,
                               &shape,
                               at,
                               glm::transpose(glm::dmat3(at[0], at[1], at[2])),
                               at * Vec4(shape.middle, 1),
                               {placement.stem, at * Vec4(piece.root, 1)}};
    for (const Standing& other : standing_) {
      if (!are_apart(standing, other)) return false;
    }
    standing_.push_back(standing);
    tree_.placements.push_back(placement);
    return true;
  }

  bool are_apart(const Standing& one, const Standing& other) const {
    if (is_near_stem(one, other) || is_near_stem(other, one)) return false;
    const double wanted = sizes_.gap + one.piece->cover + other.piece->cover;
    if (glm::distance(one.middle, other.middle) >=
        one.shape->radius + other.shape->radius + wanted) {
      return true;
    }
    return !one.shape->whole.has(
        one.tree_from_piece, [&](Vec3 place, double radius) {
          return !is_at_trunk(place, radius) &&
                 other.shape->finder->nearest(other.in_piece(place),
                                              wanted + radius);
        });
  }

  // Whether a piece comes near the stem of another.
  bool is_near_stem(const Standing& one, const Standing& other) const {
    const double wanted =
        sizes_.gap + one.piece->cover + other.piece->root_diameter / 2;
    if (distance_to(other.stem, one.middle) >= one.shape->radius + wanted) {
      return false;
    }
    return one.shape->whole.has(
        one.tree_from_piece, [&](Vec3 place, double radius) {
          return !is_at_trunk(place, radius) &&
                 distance_to(other.stem, place) < wanted + radius;
        });
  }

  // Where sprues and stems meet: all of a ball.
  bool is_at_trunk(Vec3 place, double radius) const {
    return std::hypot(place.x, place.y) + radius <=
           sizes_.trunk / 2 + sizes_.gap;
  }

  std::span<const TreePiece> pieces_;
  const TreeSizes& sizes_;
  std::vector<Shape> shapes_;  // of the pieces
  double reach_ = 0;           // of pieces from the trunk's axis [mm]
  double ceiling_ = 0;         // of pieces [mm]
  std::vector<Standing> standing_;
  CastingTree tree_;
};

}  // namespace

CastingTree plant_tree(std::span<const TreePiece> pieces,
                       std::vector<std::size_t>& wanted,
                       const TreeSizes& sizes) {
  return Planter(pieces, sizes).plant(wanted);
}

}  // namespace lamina::slicer
