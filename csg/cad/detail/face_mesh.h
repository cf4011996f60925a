#pragma once
// The triangles of one face, as BRepMesh made them, and where these are too far
// from its surface, split.
//
// BRepMesh takes a deflection for a wish: of ten thousand triangles a few
// deviate by two or three times as much, and half the deflection leaves others.
// So these few are split, by points of the surface: a triangle and its
// neighbour at their common side where that is the longest, or else the
// triangle alone, at its middle. Edges of the face stay as they are, for
// another face has them, too.

#include <array>
#include <cstdint>
#include <vector>

#include <Poly_Triangulation.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Pnt.hxx>
#include <gp_XY.hxx>

namespace lamina::cad {

struct FaceMesh {
  std::vector<gp_Pnt> points;  // those of the triangulation, then further ones
  std::vector<gp_XY> uv;       // their parameters; empty: not known
  // Counter-clockwise as seen from outside of the solid.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

FaceMesh face_mesh(const TopoDS_Face& face,
                   const Poly_Triangulation& triangulation,
                   const TopLoc_Location& place);

// Splits what is too far from the face's surface. Returns the greatest distance
// that stays [mm], or any that is at most `chordal_error`.
double refine(const TopoDS_Face& face, double chordal_error, FaceMesh& mesh);

}  // namespace lamina::cad
