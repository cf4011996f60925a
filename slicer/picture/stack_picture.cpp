#include "slicer/picture/stack_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "slicer/picture/detail/body_places.h"
#include "slicer/picture/detail/layer_distance.h"
#include "slicer/picture/detail/stack_points.h"

namespace lamina::slicer {
namespace {

constexpr unsigned kOversampling = 2;  // in x and in y

// Slopes are taken over at least this share of the part's size: finer ones
// would show the rounding of contours.
constexpr double kSlopeLength = 0.0018;
// Tops that are level for this many such lengths are level.
constexpr double kSlopeReach = 20;

// Share of the light that is mirrored by supports, which are cured resin, and
// by what has a color of its own.
constexpr double kPlainShine = 0.25;

// How far walls shade each other: shares of the part's size and of the
// picture's.
constexpr double kShadeReach = 0.045;
constexpr double kMostShadePixels = 0.08;

// Directions of surfaces, from the depths of places in their layers.
class Normals {
 public:
  Normals(const std::vector<Layer>& layers, const std::vector<Plate>& plates,
          double size)
      : plates_(plates) {
    const double thickness =
        std::max((plates.back().top - plates.front().bottom) /
                     static_cast<double>(plates.size()),
                 1e-9);
    const double length = std::max(thickness, kSlopeLength * size);
    half_step_ = static_cast<int>(std::min(length / thickness / 2, 50.0));
    reach_ = kSlopeReach * length;
    depths_.resize(layers.size());
    for_each_index(layers.size(), [&](std::size_t i) {
      depths_[i] = LayerDistance(layers[i].contours, reach_);
    });
  }

  // Returns the unit normal, out of the solid, at a place on a plate.
  Vec3 at(int layer, Vec3 place) const {
    const Plate& plate = plates_[static_cast<std::size_t>(layer)];
    const double t = std::clamp(
        (place.z - plate.bottom) / std::max(plate.top - plate.bottom, 1e-12),
        0.0, 1.0);
    const Vec2 xy(place);
    // How depth changes upwards, around the place's height.
    const SectionDepth above = mix(level(layer + half_step_, xy),
                                   level(layer + half_step_ + 1, xy), t);
    const SectionDepth below = mix(level(layer - half_step_ - 1, xy),
                                   level(layer - half_step_, xy), t);
    const double up =
        (above.depth - below.depth) / std::max(above.z - below.z, 1e-12);
    // How it changes along the layer: between the sections above and below.
    const int lower = t < 0.5 ? layer - 1 : layer;
    const Vec2 inward =
        mix(level(lower, xy), level(lower + 1, xy), t < 0.5 ? t + 0.5 : t - 0.5)
            .inward;
    const Vec3 outward(-inward.x, -inward.y, -up);
    const double slope = glm::length(outward);
    return slope > 0 ? outward / slope : Vec3(0, 0, 1);
  }

 private:
  struct SectionDepth {
    double z;
    double depth;
    Vec2 inward;
  };

  // Returns the depth in a section; those beyond the stack are empty.
  SectionDepth level(int index, Vec2 place) const {
    const int last = static_cast<int>(plates_.size()) - 1;
    const int inside = std::clamp(index, 0, last);
    const Plate& plate = plates_[static_cast<std::size_t>(inside)];
    if (index != inside) {
      return {plate.section_z + (index - inside) * (plate.top - plate.bottom),
              -reach_, Vec2(0)};
    }
    const auto [depth, inward] =
        depths_[static_cast<std::size_t>(index)].at(place);
    return {plate.section_z, depth, inward};
  }

  static SectionDepth mix(const SectionDepth& a, const SectionDepth& b,
                          double share) {
    return {glm::mix(a.z, b.z, share), glm::mix(a.depth, b.depth, share),
            glm::mix(a.inward, b.inward, share)};
  }

