#pragma once
// Active zones: where in a layer the leaves below an operator can matter.
//
// The zone of an operator is where all operators from it up to the root can
// hold (Rossignac and Voelcker, "Active zones in CSG for accelerating boundary
// evaluation, redundancy elimination, interference detection, and shading
// algorithms", ACM Transactions on Graphics 8, 1989). Outside of it one of them
// fails whatever the leaves below are, as long as no leaf leaves its own box.
// Here zones are boxes, found in two passes (S-bounds: Cameron, "Efficient
// bounds in constructive solid geometry", IEEE Computer Graphics and
// Applications 11, 1991):
//
//   upwards    an operator holds at most in the box around those of its
//              operands (union), in what they have in common (intersection), in
//              that of what is subtracted from (difference);
//   downwards  the zone of an operator is what its box has in common with the
//              zone of the operator above.
//
// That of a subtrahend needs no rule of its own: the box of the difference is
// that of its minuend.

#include <span>
#include <vector>

#include "base/vec.h"
#include "plane/program/boolean_program.h"

namespace lamina::plane {

// Whether zones can be smaller than what lies in them.
bool has_active_zones(const BooleanProgram& program);

// The zone of each operator of the program.
//
// boxes  of each operand; empty where the layer has nothing of it
std::vector<Box2> active_zones(const BooleanProgram& program,
                               std::span<const Box2> boxes);

}  // namespace lamina::plane
