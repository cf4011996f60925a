#pragma once
// Sprues of a design: planned on its thickness, and added to its text.

#include <optional>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/temporary_files.h"
#include "compiler/request.h"
#include "csg/scene.h"

namespace lamina::compiler {

// The sprues that the request asks for, of the design as it stands. No value
// where the design fails: the run itself will say why. Warns of sprues on
// visible surfaces.
//
// Throws GeometryError where the design is flat, has sprues already, or no
// straight rod gets out of a thick place.
std::optional<slicer::SpruePlan> plan_sprues(const Request& request,
                                             std::size_t evaluation_stack,
                                             TemporaryFiles& files,
                                             Diagnostics& diagnostics);

// Whether a written sprue made the leaf.
bool is_sprue(const csg::Instance& instance);

// What metal does not reach that enters a solid by this root, the largest
// first.
std::vector<slicer::Pool> unfed_by(const csg::Scene& scene, Vec3 root);

}  // namespace lamina::compiler
