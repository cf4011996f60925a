#pragma once
// The primitives of Part and of PartDesign, by their parameters: boxes, and
// whole cylinders, cones, balls and tori. All others, and parts of these, are
// taken by their boundary.

#include <optional>
#include <string>
#include <string_view>

#include "csg/import/freecad/detail/document.h"
#include "csg/import/freecad/detail/solid_maker.h"

namespace lamina::csg::freecad {

// kind  the type without "Part::", "PartDesign::Additive" and such: "Box"
bool is_primitive(std::string_view kind);

// The primitive before the object's placement.
//
// kind     one that is_primitive()
// why      gets the reason where there is nothing
// returns  nothing for parameters that make no whole body
std::optional<Solid> make_primitive(std::string_view kind, const Object& object,
                                    SolidMaker& maker, std::string& why);

}  // namespace lamina::csg::freecad
