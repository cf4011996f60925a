#pragma once
// linear_extrude and rotate_extrude. Both throw LimitExceeded.

#include "csg/scene.h"
#include "csg/tree.h"
#include "plane/region/region.h"

namespace lamina::csg {

struct Fineness;

// Straight and evenly scaled extrusions are lofts, one for each contour;
// twisted and unevenly scaled ones are meshes with OpenSCAD's vertices and
// diagonals, because their sides are not planar. The leaf is empty where the
// height is 0 or the region is empty.
//
// The extrusion stands upright, whatever `shift` of its top.
//
// fineness  of sides that are not planar, where slices= does not decide; its
//           chordal error is 0 where $fa and $fs decide
Leaf extrude_linearly(const LinearExtrudeParams& params,
                      const plane::Region& region, const Fineness& fineness);

// The region with x = 0 where a point is as good as on the axis, within 1e-8
// mm: rounding makes such. (OpenSCAD's grid of 2^-16 mm takes even more there.)
plane::Region put_on_axis(plane::Region region);

// Least and greatest x of the region, 0 included [mm].
struct ProfileRange {
  double low = 0;
  double high = 0;

  bool crosses_axis() const;
};
ProfileRange profile_range(const plane::Region& region);

// Turns the region about the y axis, which becomes z. A full turn gives lofts,
// a part of one a mesh. The region must not cross the axis.
//
// start_deg  of the region, counter-clockwise from +x
// angle_deg  from there on, in (-360, 360]
// fragments  over the whole angle
Leaf extrude_around(const plane::Region& region, double start_deg,
                    double angle_deg, int fragments);

}  // namespace lamina::csg
