#include "plane/cascade/kinetic_ray.h"

#include "plane/cascade/cascade.h"

namespace lamina::plane {

KineticRay::KineticRay(const BooleanProgram& program,
                       const SweepOptions& options)
    : cascade_(std::make_unique<Cascade>(program, options)) {}

KineticRay::~KineticRay() = default;

void KineticRay::sweep(const ChainBlock& block, std::uint32_t layer,
                       Contours& contours) {
  cascade_->sweep(block.chains_of(layer), contours);
}

SweepCounts KineticRay::counts() const { return cascade_->counts(); }

}  // namespace lamina::plane
