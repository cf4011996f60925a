#pragma once
// The CSG tree as `.csg` text.
//
// Exactly what `openscad -o x.csg` of the tree's language writes: a module per
// line with all its parameters, children in braces, tabs for depth, modifiers
// in front of the tabs. The text is a program that evaluates to the same tree.

#include <string>

#include "csg/tree.h"

namespace lamina::csg {

// The whole tree below `root`. A root that is the top level itself shows its
// children only; one that `!` selected (select_root()) shows itself.
std::string print_csg(const Tree& tree, const Node& root);

// Parameters as they stand in `linear_extrude(…)` and `rotate_extrude(…)`.
void append_linear_extrude(const LinearExtrudeParams& params, Language language,
                           std::string& text);
void append_rotate_extrude(const RotateExtrude& extrude, Language language,
                           std::string& text);

}  // namespace lamina::csg
