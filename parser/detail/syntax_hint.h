#pragma once
// What to say about a syntax error besides OpenSCAD's two words.
//
// Bison knows all tokens that could stand where the error is; after an operand
// these are two dozen. A person needs few of them: operators go without saying,
// and all that begins an expression is "an expression".

#include <string>
#include <string_view>
#include <vector>

namespace lamina::detail {

// "unexpected ';', expected ']' or ','".
//
// symbol    what the grammar calls the token where the error is
// text      the token
// expected  the grammar's names of all tokens that could stand there
std::string describe_syntax_error(std::string_view symbol,
                                  std::string_view text,
                                  std::vector<std::string_view> expected);

}  // namespace lamina::detail
