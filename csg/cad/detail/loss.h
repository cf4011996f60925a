#pragma once
// What OpenCASCADE leaves out of a STEP or IGES file.
//
// It gives back a shape whatever it could not use: an entity that the file
// names and does not have, of a type that it does not know, or of a surface
// that cannot be. What is missing then is told here.

#include <string>

#include <XSControl_WorkSession.hxx>

namespace lamina::cad {

// Words for a warning, of a session that has transferred its roots; empty where
// nothing is missing.
std::string loss_of(const XSControl_WorkSession& session);

}  // namespace lamina::cad
