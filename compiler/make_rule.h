#pragma once
// What an output depends on, for make (`-d`).
//
// A design chooses the names of the files that it imports, whether they are
// there or not, and make expands what it reads: "$(shell …)", a line of its
// own, or what follows a ';' would be commands. So every name is written as GNU
// make (4.3) reads it back, byte for byte; OpenSCAD 2021.01 only marks blanks.

#include <span>
#include <string>

namespace lamina::compiler {

// "ring.slc: \\\n\tring.scad …": a rule without commands, ended by '\n'.
//
// files    each may come up more than once; written in the order in which
//          OpenSCAD 2021.01 writes them, that of its hash table
// throws   FileError where make has no way to write a name: one with control
//          characters or ';', with '~' in front, or with '\\', ')' or a blank
//          at its end
std::string make_rule(const std::string& target,
                      std::span<const std::string> files);

}  // namespace lamina::compiler
