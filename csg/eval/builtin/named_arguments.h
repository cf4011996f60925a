#pragma once
// Arguments of those built-in functions that take them by name as well.

#include <span>
#include <string_view>
#include <vector>

#include "csg/eval/code/code.h"
#include "csg/eval/value/value.h"

namespace lamina::csg {

// The value of each parameter, undef where none was given. Warns of arguments
// that belong to no parameter.
//
// positional  how many of the parameters arguments without a name reach
std::vector<Value> run_named_arguments(
    std::span<const std::string_view> parameters, std::size_t positional,
    const CallCode& code, Frame& frame);

}  // namespace lamina::csg
