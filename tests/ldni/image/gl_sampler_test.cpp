// What the GL samplers promise against the exact one, and of OpenGL.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "csg/boundary/leaf_mesh.h"
#include "ldni/image/sampler.h"
#include "tests/ldni/gl/shared_raster.h"
#include "tests/support/design.h"
#include "tests/support/leaf_scenes.h"
#include "tests/support/random_scenes.h"

namespace lamina::ldni {
namespace {

using csg::Scene;

// Corners are drawn up to a step from where they are [pixels].
constexpr double kStep = 1.0 / 256;

// All leaves of a scene by one sampler.
LeafImages sample_all(Sampler& sampler, const Scene& scene, const RayGrid& rays,
                      const LayerGrid& layers) {
  LeafImages images;
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    const GridBox box = local_box(scene.instances[i].box, rays, layers);
    if (!box.is_empty()) sampler.sample({i, box}, images);
  }
  return images;
}

std::vector<Sample> sorted(std::span<const Sample> samples) {
  std::vector<Sample> result(samples.begin(), samples.end());
  std::sort(result.begin(), result.end(), [](const Sample& a, const Sample& b) {
    return a.depth != b.depth ? a.depth < b.depth
                              : a.is_entry() && !b.is_entry();
  });
  return result;
}

// A leaf's faces around one ray, in pixels from the middle of the ray's.
class FacesAround {
 public:
  FacesAround(const csg::Mesh& mesh, const Affine& world_from_leaf, double x,
              double z, double pitch, double thickness)
      : mesh_(mesh) {
    for (const Vec3& vertex : mesh.vertices) {
      const Vec3 world = world_from_leaf * Vec4(vertex, 1);
      corners_.emplace_back((world.x - x) / pitch, world.y,
                            (world.z - z) / thickness);
    }
  }

  // Does an edge pass within `distance` of the middle, in x and in z?
  bool has_edge_within(double distance) const {
    for (const auto& triangle : mesh_.triangles) {
      for (int i = 0; i < 3; ++i) {
        if (passes(corners_[triangle[i]], corners_[triangle[(i + 1) % 3]],
                   distance)) {
          return true;
        }
      }
    }
    return false;
  }

  // What the steepest of the faces within `distance` of the middle rises over
  // that distance, either way together.
  double greatest_rise(double distance) const {
    double result = 0;
    for (const auto& [a, b, c] : mesh_.triangles) {
      const Vec3 low =
          glm::min(glm::min(corners_[a], corners_[b]), corners_[c]);
      const Vec3 high =
          glm::max(glm::max(corners_[a], corners_[b]), corners_[c]);
      if (low.x > distance || high.x < -distance || low.z > distance ||
          high.z < -distance) {
        continue;
      }
      const Vec3 normal =
          glm::cross(corners_[b] - corners_[a], corners_[c] - corners_[a]);
      const double rise = distance * (std::abs(normal.x) + std::abs(normal.z)) /
                          std::abs(normal.y);
      result = std::max(result, std::min(rise, high.y - low.y));
    }
    return result;
  }

 private:
  // Does the line from `a` to `b` meet the square of that half width?
  static bool passes(const Vec3& a, const Vec3& b, double half) {
    double enter = 0;
    double leave = 1;
    for (const int axis : {0, 2}) {
      const double along = b[axis] - a[axis];
      if (along == 0) {
        if (std::abs(a[axis]) > half) return false;
        continue;
      }
      const double t0 = (-half - a[axis]) / along;
      const double t1 = (half - a[axis]) / along;
      enter = std::max(enter, std::min(t0, t1));
      leave = std::min(leave, std::max(t0, t1));
    }
    return enter <= leave;
  }

  const csg::Mesh& mesh_;
  std::vector<Vec3> corners_;
};

// Counts of a comparison.
struct Agreement {
  std::size_t pixels = 0;
  std::size_t other_counts = 0;  // another number of samples
};

// Checks every pixel of every image against the exact sampler's.
Agreement compare_with_exact(const Scene& scene, double pitch,
                             double thickness) {
  const RayGrid rays(scene.box.low.x, scene.box.high.x, pitch);
  const LayerGrid layers =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, thickness);
  const auto exact = make_scanline_sampler(scene, rays, layers);
  const auto drawn = make_gl_sampler(scene, rays, layers, shared_raster());
  const LeafImages expected = sample_all(*exact, scene, rays, layers);
  const LeafImages found = sample_all(*drawn, scene, rays, layers);
  EXPECT_EQ(drawn->repaired_pixels(), 0U);
  EXPECT_EQ(expected.ends.size(), found.ends.size());

