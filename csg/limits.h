#pragma once
// What no design needs and no memory holds: numbers that a few letters of text
// can ask for. plane/limits.h has those of the plane.
//
// They are checked before anything is made of them. The check does not know the
// place in the text; the walk over the tree does, and adds it to the error.

#include <cstddef>

#include "plane/limits.h"

namespace lamina::csg {

// A circle may have so many. At a radius of 1 m their chords are 5e-9 mm off.
constexpr double kMostFragments = 1e6;

// A leaf may have so many, be it kept as triangles or by formula. As triangles
// they take 2 GB and more.
constexpr double kMostTriangles = 1e8;

// A surface() may have so many. A few hundred bytes of PNG may unpack to more,
// one long row of numbers makes all rows long; each makes four triangles.
constexpr double kMostHeights = 1 << 23;

// So many groups may hold one object of a FreeCAD file; FreeCAD allows two.
constexpr std::size_t kMostGroups = 100;

// All entries of a FreeCAD file may unpack to so many bytes, and no more for
// each byte of the file. FreeCAD's own files swell to ten times their size.
constexpr double kMostUnpackedBytes = 2147483648;
constexpr double kMostSwelling = 50;

// Elements and attributes of a text in a FreeCAD file; each takes up to 72
// bytes of memory. Ten thousand objects have a million.
constexpr std::size_t kMostXmlParts = 1 << 23;

// These throw plane::LimitExceeded where there are more.
void require_fragments(double count);
void require_triangles(double count);
void require_heights(std::size_t columns, std::size_t rows);

}  // namespace lamina::csg
