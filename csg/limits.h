#pragma once
// What no design needs and no memory holds: numbers that a few letters of text
// can ask for.
//
// They are looked at before anything is made. Who asks does not know the text's
// place; the walk over the tree does, and makes the exception an error there.

#include <cstddef>
#include <stdexcept>

namespace lamina::csg {

// Of a circle. At a radius of 1 m chords of so many are 5e-9 mm off.
constexpr double kMostFragments = 1e6;

// Of a leaf, be it kept as triangles or by formula. As triangles, 100 million
// of them take 2 GB and more.
constexpr double kMostTriangles = 1e8;

// Of a surface(). A few hundred bytes of PNG may unpack to gigabytes of them,
// one long row of numbers makes all rows long; each makes four triangles.
constexpr double kMostHeights = 1 << 23;

class LimitExceeded : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// They throw LimitExceeded where there are more.
void require_fragments(double count);
void require_triangles(double count);
void require_heights(std::size_t columns, std::size_t rows);

}  // namespace lamina::csg
