#pragma once
// From syntax tree to CSG tree: evaluation of OpenSCAD programs.
//
// Names are resolved to slots (resolve/), functions and modules when they are
// first called; the resolved code (code/) runs (run/, builtin/) and makes the
// nodes of the CSG tree. Each of these rooms knows those before it: value, code,
// run, builtin, resolve.
//
// The rules are those of OpenSCAD 2021.01, oddities included: assignments before
// instantiations, the last value of a name at its first place, arguments
// evaluated in the order of a hash table, the variables of a used file assigned
// anew for each call from outside. Messages are its own, word for word.

#include "base/diagnostic.h"
#include "csg/eval/run/evaluate_options.h"
#include "csg/tree.h"
#include "parser/ast.h"

namespace lamina {
class Loader;
}

namespace lamina::csg {

// Evaluates a program.
//
// loader       knows the used files of `program`; outlives the call
// diagnostics  gets echoes, warnings and the error that ended the evaluation
//              early (failed assertion, endless recursion, a limit), if one
//              did
// returns      the tree, rooted in the implicit group of the top level. After
//              an error it is empty. If instantiations carry `!`, those nodes
//              say is_root; select_root() applies it.
// throws       what `diagnostics` throws under hard warnings
Tree evaluate(const ast::Program& program, const Loader& loader,
              const EvaluateOptions& options, Diagnostics& diagnostics);

// The node that `!` selects: the first one of the tree that carries it, else
// the root. Warns where a second instantiation carries it as well.
const Node* select_root(const Tree& tree, Diagnostics& diagnostics);

}  // namespace lamina::csg
