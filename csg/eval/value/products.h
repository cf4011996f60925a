#pragma once
// The products of vectors and matrices.

#include <span>

#include "csg/eval/value/undefined.h"
#include "csg/eval/value/value.h"

namespace lamina::csg {

// The dot product of two vectors, or the product of a matrix (a vector of
// vectors) and a vector or a matrix: what is meant depends on the first
// elements. undef with its reason where sizes or elements do not fit.
Value multiply_vectors(std::span<const Value> a, std::span<const Value> b,
                       Reason& reason);

}  // namespace lamina::csg
