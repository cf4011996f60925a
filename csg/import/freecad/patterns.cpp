// Patterns of PartDesign: features that repeat others at further places.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "csg/import/freecad/detail/reader.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

// From one place to the next: the whole is given, or, in newer files, the step.
double read_step(const Object& object, std::string_view whole, double parts) {
  constexpr int kByStep = 1;
  if (object.value("Offset") && object.choice("Mode") == kByStep) {
    return object.number("Offset");
  }
  return object.number(whole) / std::max(parts, 1.0);
}

}  // namespace

Reader::Made Reader::make_pattern(const Object& object, std::string& why) {
  const std::vector<std::string_view> originals = object.links("Originals");
  if (originals.empty() || object.flag("Suppressed")) {
    why = "it repeats no feature";
    return std::nullopt;
  }
  const auto base = make_operands({object.link("BaseFeature")}, why);
  if (!base) return std::nullopt;
  std::vector<const Object*> features;
  std::vector<Solid> tools;
  for (const std::string_view name : originals) {
    const Object* const original = document_.find(name);
    if (original == nullptr) {
      why = fmt::format("there is no object '{}'", name);
      return std::nullopt;
    }
    const Made tool = make_tool(*original, why);
    if (!tool) return std::nullopt;
    features.push_back(original);
    tools.push_back(*tool);
  }
  const auto places = places_of(object, why);
  if (!places) return std::nullopt;
  Solid result = base->front();
  for (std::size_t k = 0; k < tools.size(); ++k) {
    std::vector<Solid> operands = {result};
    for (std::size_t i = 1; i < places->size(); ++i) {
      operands.push_back(maker_.place((*places)[i], tools[k]));
    }
    result =
        adds(*features[k]) ? maker_.unite(operands) : maker_.subtract(operands);
  }
  return result;
}

int Reader::read_occurrences(const Object& object) {
  const double count = object.number("Occurrences");
  count_places(count);
  return std::max(static_cast<int>(count), 1);
}

void Reader::count_places(double count) {
  if (count > kMostOccurrences) {
    throw plane::LimitExceeded(
        fmt::format("Too many occurrences: {:.7g}, at most {:.7g} can be",
                    count, kMostOccurrences));
  }
  places_ += static_cast<std::size_t>(std::max(count, 1.0));
  if (places_ <= kMostPlaces) return;
  throw plane::LimitExceeded(fmt::format(
      "Too many places in all patterns: more than {}", kMostPlaces));
}

Reader::Places Reader::places_of(const Object& object, std::string& why) {
  if (object.is_a("PartDesign::LinearPattern")) return line_places(object, why);
  if (object.is_a("PartDesign::PolarPattern")) {
    return circle_places(object, why);
  }
  if (object.is_a("PartDesign::Mirrored")) return mirror_places(object, why);
  if (object.is_a("PartDesign::MultiTransform")) {
    return product_of_places(object, why);
  }
  why = fmt::format("'{}' is a {}", object.label(), object.type());
  return std::nullopt;
}

Reader::Places Reader::line_places(const Object& object, std::string& why) {
  const auto axis = axis_of(object.sub_link("Direction"), why);
  if (!axis) return std::nullopt;
  if (object.number("Occurrences2", 1) > 1) {
    why = "it has two directions";
    return std::nullopt;
  }
  const int count = read_occurrences(object);
  double step = read_step(object, "Length", count - 1);
  if (object.flag("Reversed")) step = -step;
  std::vector<Mat4> places;
  places.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    places.push_back(shift(i * step * glm::normalize(axis->way)));
  }
  return places;
}

Reader::Places Reader::circle_places(const Object& object, std::string& why) {
  const auto axis = axis_of(object.sub_link("Axis"), why);
  if (!axis) return std::nullopt;
  const int count = read_occurrences(object);
  // A full circle ends where it begins.
  const bool is_full = std::abs(object.number("Angle") - 360) < 1e-9;
  double step = read_step(object, "Angle", is_full ? count : count - 1);
  if (object.flag("Reversed")) step = -step;
  std::vector<Mat4> places;
  places.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    places.push_back(shift(axis->base) * turn(axis->way, i * step) *
                     shift(-axis->base));
  }
  return places;
}

Reader::Places Reader::mirror_places(const Object& object, std::string& why) {
  const auto plane = normal_of(object.sub_link("MirrorPlane"), why);
  if (!plane) return std::nullopt;
  return std::vector<Mat4>{Mat4(1), mirror(plane->base, plane->way)};
}

Reader::Places Reader::product_of_places(const Object& object,
                                         std::string& why) {
  std::vector<Mat4> places = {Mat4(1)};
  for (const std::string_view name : object.links("Transformations")) {
    const Object* const step = document_.find(name);
    if (step == nullptr || step->is_a("PartDesign::MultiTransform")) {
      why = fmt::format("'{}' is no transformation", name);
      return std::nullopt;
    }
    const Places more = places_of(*step, why);
    if (!more) return std::nullopt;
    if (more->size() == 1) continue;  // where it stands
    count_places(static_cast<double>(places.size()) *
                 static_cast<double>(more->size()));
    std::vector<Mat4> all;
    for (const Mat4& outer : *more) {
      for (const Mat4& inner : places) all.push_back(outer * inner);
    }
    places = std::move(all);
  }
  return places;
}

// --- Axes and planes --------------------------------------------------------

namespace {

// Which of a sketch's axes, or of its planes, the link names.
std::optional<Vec3> sketch_axis(const SubLink& link) {
  if (link.subs.empty() || link.subs.front() == "N_Axis") return Vec3(0, 0, 1);
  if (link.subs.front() == "H_Axis") return Vec3(1, 0, 0);
  if (link.subs.front() == "V_Axis") return Vec3(0, 1, 0);
  return std::nullopt;
}

}  // namespace

std::optional<Reader::Axis> Reader::axis_of(const SubLink& link,
                                            std::string& why) {
  const Object* const object = document_.find(link.object);
  std::optional<Vec3> way;
  if (object != nullptr) {
    if (object->type().starts_with("Sketcher::")) way = sketch_axis(link);
    if (object->is_a("App::Line")) way = Vec3(1, 0, 0);
    if (object->is_a("PartDesign::Line") || object->is_a("PartDesign::Plane") ||
        object->is_a("App::Plane")) {
      way = Vec3(0, 0, 1);
    }
  }
  if (!way) {
    why = "an edge gives its axis";
    return std::nullopt;
  }
  const Mat4 placement = object->placement();
  return Axis{Vec3(placement[3]), apply_to_way(placement, *way)};
}

std::optional<Reader::Axis> Reader::normal_of(const SubLink& link,
                                              std::string& why) {
  const Object* const object = document_.find(link.object);
  std::optional<Vec3> normal;
  if (object != nullptr) {
    if (object->type().starts_with("Sketcher::")) {
      normal = sketch_axis(link);
      // A mirror through one axis of the sketch looks along the other.
      if (normal && normal->z == 0) normal = Vec3(normal->y, normal->x, 0);
    }
    if (object->is_a("PartDesign::Plane") || object->is_a("App::Plane")) {
      normal = Vec3(0, 0, 1);
    }
  }
  if (!normal) {
    why = "a face gives its plane";
    return std::nullopt;
  }
  const Mat4 placement = object->placement();
  return Axis{Vec3(placement[3]), apply_to_way(placement, *normal)};
}

}  // namespace lamina::csg::freecad
