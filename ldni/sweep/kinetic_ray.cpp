#include "ldni/sweep/kinetic_ray.h"

#include "ldni/sweep/detail/cascade.h"

namespace lamina::ldni {

KineticRay::KineticRay(const csg::Scene& scene, const SweepOptions& options)
    : cascade_(std::make_unique<detail::Cascade>(scene, options)) {}

KineticRay::~KineticRay() = default;

void KineticRay::sweep(const ChainBlock& block, std::uint32_t layer,
                       Contours& contours) {
  cascade_->sweep(block.chains_of(layer), contours);
}

SweepCounts KineticRay::counts() const { return cascade_->counts(); }

}  // namespace lamina::ldni
