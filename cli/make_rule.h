#pragma once
// What an output depends on, for make (`-d`).

#include <span>
#include <string>

namespace lamina::cli {

// "ring.slc: \\\n\tring.scad …": a rule without commands, ended by '\n'.
//
// files    each may come up more than once; written in the order in which
//          OpenSCAD 2021.01 writes them, that of its hash table
std::string make_rule(const std::string& target,
                      std::span<const std::string> files);

}  // namespace lamina::cli