  const std::vector<Plate>& plates_;
  int half_step_ = 0;
  double reach_ = 0;
  std::vector<LayerDistance> depths_;
};

double smooth_step(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

constexpr Rgb rgb(unsigned hex) {
  return {static_cast<float>(hex >> 16 & 255) / 255,
          static_cast<float>(hex >> 8 & 255) / 255,
          static_cast<float>(hex & 255) / 255};
}

double to_linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

double to_srgb(double linear) {
  linear = std::clamp(linear, 0.0, 1.0);
  return linear <= 0.0031308 ? 12.92 * linear
                             : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// A studio that goes with the viewer, who looks down into it a little: a key
// light from the upper left, a weak one from the right, and a room mirrored in
// what shines, dark below and bright above, with square lamps: their edges,
// bent by the surface, are what looks like metal.
class Studio {
 public:
  // solid  the colour of what is lit
  // shine  the share of the light that it mirrors, 0 … 1
  Studio(const Rgb& solid, double shine)
      : solid_(to_linear(solid[0]), to_linear(solid[1]), to_linear(solid[2])),
        shine_(shine) {}

  // Returns the colour that the viewer sees, in linear light.
  //
  // normal  right, up, towards the viewer
  // open    share of the sky that is seen, 0 … 1
  Vec3 light(Vec3 normal, double open) const {
    const Vec3 in_room =
        normal.x * right_ + normal.y * up_ + normal.z * to_viewer_;
    const double sky = open * open;
    const double facing = std::max(0.0, glm::dot(in_room, to_viewer_));
    const Vec3 mirrored = 2 * facing * in_room - to_viewer_;
    const double diffuse = 0.75 * std::max(0.0, glm::dot(in_room, key_)) +
                           0.15 * std::max(0.0, glm::dot(in_room, fill_)) +
                           0.14 + 0.14 * in_room.z;
    // Metals mirror in their colour, and everything in white at a flat angle.
    const Vec3 tint =
        glm::mix(solid_, Vec3(1), 0.7 * std::pow(1 - facing, 5.0));
    const double shade = 0.3 + 0.7 * sky;
    const Vec3 light = solid_ * (diffuse * shade * sky * (1 - 0.7 * shine_)) +
                       tint * (room(mirrored) * sky * shine_);
    // What is too bright for its colour becomes white.
    const double excess = std::max({light.x, light.y, light.z}) - 0.9;
    return light + Vec3(0.7 * std::max(0.0, excess));
  }

 private:
  static constexpr double kElevation = 0.62;  // of the viewer [rad]

  // Returns the share of light from a rectangular lamp with soft edges.
  //
  // axis  towards its middle
  // size  half of its sides, at the distance 1
  static double lamp(Vec3 to, Vec3 axis, Vec2 size) {
    constexpr double kSoftness = 0.12;
    const Vec3 across = glm::normalize(glm::cross(Vec3(0, 0, 1), axis));
    const double away = std::max(glm::dot(to, axis), 0.001);
    const auto inside = [&](Vec3 side, double half) {
      return 1 - smooth_step(half - kSoftness, half + kSoftness,
                             std::abs(glm::dot(to, side)) / away);
    };
    return inside(across, size.x) * inside(glm::cross(axis, across), size.y);
  }

  // Returns the light from a direction: a bright ceiling over a dim table, a
  // large lamp and three narrow ones.
  double room(Vec3 to) const {
    return 0.06 + 0.34 * smooth_step(-0.08, 0.55, to.z) +
           0.16 * smooth_step(0.05, 1.0, -to.z) +
           1.05 * lamp(to, key_, Vec2(0.62, 0.45)) +
           0.7 * lamp(to, fill_, Vec2(0.16, 0.7)) +
           0.4 * lamp(to, side_, Vec2(0.22, 0.9)) +
           0.35 * smooth_step(0.35, 0.9, to.y) * smooth_step(-0.1, 0.3, to.z);
  }

  Vec3 solid_;
  double shine_;
  Vec3 right_ = Vec3(1, 0, 0);
  Vec3 up_ = Vec3(0, std::sin(kElevation), std::cos(kElevation));
  Vec3 to_viewer_ = Vec3(0, -std::cos(kElevation), std::sin(kElevation));
  Vec3 key_ = glm::normalize(Vec3(-0.62, -0.35, 0.75));
  Vec3 fill_ = glm::normalize(Vec3(0.85, -0.45, 0.25));
  Vec3 side_ = glm::normalize(Vec3(-0.9539, 0.2, 0.2236));
};

// The points seen, with the light on them.
class LitStack {
 public:
  LitStack(const std::vector<Layer>& layers, const std::vector<Plate>& plates,
           const Box3& box, const Camera& camera, const StackOptions& options)
      : width_(options.width * kOversampling),
        height_(options.height * kOversampling),
        origin_((box.low + box.high) / 2.0),
        size_(glm::length(box.high - box.low)),
        thickness_((box.high.z - box.low.z) /
                   static_cast<double>(layers.size())),
        view_from_world_(camera.view_from_world()),
        part_studio_(options.colors->solid, options.colors->shine),
        support_studio_(options.colors->supports, kPlainShine),
        paint_(options.paint),
        points_(find_stack_points(layers, plates, camera, origin_, width_,
                                  height_)),
        normals_(layers, plates, size_),
        bodies_(layers) {
    const double pixels_per_mm =
        height_ / (2 * camera.distance *
                   std::tan(camera.field_deg * std::numbers::pi / 360));
    reach_ = std::min(kShadeReach * size_ * pixels_per_mm,
                      kMostShadePixels * std::max(width_, height_));
    fading_ = 3 * reach_ / pixels_per_mm;
    choose_places();
  }

  // Returns the mean of the points in a pixel. The sky changes slowly: its
  // share is computed once.
  Rgb pixel(unsigned x, unsigned y, Rgb background) const {
    Rgb sum{};
    double open = -1;
    for (unsigned i = 0; i < kOversampling * kOversampling; ++i) {
      const int px = static_cast<int>(x * kOversampling + i % kOversampling);
      const int py = static_cast<int>(y * kOversampling + i / kOversampling);
      const ldni::TaggedPoint& point = at(px, py);
      Rgb color = background;
      if (point.tag >= 0) {
        const Vec3 place = place_of(point) + origin_;
        const Vec3 normal = normals_.at(static_cast<int>(point.tag), place);
        if (open < 0) open = openness(px, py, normal);
        const Vec3 light =
            studio_at(static_cast<std::size_t>(point.tag), place)
                .light(Vec3(view_from_world_ * Vec4(normal, 0)), open);
        for (int c = 0; c < 3; ++c) {
          color[static_cast<std::size_t>(c)] =
              static_cast<float>(to_srgb(light[c]));
        }
      }
      for (std::size_t c = 0; c < 3; ++c) sum[c] += color[c];
    }
    for (float& channel : sum) channel /= kOversampling * kOversampling;
    return sum;
  }

 private:
  static constexpr int kDirections = 16;
  static constexpr int kSteps = 5;

  static Vec3 place_of(const ldni::TaggedPoint& point) {
    return {point.x, point.y, point.z};
  }
  const ldni::TaggedPoint& at(int x, int y) const {
    return points_[static_cast<std::size_t>(y) * width_ +
                   static_cast<std::size_t>(x)];
  }

  Studio studio_at(std::size_t layer, Vec3 place) const {
    const std::optional<Rgb> painted = paint_ ? paint_(place) : std::nullopt;
    if (painted) return Studio(*painted, kPlainShine);
    if (bodies_.is_of_support(layer, Vec2(place))) return support_studio_;
    if (const auto color = bodies_.color_at(layer, Vec2(place))) {
      return Studio(rgb(static_cast<unsigned>(*color)), kPlainShine);
    }
    return part_studio_;
  }

  // Chooses where to look for what hides the sky: near places more often.
  void choose_places() {
    for (int i = 0; i < kDirections; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / kDirections;
      for (int step = 1; step <= kSteps; ++step) {
        const double distance = reach_ * step * step / (kSteps * kSteps);
        places_.push_back(
            {static_cast<int>(std::lround(distance * std::cos(angle))),
             static_cast<int>(std::lround(distance * std::sin(angle)))});
      }
    }
  }

  // Returns the share of the sky that is seen: in each direction, what is above
  // the horizon.
  double openness(int x, int y, Vec3 normal) const {
    const Vec3 place = place_of(at(x, y));
    double open = 0;
    for (int i = 0; i < kDirections; ++i) {
      double highest = 0;  // sine of the horizon's height
      for (int step = 0; step < kSteps; ++step) {
        const auto& [dx, dy] = places_[static_cast<std::size_t>(i) * kSteps +
                                       static_cast<std::size_t>(step)];
        const int qx = x + dx;
        const int qy = y + dy;
        if (qx < 0 || qy < 0 || qx >= static_cast<int>(width_) ||
            qy >= static_cast<int>(height_) || at(qx, qy).tag < 0) {
          continue;
        }
        const Vec3 way = place_of(at(qx, qy)) - place;
        // The steps between layers hide no sky.
        const double rise = glm::dot(way, normal) - thickness_;
        if (rise <= 0) continue;
        const double distance = glm::length(way);
        const double fading = std::max(0.0, 1 - distance / fading_);
        highest = std::max(highest, fading * rise / distance);
      }
      open += std::sqrt(1 - highest * highest);
    }
    return open / kDirections;
  }

  unsigned width_;  // oversampled
  unsigned height_;
  Vec3 origin_;
  double size_;
  double thickness_;
  Mat4 view_from_world_;
  Studio part_studio_;
  Studio support_studio_;
  const std::function<std::optional<Rgb>(Vec3 place)>& paint_;
  std::vector<ldni::TaggedPoint> points_;
  Normals normals_;
  BodyPlaces bodies_;
  double reach_ = 0;   // of shade [pixels]
  double fading_ = 1;  // the same [mm]
  std::vector<std::array<int, 2>> places_;
};

Rgb mix(Rgb a, Rgb b, float share) {
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = a[c] + share * (b[c] - a[c]);
  return color;
}

// A grey blue, which is neither a metal nor most other parts.
constexpr unsigned kSupports = 0x7f9bb8;

// A material before a soft light grey.
constexpr ColorScheme material(std::string_view name, unsigned solid,
                               double shine) {
  return {name,       rgb(0xf4f4f2), rgb(0xdbdde0),
          rgb(solid), shine,         rgb(kSupports)};
}

// Background and front faces of openscad's scheme of that name.
constexpr ColorScheme openscad(std::string_view name, unsigned background,
                               unsigned solid, unsigned supports = kSupports) {
  return {name, rgb(background), rgb(background), rgb(solid),
          0.25, rgb(supports)};
}

constexpr std::array kSchemes = {
    material("gold", 0xf6c86f, 1),
    material("rose", 0xeab59b, 1),
    material("silver", 0xe6e6e8, 1),
    material("platinum", 0xcfd1d6, 0.9),
    material("wax", 0x3f8f6f, 0.3),
    material("resin", 0xd9a066, 0.3),
    openscad("Cornfield", 0xffffe5, 0xf9d72c),
    openscad("Metallic", 0xaaaaff, 0xddddff),
    openscad("Sunset", 0xaa4444, 0xffaaaa),
    openscad("Starnight", 0x000000, 0xffffe0),
    openscad("BeforeDawn", 0x333333, 0xcccccc),
    openscad("Nature", 0xfafafa, 0x16a085),
    openscad("DeepOcean", 0x333333, 0xeeeeee),
    openscad("Solarized", 0xfdf6e3, 0xb58800),
    openscad("Tomorrow", 0xf8f8f8, 0x4271ae, 0xb9c6d3),
    openscad("Tomorrow Night", 0x1d1f21, 0x81a2be, 0x566474),
    openscad("Monotone", 0xffffe5, 0xf9d72c),
};

}  // namespace

Image draw_stack(const std::vector<Layer>& layers,
                 const StackOptions& options) {
  const std::vector<Plate> plates = plates_of(layers);
  const Box3 box = bounds_of(layers, plates);
  Camera camera = options.camera;
  if (options.shows_all) {
    if (options.centers) camera.center_on(box);
    camera.show_all(box);
  }
  const LitStack stack(layers, plates, box, camera, options);

  const ColorScheme& colors = *options.colors;
  Image image(options.width, options.height, colors.background_top);
  for_each_index(image.height, [&](std::size_t row) {
    const auto y = static_cast<unsigned>(row);
    const Rgb background =
        mix(colors.background_top, colors.background_bottom,
            static_cast<float>(y) / static_cast<float>(image.height));
    for (unsigned x = 0; x < image.width; ++x) {
      image.at(x, y) = stack.pixel(x, y, background);
    }
  });
  return image;
}

const ColorScheme* find_color_scheme(std::string_view name) {
  for (const ColorScheme& scheme : kSchemes) {
    if (scheme.name == name) return &scheme;
  }
  return nullptr;
}

std::vector<std::string> color_scheme_names() {
  std::vector<std::string> names;
  names.reserve(std::size(kSchemes));
  for (const ColorScheme& scheme : kSchemes) names.emplace_back(scheme.name);
  return names;
}

}  // namespace lamina::slicer
