#pragma once
// Thin features for the report: what made them, in the words of messages.

#include <span>
#include <string>
#include <vector>

#include "csg/scene.h"
#include "slicer/check/thin_features.h"

namespace lamina::cli {

// What made a side of a feature.
struct FeatureOrigin {
  struct Call {
    std::string module;
    std::string place;
  };
  std::string place;        // "ring.scad:12:3", of the leaf
  std::vector<Call> calls;  // modules around it, innermost first
};

// The leaves of each feature; those of both sides, if they differ, and none
// where it is not known.
std::vector<std::vector<FeatureOrigin>> origins_of(
    const csg::Scene& scene, std::span<const slicer::ThinFeature> features);

// For the table: "lib.scad:8:5 from ring.scad:40:3, ring.scad:12:3".
std::vector<std::string> origin_texts(
    std::span<const std::vector<FeatureOrigin>> origins);

// A JSON list, one feature a line.
//
// width  that they are thinner than [mm]
std::string features_json(std::span<const slicer::ThinFeature> features,
                          double width,
                          std::span<const std::vector<FeatureOrigin>> origins);

}  // namespace lamina::cli
