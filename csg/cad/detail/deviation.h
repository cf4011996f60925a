#pragma once
// How far a triangulated solid is from the curves and surfaces themselves.

#include <TopoDS_Shape.hxx>

namespace lamina::cad {

// The greatest distance found [mm] of points of edges from their chords, and of
// points of triangles from the surface of their face.
//
// limit  what is found need not be greater: the search ends there
double find_deviation(const TopoDS_Shape& shape, double limit);

}  // namespace lamina::cad
