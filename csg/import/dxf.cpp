#include "csg/import/dxf.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "csg/degrees.h"
#include "csg/import/detail/dxf_lines.h"
#include "csg/import/detail/text_lines.h"
#include "csg/limits.h"

namespace lamina::csg {
namespace {

// A few hundred bytes may ask for any number of lines, by blocks within blocks
// and by arcs of many turns. Drawings need far fewer than these.
constexpr std::size_t kMostLinesOfAByte = 20;

// One entity: its groups up to the next entity. What a group means depends on
// the entity; OpenSCAD keeps some of different meaning in one place, as here.
struct Entity {
  std::string kind;
  std::string layer;
  std::string text;  // group 1
  std::string name;  // group 2: of a section or a block
  std::array<Vec2, 7> points = {};
  std::vector<double> x;  // groups 10 and 11
  std::vector<double> y;
  double radius = 0;  // or the ratio of an ellipse's axes
  double angle_deg = 0;
  double end_angle_deg = 0;
  double group_41 = 0;  // begin of an ellipse [rad], or factor in x
  double group_42 = 0;
  int flags = 0;
  int bulges = 0;  // groups 42 that are not 0
};

class DxfReader {
 public:
  DxfReader(std::string_view bytes, const DxfOptions& options)
      : lines_(bytes),
        options_(options),
        most_lines_(options.most_lines + kMostLinesOfAByte * bytes.size()) {}

  DxfDrawing read() {
    for (;;) {
      const auto code_text = lines_.next();
      if (!code_text) break;
      const auto code = to_number<int>(*code_text);
      if (!code) {
        if (lines_.is_done()) break;
        drawing_.warnings.push_back(
            fmt::format("Illegal ID '{}' in `{}'", *code_text, options_.path));
        break;
      }
      read_group(*code, lines_.next().value_or(""));
    }
    drawing_.paths = join_lines(drawn_, grid_);
    return std::move(drawing_);
  }

 private:
  // --- Groups ---------------------------------------------------------------

  void read_group(int code, std::string_view data) {
    if (code == 0) {
      if (!finish_entity()) {
        drawing_.warnings.push_back(fmt::format(
            "Not enough input values for {}. in '{}'", data, options_.path));
        return;  // OpenSCAD goes on with the same entity
      }
      entity_ = Entity();
      entity_.kind = data;
      if (data == "INSERT") entity_.group_41 = entity_.group_42 = 1;
    } else if (code == 1) {
      entity_.text = data;
    } else if (code == 2) {
      entity_.name = data;
    } else if (code == 8) {
      entity_.layer = data;
    } else if (!read_number(code, data)) {
      drawing_.warnings.push_back(
          fmt::format("Illegal value '{}'in `{}'", data, options_.path));
    }
  }

  // False where a group that counts holds no number.
  bool read_number(int code, std::string_view data) {
    if (code == 70) {
      const auto number = to_number<int>(data);
      if (number) entity_.flags = *number;
      return number.has_value();
    }
    const bool is_coordinate =
        (code >= 10 && code <= 16) || (code >= 20 && code <= 26);
    double* const other = number_of_group(code);
    if (!is_coordinate && other == nullptr) return true;
    const auto number = to_number<double>(data);
    if (!number || !std::isfinite(*number)) return false;
    if (code == 42 && *number != 0) ++entity_.bulges;
    if (is_coordinate) {
      keep_coordinate(code, *number);
    } else {
      const bool is_length = code == 40 && !is_in_blocks_;
      *other = is_length ? *number * options_.scale : *number;
    }
    return true;
  }

  // Blocks keep their own coordinates until they are inserted.
  void keep_coordinate(int code, double number) {
    const int axis = code < 20 ? 0 : 1;
    const int which = code % 10;
    const double moved =
        is_in_blocks_ ? number
                      : (number - options_.origin[axis]) * options_.scale;
    // Groups 11, 12 and 16 of a dimension are offsets: they do not move.
    const bool is_offset = which == 1 || which == 2 || which == 6;
    entity_.points[static_cast<std::size_t>(which)][axis] =
        is_offset && !is_in_blocks_ ? number * options_.scale : moved;
    if (which <= 1) (axis == 0 ? entity_.x : entity_.y).push_back(moved);
  }

