#pragma once
// The primitives of Part and of PartDesign, by their parameters.

#include <optional>
#include <string>
#include <string_view>

#include "csg/import/freecad/detail/document.h"
#include "csg/import/freecad/detail/solid_maker.h"

namespace lamina::csg::freecad {

// The primitive before the object's placement.
//
// kind     the type without "Part::", "PartDesign::Additive" and such: "Box"
// why      gets the reason where there is nothing
// returns  nothing for another kind, or for parameters of which no solid can
//          be made
std::optional<Solid> make_primitive(std::string_view kind, const Object& object,
                                    SolidMaker& maker, std::string& why);

}  // namespace lamina::csg::freecad
