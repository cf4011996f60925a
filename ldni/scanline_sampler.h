#pragma once
// The exact sampler: triangles are intersected with layers, the segments that
// arise with rays, in double precision. The reference for all others.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "csg/scene.h"
#include "ldni/ray_grid.h"
#include "ldni/sampler.h"

namespace lamina::ldni {

// Triangle meshes of all leaves of a scene, made once and shared by threads
// and instances. A leaf that is a mesh already is not copied, so the scene must
// outlive this.
class LeafMeshes {
 public:
  explicit LeafMeshes(const csg::Scene& scene);

  const csg::Mesh& operator[](std::uint32_t leaf) const {
    return *meshes_[leaf];
  }

 private:
  std::vector<std::unique_ptr<const csg::Mesh>> owned_;
  std::vector<const csg::Mesh*> meshes_;  // by leaf
};

class ScanlineSampler final : public Sampler {
 public:
  // All arguments must outlive the sampler.
  ScanlineSampler(const csg::Scene& scene, const LeafMeshes& meshes,
                  const RayGrid& rays, const LayerGrid& layers);
  ~ScanlineSampler() override;

  // Cost: all vertices and triangles of the leaf, plus the samples, plus the
  // pixels of the box.
  void sample(std::uint32_t instance, const GridBox& box,
              LeafImages& out) override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lamina::ldni
