#pragma once
// Which way three points turn.

#include "base/vec.h"

namespace lamina::planar {

// +1 where a, b, c run counter-clockwise, -1 clockwise, 0 on one line. Exact
// for coordinates whose differences fit a double.
int orientation(Vec2 a, Vec2 b, Vec2 c);

}  // namespace lamina::planar
