#pragma once
// The 2D modules of the tree, as regions.
//
// They report faulty parameters in OpenSCAD's words. All of
// them throw std::range_error for coordinates beyond 1e9 mm.

#include <span>

#include "base/diagnostic.h"
#include "csg/lower/detail/fineness.h"
#include "csg/plane/region.h"
#include "csg/scene.h"
#include "csg/text/typesetter.h"
#include "csg/tree.h"

namespace lamina::csg {

planar::Region make_polygon(const PolygonParams& polygon, SourceRange range,
                            Diagnostics& diagnostics);

planar::Region make_text(const TextParams& params, const Fineness& fineness,
                         text::Typesetter& typesetter, SourceRange range,
                         Diagnostics& diagnostics);

// regions  at least one
planar::Region combine_regions(BooleanOp op,
                               std::span<const planar::Region> regions);

// minkowski(): the sum of all regions that are not empty; empty where the first
// one is, or all others are.
planar::Region add_regions(std::span<const planar::Region> regions);

planar::Region offset_region(const Offset& offset, const Fineness& fineness,
                             const planar::Region& region);

// Fills each shape where its contours enclose a point an odd number of times,
// and unites all shapes.
planar::Region fill_shapes(
    std::span<const std::vector<planar::Contour>> shapes);

// Applies the part of the matrix that acts in the plane. Outer contours stay
// counter-clockwise.
planar::Region transform_region(planar::Region region, const Mat4& matrix,
                                SourceRange range, Diagnostics& diagnostics);

}  // namespace lamina::csg