  Agreement agreement;
  agreement.pixels = found.ends.size();
  for (std::size_t i = 0; i < found.images.size(); ++i) {
    const LeafImage& image = found.images[i];
    const csg::Instance& instance = scene.instances[image.instance];
    const csg::Mesh mesh = csg::explicit_mesh(scene.leaves[instance.leaf]);
    for (std::uint32_t layer = 0; layer < image.box.layer_count; ++layer) {
      for (std::uint32_t ray = 0; ray < image.box.ray_count; ++ray) {
        const auto a = sorted(found.ray(image, layer, ray));
        const auto b = sorted(expected.ray(expected.images[i], layer, ray));
        const bool has_same_count = a.size() == b.size();
        double distance = 0;
        for (std::size_t k = 0; has_same_count && k < a.size(); ++k) {
          distance = std::max(distance, std::abs(a[k].depth - b[k].depth));
        }
        if (has_same_count && distance <= 1e-9) continue;
        const FacesAround faces(mesh, instance.world_from_leaf,
                                rays.ray_x(image.box.ray_start + ray),
                                layers.section_z(image.box.layer_start + layer),
                                pitch, thickness);
        // Only an edge that near can make a difference.
        EXPECT_TRUE(faces.has_edge_within(kStep + 1e-9))
            << "instance " << image.instance << " layer " << layer << " ray "
            << ray << ": " << a.size() << " and " << b.size() << " samples, "
            << distance << " mm apart";
        if (has_same_count) {
          EXPECT_LE(distance, 2 * faces.greatest_rise(kStep) + 1e-9);
        } else {
          ++agreement.other_counts;
        }
      }
    }
  }
  return agreement;
}

TEST(GlSampler, AgreesWithTheExactOneInHardScenes) {
  Agreement sum;
  for (int style = 0; style < support::kSceneStyleCount; ++style) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Scene scene = support::random_scene(
          seed, static_cast<support::SceneStyle>(style), 20);
      const Agreement agreement = compare_with_exact(scene, 0.13, 0.11);
      sum.pixels += agreement.pixels;
      sum.other_counts += agreement.other_counts;
    }
  }
  EXPECT_GT(sum.pixels, 100000U);
  EXPECT_LT(sum.other_counts, sum.pixels / 1000);
}

TEST(GlSampler, AgreesWithTheExactOneInDesigns) {
  for (const char* const name : {"ring55.scad", "submarine74.scad"}) {
    const auto design = support::Design::from_file(
        std::filesystem::path(LAMINA_BENCH_SCENES) / name);
    const Agreement agreement = compare_with_exact(design.scene(), 0.1, 0.1);
    EXPECT_GT(agreement.pixels, 10000U) << name;
    EXPECT_LT(agreement.other_counts, agreement.pixels / 1000) << name;
  }
}

// One leaf in a scene of its own size.
Scene scene_of_mesh(csg::Mesh mesh, const Affine& placement) {
  Scene scene = support::scene_of(plane::BooleanOp::kUnion);
  scene.leaves.push_back(support::mesh_leaf(std::move(mesh), true));
  support::place_leaf(scene, 0, placement);
  support::cover_instances(scene);
  return scene;
}

TEST(GlSampler, AgreesWithTheExactOneWherePicturesAreLargeAndFull) {
  // Half a million fragments, in pictures of at most 2048 pixels either way.
  const Scene scene = scene_of_mesh(support::torus_mesh(48, 2, 0.6),
                                    support::turn_about({1, 0.2, 0.1}, 1.2));
  const Agreement agreement = compare_with_exact(scene, 0.0019, 0.02);
  EXPECT_GT(agreement.pixels, std::size_t{kPictureSize} * 200);
  EXPECT_LT(agreement.other_counts, agreement.pixels / 1000);
}

TEST(GlSampler, AgreesWithTheExactOneInLeavesThatReachFarBeyondTheScene) {
  // As what is subtracted may; here in a window of 2 mm at the leaf's corner.
  for (const double size : {30.0, 3e3, 1e6}) {
    const Affine placement =
        support::compose(support::shift_by({0.1, 0, 0.2}),
                         support::turn_about({0.3, -0.2, 1}, 0.4));
    Scene scene = scene_of_mesh(
        support::box_mesh(Vec3(-size, -size, -size), Vec3(0)), placement);
    scene.box = {Vec3(-1), Vec3(1)};
    const Agreement agreement = compare_with_exact(scene, 0.02, 0.02);
    EXPECT_GT(agreement.pixels, 1000U);
    EXPECT_LT(agreement.other_counts, 10U) << size;
  }
}