  // Where the number of the group is kept; null for groups that do not count.
  double* number_of_group(int code) {
    return code == 40   ? &entity_.radius
           : code == 41 ? &entity_.group_41
           : code == 42 ? &entity_.group_42
           : code == 50 ? &entity_.angle_deg
           : code == 51 ? &entity_.end_angle_deg
                        : nullptr;
  }

  // --- Entities -------------------------------------------------------------

  bool is_asked_for() const {
    return options_.layer.empty() || options_.layer == entity_.layer;
  }

  // These return false where the entity lacks coordinates; what it drew before
  // stays, as in OpenSCAD.

  bool finish_entity() {
    const std::string& kind = entity_.kind;
    if (kind == "LINE") return add_line(point(0), point(1));
    if (kind == "LWPOLYLINE") return add_polyline();
    if (kind == "CIRCLE") return add_arc(0, 360);
    if (kind == "ARC") return add_arc(entity_.angle_deg, entity_.end_angle_deg);
    if (kind == "ELLIPSE") return add_ellipse();
    if (kind == "INSERT") return insert_block();
    if (kind == "SECTION") {
      is_in_entities_ = entity_.name == "ENTITIES";
      is_in_blocks_ = entity_.name == "BLOCKS";
    } else if (kind == "DIMENSION" && is_asked_for()) {
      drawing_.dimensions.push_back(
          {entity_.flags, entity_.points, entity_.angle_deg, entity_.text});
    } else if (kind == "BLOCK") {
      block_ = entity_.name;
    } else if (kind == "ENDBLK") {
      block_.clear();
    } else if (kind != "ENDSEC" &&
               (is_in_blocks_ || (is_in_entities_ && is_asked_for()))) {
      ++drawing_.unknown_entities[kind];
    }
    return true;
  }

  std::optional<Vec2> point(std::size_t i) const {
    if (i >= entity_.x.size() || i >= entity_.y.size()) return std::nullopt;
    return Vec2(entity_.x[i], entity_.y[i]);
  }

  bool add_line(std::optional<Vec2> from, std::optional<Vec2> to) {
    if (!from || !to) return false;
    if (!is_drawn() && !is_kept()) return true;
    require_room_for(1);
    ++line_count_;
    const DxfLine line = {snap(*from), snap(*to)};
    (is_drawn() ? drawn_ : blocks_[block_]).push_back(line);
    return true;
  }

  bool is_drawn() const { return is_in_entities_ && is_asked_for(); }

  bool is_kept() const { return is_in_blocks_ && !block_.empty(); }

  void require_room_for(std::size_t count) const {
    if (count <= most_lines_ - line_count_) return;
    throw FormatError(fmt::format("DXF line {}, more than {} lines to draw",
                                  lines_.number(), most_lines_));
  }

  // Draws lines between at(0) … at(n).
  template <typename At>
  bool add_curve(int n, const At& at) {
    if (!is_drawn() && !is_kept()) return true;
    require_room_for(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) add_line(at(i), at(i + 1));
    return true;
  }

  std::uint32_t snap(Vec2 point) {
    if (plane::is_too_far(point.x) || plane::is_too_far(point.y)) {
      throw FormatError(fmt::format("DXF line {}, a coordinate beyond {} mm",
                                    lines_.number(),
                                    plane::kGreatestCoordinate));
    }
    return grid_.snap(point);
  }

  bool add_polyline() {
    if (is_in_blocks_ || is_asked_for()) {
      drawing_.straightened_arcs += entity_.bulges;
    }
    const std::size_t count = std::max(entity_.x.size(), entity_.y.size());
    for (std::size_t i = 1; i < count; ++i) {
      if (!add_line(point(i - 1), point(i))) return false;
    }
    const bool is_closed = (entity_.flags & 1) != 0;
    return !is_closed || add_line(point(count - 1), point(0));
  }

  // Fragments of the part of a circle.
  int fragments(double radius, double share) const {
    const double count = std::ceil(options_.fragments(radius) * share);
    // One too many is enough, and an int.
    constexpr double kMost = std::numeric_limits<int>::max();
    return static_cast<int>(
        std::min({count, static_cast<double>(most_lines_) + 1, kMost}));
  }

