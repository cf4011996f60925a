#pragma once
// A name in the top of a raft, so that pieces of a plate can be told apart when
// they are taken off.
//
// The text lies where the raft has room for it between the feet. Where there is
// none, the raft gets a tab for it.

#include <string>

#include "base/vec.h"
#include "slicer/supports/support_plan.h"

namespace lamina::slicer {

// Of the letters, as text() takes it: small ones without ascenders, the lowest,
// are 2 mm high [mm].
inline constexpr double kLabelSize = 2.8;
inline constexpr double kLabelDepth = 0.4;  // [mm]

// Puts a label on the plan's raft. Returns false where there is no foot, and so
// no raft.
//
// box  of the text's outline where it begins at the origin [mm]
bool add_label(const std::string& text, const Box2& box, SupportPlan& plan);

}  // namespace lamina::slicer
