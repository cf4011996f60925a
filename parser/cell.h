#pragma once
// From the cell of a table to the value of a variable.
//
//     57  -1.5  1e3          numbers
//     true  FALSE            truth values
//     [1, 2.5, "a"]          vectors, as OpenSCAD writes them
//     "57"                   text in OpenSCAD's quotes, whatever it looks like
//     Ada, size 57           anything else is text, as it stands
//
// A variable that the design sets to a text takes all but quoted text as it
// stands: an engraving may be 2024. One that it sets to a number, a truth value
// or a vector takes one of these or a quoted text, and no typing mistake.

#include <string>
#include <string_view>

#include "parser/tree_facts.h"

namespace lamina {

enum class DecimalSign : std::uint8_t { kPoint, kPointOrComma };

// `cell` as OpenSCAD writes the value.
//
// cell    not empty
// throws  FileError without a place: "a number was expected, not 'x' …"
std::string value_of_cell(std::string_view cell, ast::ValueType type,
                          DecimalSign decimal);

}  // namespace lamina
