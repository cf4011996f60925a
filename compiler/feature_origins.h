#pragma once
// The lines of the design that made thin features.

#include <span>
#include <string>
#include <vector>

#include "csg/scene.h"
#include "slicer/check/thin_features.h"

namespace lamina::compiler {

// What made a side of a feature.
struct FeatureOrigin {
  struct Call {
    std::string module;
    std::string place;
  };
  std::string place;        // "ring.scad:12:3", of the leaf
  std::vector<Call> calls;  // modules around it, innermost first
};

// The leaves of a feature: those of both sides, if they differ; none where it
// is not known.
using FeatureOrigins = std::vector<FeatureOrigin>;

std::vector<FeatureOrigins> origins_of(
    const csg::Scene& scene, std::span<const slicer::ThinFeature> features);

// One text for each: "lib.scad:8:5 from ring.scad:40:3, ring.scad:12:3".
std::vector<std::string> origin_texts(std::span<const FeatureOrigins> all);

}  // namespace lamina::compiler
