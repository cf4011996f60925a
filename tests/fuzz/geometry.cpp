#include "tests/fuzz/geometry.h"

#include <cmath>

#include "base/diagnostic.h"
#include "csg/lower/lower.h"
#include "slicer/slice/slice.h"
#include "tests/csg/lower/tree_builder.h"
#include "tests/fuzz/input.h"

namespace lamina::fuzz {
namespace {

// Wants what every writer relies on.
class FiniteSink : public slicer::LayerSink {
 public:
  void take(const slicer::Layer& layer) override {
    for (const Vec2& point : layer.contours.points) {
      require(std::isfinite(point.x) && std::isfinite(point.y),
              "points are finite");
    }
  }
};

slicer::Settings settings_for(const Box3& box) {
  slicer::Settings settings;
  settings.threads = 1;
  const double height = box.high.z - box.low.z;
  // At the faces, where much is level, and between them.
  for (const double part : {0.0, 0.3, 0.5, 1.0}) {
    const double z = box.low.z + part * height;
    if (settings.heights.empty() || z > settings.heights.back()) {
      settings.heights.push_back(z);
    }
  }
  return settings;
}

void slice(const csg::Tree& tree) {
  Diagnostics diagnostics;
  FiniteSink sink;
  try {
    const csg::Lowered lowered = csg::lower(tree, {}, diagnostics);
    if (const plane::Region* outline = lowered.outline()) {
      slicer::slice_outline(*outline, {}, sink, diagnostics);
    } else if (const csg::Scene* scene = lowered.scene()) {
      const slicer::Settings settings = settings_for(scene->box);
      slicer::slice(*scene, slicer::plan_layers(*scene, settings), settings,
                    sink, diagnostics);
    }
  } catch (const GeometryError&) {
    // Too large, for instance.
  }
}

}  // namespace

void slice_import(const std::string& path, csg::ImportFormat format) {
  csg::ImportParams params;
  params.path = path;
  params.format = format;
  csg::TreeBuilder builder;
  slice(builder.tree({builder.node(csg::Import{&params})}));
}

}  // namespace lamina::fuzz
