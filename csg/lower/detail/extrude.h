#pragma once
// linear_extrude and rotate_extrude; beyond kMostTriangles they throw.

#include "csg/plane/region.h"
#include "csg/scene.h"
#include "csg/tree.h"

namespace lamina::csg {

// Straight and evenly scaled extrusions are Lofts, one for each contour;
// twisted and unevenly scaled ones are meshes with OpenSCAD's vertices and
// diagonals, because their sides are not planar. No loft and no mesh where
// the height or the region is nothing.
//
// chordal_error  of sides that are not planar, where neither $fn nor slices
//                decide [mm]; 0: $fa and $fs decide
Leaf extrude_linearly(const LinearExtrudeParams& params,
                      const planar::Region& region, double chordal_error);

// Least and greatest x of the region, 0 included [mm].
struct ProfileRange {
  double low = 0;
  double high = 0;

  bool crosses_axis() const;
};
ProfileRange profile_range(const planar::Region& region);

// The region turned about the y axis, which becomes z. A full turn gives
// Lofts, less gives a mesh. The region must not cross the axis.
//
// angle_deg  in (-360, 360]
// fragments  over the whole angle
Leaf extrude_around(const planar::Region& region, double angle_deg,
                    int fragments);

}  // namespace lamina::csg
