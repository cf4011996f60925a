#include "csg/eval/dxf_measures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <utility>

namespace lamina::csg {

namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

// Points of the grid on which OpenSCAD joins the ends of lines.
constexpr double kGrid = 0x1p-10;  // mm
using Cell = std::pair<std::int64_t, std::int64_t>;

// One entity: its groups up to the next one.
struct Entity {
  std::string kind;
  std::string layer;
  std::string name;
  std::string text;  // group 2: the name of a section
  int flags = 0;
  double angle_deg = 0;
  std::array<Vec2, 7> points = {};
  std::vector<double> x;
  std::vector<double> y;
};

class Reader {
 public:
  Reader(std::string layer, Vec2 origin, double scale)
      : layer_(std::move(layer)), origin_(origin), scale_(scale) {}

  DxfMeasures read(std::istream& file) {
    std::string code;
    std::string data;
    while (std::getline(file, code) && std::getline(file, data)) {
      read_group(std::atoi(code.c_str()), trimmed(data));
    }
    keep_lone_lines();
    return std::move(measures_);
  }

 private:
  void read_group(int code, const std::string& data) {
    if (code == 0) {
      finish_entity();
      entity_ = Entity();
      entity_.kind = data;
      return;
    }
    const double number = std::atof(data.c_str());
    // Groups 11, 12 and 16 of a dimension are offsets: they do not move.
    const bool is_offset = code % 10 == 1 || code % 10 == 2 || code % 10 == 6;
    if (code >= 10 && code <= 16) {
      entity_.points[static_cast<std::size_t>(code - 10)].x =
          (is_offset ? number : number - origin_.x) * scale_;
      if (code <= 11) entity_.x.push_back((number - origin_.x) * scale_);
    } else if (code >= 20 && code <= 26) {
      entity_.points[static_cast<std::size_t>(code - 20)].y =
          (is_offset ? number : number - origin_.y) * scale_;
      if (code <= 21) entity_.y.push_back((number - origin_.y) * scale_);
    } else if (code == 1) {
      entity_.name = data;
    } else if (code == 2) {
      entity_.text = data;
    } else if (code == 8) {
      entity_.layer = data;
    } else if (code == 50) {
      entity_.angle_deg = number;
    } else if (code == 70) {
      entity_.flags = std::atoi(data.c_str());
    }
  }

  void finish_entity() {
    static const std::set<std::string> kKnown = {
        "CIRCLE", "ARC", "ELLIPSE", "INSERT", "BLOCK", "ENDBLK", "ENDSEC", ""};
    if (entity_.kind == "SECTION") {
      section_ = entity_.text;
      return;
    }
    const bool is_asked_for = layer_.empty() || layer_ == entity_.layer;
    if (entity_.kind == "LINE") {
      if (is_asked_for) add_line(0, 1);
    } else if (entity_.kind == "LWPOLYLINE") {
      if (!is_asked_for) return;
      const std::size_t count = entity_.x.size();
      for (std::size_t i = 1; i < count; ++i) add_line(i - 1, i);
      if ((entity_.flags & 1) != 0 && count > 0) add_line(count - 1, 0);
    } else if (entity_.kind == "DIMENSION") {
      if (!is_asked_for) return;
      measures_.dimensions.push_back(
          {entity_.flags, entity_.points, entity_.angle_deg, entity_.name});
    } else if (!kKnown.contains(entity_.kind)) {
      if (section_ == "BLOCKS" || (section_ == "ENTITIES" && is_asked_for)) {
        ++measures_.unknown_entities[entity_.kind];
      }
    }
  }

  void add_line(std::size_t from, std::size_t to) {
    if (section_ != "ENTITIES") return;
    if (std::max(from, to) >= std::min(entity_.x.size(), entity_.y.size())) {
      return;
    }
    lines_.push_back({snapped({entity_.x[from], entity_.y[from]}),
                      snapped({entity_.x[to], entity_.y[to]})});
  }

  // Ends closer than the grid are one end: the first that came stands for it.
  Cell snapped(Vec2 point) {
    Cell cell = {static_cast<std::int64_t>(std::round(point.x / kGrid)),
                 static_cast<std::int64_t>(std::round(point.y / kGrid))};
    const auto [ix, iy] = cell;
    if (!ends_.contains(cell)) {
      std::int64_t nearest = 10;
      for (std::int64_t jx = ix - 1; jx <= ix + 1; ++jx) {
        for (std::int64_t jy = iy - 1; jy <= iy + 1; ++jy) {
          const std::int64_t distance = std::abs(ix - jx) + std::abs(iy - jy);
          if (ends_.contains({jx, jy}) && distance < nearest) {
            nearest = distance;
            cell = {jx, jy};
          }
        }
      }
    }
    ++ends_[cell];
    return cell;
  }

  void keep_lone_lines() {
    const auto point = [](const Cell& cell) {
      return Vec2(static_cast<double>(cell.first) * kGrid,
                  static_cast<double>(cell.second) * kGrid);
    };
    for (const auto& [from, to] : lines_) {
      if (ends_[from] == 1 && ends_[to] == 1) {
        measures_.lone_lines.push_back({point(from), point(to)});
      }
    }
  }

  std::string layer_;
  Vec2 origin_;
  double scale_;
  std::string section_;
  Entity entity_;
  std::vector<std::pair<Cell, Cell>> lines_;
  std::map<Cell, int> ends_;  // how many lines end there
  DxfMeasures measures_;
};

}  // namespace

DxfMeasures read_dxf_measures(const std::string& path, const std::string& layer,
                              Vec2 origin, double scale) {
  std::ifstream file(path);
  return Reader(layer, origin, scale).read(file);
}

}  // namespace lamina::csg