  bool add_arc(double begin_deg, double end_deg) {
    const auto center = point(0);
    if (!center) return false;
    const double r = entity_.radius;
    end_deg = turn_past(begin_deg, end_deg, 360.0);
    const double sweep = end_deg - begin_deg;
    const int n = fragments(r, sweep / 360);
    const auto at = [&](int i) {
      const double angle = begin_deg + sweep * i / n;
      return *center + Vec2(cos_deg(angle) * r, sin_deg(angle) * r);
    };
    return add_curve(n, at);
  }

  // `end` and as many whole turns as take it to `begin` or past it. (Angles of
  // 1e30 turns are less exact than a turn.)
  static double turn_past(double begin, double end, double turn) {
    if (end >= begin) return end;
    return std::max(begin, end + turn * std::ceil((begin - end) / turn));
  }

  bool add_ellipse() {
    constexpr double kTurn = 2 * std::numbers::pi;
    const auto center = point(0);
    const auto axis = point(1);
    if (!center || !axis) return false;
    const double major = std::sqrt(axis->x * axis->x + axis->y * axis->y);
    if (!(major > 0)) return true;
    const double minor = major * entity_.radius;
    double tilt = std::acos(std::clamp(axis->x / major, -1.0, 1.0));
    if (axis->y < 0) tilt = kTurn - tilt;
    const double begin = entity_.group_41;
    const double sweep = turn_past(begin, entity_.group_42, kTurn) - begin;
    const int n = fragments(major, sweep / kTurn);
    const auto at = [&](int i) {
      const double angle = begin + sweep * i / n;
      const Vec2 p(std::cos(angle) * major, std::sin(angle) * minor);
      return *center + Vec2(std::cos(tilt) * p.x - std::sin(tilt) * p.y,
                            std::sin(tilt) * p.x + std::cos(tilt) * p.y);
    };
    return add_curve(n, at);
  }

  bool insert_block() {
    const auto block = blocks_.find(entity_.name);
    if (block == blocks_.end()) return true;
    const auto place = point(0);
    if (!place) return false;
    if (!is_drawn() && !is_kept()) return true;
    const double cos = cos_deg(entity_.angle_deg);
    const double sin = sin_deg(entity_.angle_deg);
    const auto moved = [&](std::uint32_t i) {
      const Vec2 p = grid_[i] * Vec2(entity_.group_41, entity_.group_42);
      return *place + Vec2(cos * p.x - sin * p.y, sin * p.x + cos * p.y) *
                          options_.scale;
    };
    // A block that is inserted into itself grows meanwhile.
    const std::vector<DxfLine>& lines = block->second;
    const std::size_t count = lines.size();
    require_room_for(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto [from, to] = lines[i];
      add_line(moved(from), moved(to));
    }
    return true;
  }

  TextLines lines_;
  const DxfOptions& options_;
  std::size_t most_lines_;
  DxfDrawing drawing_;
  DxfGrid grid_;
  std::vector<DxfLine> drawn_;
  std::unordered_map<std::string, std::vector<DxfLine>> blocks_;
  std::size_t line_count_ = 0;
  std::string block_;  // being defined; empty: none
  bool is_in_entities_ = false;
  bool is_in_blocks_ = false;
  Entity entity_;
};

}  // namespace

DxfDrawing parse_dxf(std::string_view bytes, const DxfOptions& options) {
  return DxfReader(bytes, options).read();
}

std::vector<std::string> unknown_entity_warnings(
    const DxfDrawing& drawing, const std::string& layer,
    const std::string& shown_path) {
  std::vector<std::string> warnings;
  for (const auto& [kind, count] : drawing.unknown_entities) {
    warnings.push_back(
        layer.empty()
            ? fmt::format("Unsupported DXF Entity '{}' ({:x}) in {}.", kind,
                          count, shown_path)
            : fmt::format("Unsupported DXF Entity '{}' ({:x}) in layer '{}' "
                          "of {}",
                          kind, count, layer,
                          shown_path.substr(1, shown_path.size() - 2)));
  }
  return warnings;
}

}  // namespace lamina::csg
