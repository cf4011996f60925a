#pragma once
// Which leaves of a scene make a place solid or empty.

#include <span>

#include "csg/scene.h"
#include "ldni/section/grid.h"
#include "slicer/check/print/layer_graph.h"
#include "slicer/supports/support_contacts.h"

namespace lamina::slicer {

// Sets the instances of findings: of what contains the finding's place in its
// layer and not in the one below, or the reverse, the first; else the
// first that contains it. Cuts the leaves in these layers once more, so that
// only designs with findings pay for it. Minor findings keep none.
void find_makers(const csg::Scene& scene, const ldni::LayerGrid& grid,
                 std::span<Finding> findings);

// Sets the instances of contacts: the first that contains the contact's place
// in the part's layer and is not a support.
void find_makers(const csg::Scene& scene, const ldni::LayerGrid& grid,
                 std::span<SupportContact> contacts);

}  // namespace lamina::slicer
