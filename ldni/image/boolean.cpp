#include "ldni/image/boolean.h"

#include <algorithm>

#include "base/check.h"
#include "plane/tie_distance.h"

namespace lamina::ldni {
namespace {

// Returns `sample` as a sample of the result's surface: where its leaf is
// subtracted, the normal is reversed.
Sample surface_sample(Sample sample, bool is_entry) {
  if (sample.is_entry() != is_entry) sample.normal = -sample.normal;
  return sample;
}

}  // namespace

RayBoolean::RayBoolean(const csg::Scene& scene)
    : program_(csg::program_of(scene)), winding_(scene.instances.size(), 0) {
  counts_winding_.reserve(scene.instances.size());
  for (const csg::Instance& instance : scene.instances) {
    counts_winding_.push_back(scene.leaves[instance.leaf].may_overlap_itself);
  }
}

void RayBoolean::evaluate(std::span<Sample> samples,
                          std::vector<Interval>& out) {
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) {
              if (a.depth != b.depth) return a.depth < b.depth;
              return a.instance < b.instance;
            });
  Sample enter;
  for (std::size_t i = 0; i < samples.size();) {
    // Flip all leaves of one event; the last sample that changed to the state
    // after the event represents it.
    const bool was_inside = program_.value();
    bool is_inside = was_inside;
    std::size_t surface = i;
    for (double depth = samples[i].depth;
         i < samples.size() && samples[i].depth - depth <= kTieDistance; ++i) {
      depth = samples[i].depth;
      flip_leaf(samples[i]);
      if (program_.value() == is_inside) continue;
      is_inside = !is_inside;
      if (is_inside != was_inside) surface = i;
    }
    if (is_inside == was_inside) continue;
    if (is_inside) {
      enter = surface_sample(samples[surface], true);
    } else {
      out.push_back({enter, surface_sample(samples[surface], false)});
    }
  }
  LAMINA_CHECK_EQ(program_.inside().size(), std::size_t{0});
}

// Notes that the ray crosses the surface of a leaf.
void RayBoolean::flip_leaf(const Sample& sample) {
  std::int32_t& winding = winding_[sample.instance];
  const bool was_inside = winding != 0;
  if (counts_winding_[sample.instance]) {
    winding += sample.is_entry() ? 1 : -1;
  } else {
    winding = was_inside ? 0 : 1;
  }
  const bool is_inside = winding != 0;
  if (is_inside != was_inside) program_.flip(sample.instance, is_inside);
}

}  // namespace lamina::ldni
