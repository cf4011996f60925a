#pragma once
// What OpenCASCADE leaves out of a STEP or IGES file.
//
// It gives back a shape whatever it could not use: an entity that the file
// names and does not have, of a type that it does not know, or of a surface
// that cannot be. What is missing then is reported here: parts and instances
// that have no shape, though the file says that they do, and faults in what
// shapes refer to. Entities that no shape refers to may be of any type. Of a
// number that is none OpenCASCADE says nothing, nor of the place of an IGES
// entity that leads nowhere.

#include <string>

#include <XSControl_Reader.hxx>

namespace lamina::cad {

// Words for a warning, of a reader that has transferred its roots; empty where
// nothing is missing.
std::string loss_of(XSControl_Reader& reader);

}  // namespace lamina::cad
