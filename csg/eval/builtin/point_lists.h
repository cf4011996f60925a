#pragma once
// Points, faces and paths as OpenSCAD 2026 reads them: what is wrong is warned
// of where the module is called, and left out.

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "csg/eval/builtin/modules.h"

namespace lamina::csg {

// The points of the call; a wrong one is the origin. None where `points` is no
// vector.
std::optional<std::vector<Vec2>> read_points_2d(const ModuleCall& call);
std::optional<std::vector<Vec3>> read_points_3d(const ModuleCall& call);

// A parameter's lists of indices of points, kept by the interpreter. None where
// it is no vector.
//
// points  how many there are
// least   lists of fewer indices are left out
std::optional<std::span<const std::span<const std::uint32_t>>> read_index_lists(
    std::string_view parameter, std::size_t points, std::size_t least,
    const ModuleCall& call);

}  // namespace lamina::csg
