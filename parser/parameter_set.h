#pragma once
// Parameter sets: values for the parameters of a design, in a file of
// OpenSCAD's customizer.
//
//     {"parameterSets": {"wide": {"width": "12", "name": "Ada"}}}
//
// A value is a text. A parameter that is a string takes it as it is, one that
// is true or false takes true, false, 1 or 0, any other takes it in the
// notation of the customizer's comments if that gives a value of its own type,
// and keeps its own else. What is no parameter of the design is passed over.
//
// So says OpenSCAD 2021.01. In language 2026 only what customizer.h's
// ParameterRule describes can be set: numbers are moved into their range, texts
// cut to their length, and what is no choice is left out. In both languages a
// warning says what does not keep to the rule.
//
// Departures from OpenSCAD 2021.01: a set that the file lacks is an error, not
// the design's own values; and only variables whose value is a literal, or
// arithmetic on literals, can be set.

#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "parser/ast.h"
#include "parser/language.h"

namespace lamina {

// Sets the variables of `program` to the values of `set` in the file `path`.
//
// returns  false where the file cannot be read, the set is not there or a value
//          cannot be used; that is reported, and the values before it stay set
// throws   AccessError where the file may not be read
bool apply_parameter_set(const std::string& path, const std::string& set,
                         ast::Program& program, Language language,
                         Diagnostics& diagnostics,
                         const FileAccess& access = kAllFiles);

// The names of all sets of a file, in the order in which they stand there.
// Throws FileError where it cannot be read, AccessError where it may not be.
std::vector<std::string> parameter_set_names(
    const std::string& path, const FileAccess& access = kAllFiles);

}  // namespace lamina