TEST(GlSampler, FindsEachOfSeveralFacesInOnePlace) {
  // The same box three times over, one of them inside out.
  csg::Mesh mesh = support::box_mesh(Vec3(0), Vec3(2));
  const std::size_t count = mesh.triangles.size();
  for (int copy = 0; copy < 2; ++copy) {
    for (std::size_t i = 0; i < count; ++i) {
      auto triangle = mesh.triangles[i];
      if (copy == 1) std::swap(triangle[1], triangle[2]);
      mesh.triangles.push_back(triangle);
    }
  }
  const Scene scene = scene_of_mesh(std::move(mesh), Affine(1.0));
  const RayGrid rays(0, 2, 0.3);
  const LayerGrid layers = LayerGrid::uniform(0, 2, 0.3);
  const auto sampler = make_gl_sampler(scene, rays, layers, shared_raster());
  const LeafImages images = sample_all(*sampler, scene, rays, layers);
  const GridBox& box = images.images[0].box;
  ASSERT_GT(box.pixel_count(), 20U);
  for (std::uint32_t layer = 0; layer < box.layer_count; ++layer) {
    for (std::uint32_t ray = 0; ray < box.ray_count; ++ray) {
      const auto found = sorted(images.ray(images.images[0], layer, ray));
      ASSERT_EQ(found.size(), 6U);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(found[i].depth, i < 3 ? 0 : 2);
        EXPECT_EQ(found[i].is_entry(), i < 2 || i == 3);
      }
    }
  }
}

// Loses the entries of some pixels, and has no room for large pictures.
class FaultyRaster : public FaceRaster {
 public:
  FaultyRaster(std::uint32_t faulty_pixels, int greatest_size)
      : faulty_pixels_(faulty_pixels), greatest_size_(greatest_size) {}

  bool draw(std::span<const RasterCorner> corners, int width, int height,
            std::vector<Fragment>& fragments) override {
    if (std::max(width, height) > greatest_size_) return false;
    const auto begin = static_cast<std::ptrdiff_t>(fragments.size());
    const bool is_done = raster_->draw(corners, width, height, fragments);
    if (faulty_pixels_ == 0) return is_done;
    const auto is_lost = [this](const Fragment& fragment) {
      return fragment.is_entry() && fragment.pixel % faulty_pixels_ == 0;
    };
    fragments.erase(
        std::remove_if(fragments.begin() + begin, fragments.end(), is_lost),
        fragments.end());
    return is_done;
  }

 private:
  std::unique_ptr<FaceRaster> raster_ = shared_raster();
  std::uint32_t faulty_pixels_;  // every so many one; 0: none
  int greatest_size_;
};

TEST(GlSampler, SamplesExactlyWhatWasNotDrawnAsOftenFromBothSides) {
  const Scene scene =
      support::random_scene(3, support::SceneStyle::kGeneric, 10);
  const RayGrid rays(scene.box.low.x, scene.box.high.x, 0.1);
  const LayerGrid layers =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.1);
  const auto sampler = make_gl_sampler(
      scene, rays, layers, std::make_unique<FaultyRaster>(40, kPictureSize));
  const auto exact_sampler = make_scanline_sampler(scene, rays, layers);
  const auto sound_sampler =
      make_gl_sampler(scene, rays, layers, shared_raster());
  const LeafImages images = sample_all(*sampler, scene, rays, layers);
  const LeafImages sound = sample_all(*sound_sampler, scene, rays, layers);
  EXPECT_GT(sampler->repaired_pixels(), 100U);
  EXPECT_LT(sampler->repaired_pixels(), images.ends.size() / 10);
  EXPECT_EQ(images.ends, sound.ends);
  std::size_t entries = 0;
  for (const Sample& sample : images.samples) entries += sample.is_entry();
  EXPECT_EQ(2 * entries, images.samples.size());
}

TEST(GlSampler, DrawsInPartsWhatIsTooMuchForOnePicture) {
  const Scene scene =
      support::random_scene(4, support::SceneStyle::kGeneric, 10);
  const RayGrid rays(scene.box.low.x, scene.box.high.x, 0.1);
  const LayerGrid layers =
      LayerGrid::uniform(scene.box.low.z, scene.box.high.z, 0.1);
  const auto whole = make_gl_sampler(scene, rays, layers, shared_raster());
  const auto parts = make_gl_sampler(scene, rays, layers,
                                     std::make_unique<FaultyRaster>(0, 7));
  const LeafImages expected = sample_all(*whole, scene, rays, layers);
  const LeafImages found = sample_all(*parts, scene, rays, layers);
  ASSERT_EQ(expected.ends, found.ends);
  for (std::size_t i = 0; i < found.samples.size(); ++i) {
    EXPECT_EQ(expected.samples[i].depth, found.samples[i].depth);
  }
}

}  // namespace
}  // namespace lamina::ldni
