#pragma once
// Why a design makes nothing.

#include <vector>

#include "base/diagnostic.h"
#include "csg/tree.h"

namespace lamina::csg {

// The objects that are nothing, each with its place and the reason; and, of a
// difference or an intersection of others, that it leaves nothing, which holds
// where the whole design is known to be nothing; or that the design makes no
// object. At most a few, and none where the reason is not known. Does not walk
// a large tree to its end.
std::vector<Note> why_empty(const Tree& tree);

}  // namespace lamina::csg
