#pragma once
// What built-in functions have in common: reading arguments, warning of them.

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "csg/eval/code/code.h"
#include "csg/eval/run/interpreter.h"

namespace lamina::csg {

inline Value argument(const CallCode& code, std::size_t i, Frame& frame) {
  return run(code.arguments[i].value, frame);
}

// The value of each parameter, undef where none was given, of a function that
// takes arguments by name as well. Warns of arguments that belong to no
// parameter.
//
// positional  how many of the parameters arguments without a name reach
std::vector<Value> run_named_arguments(
    std::span<const std::string_view> parameters, std::size_t positional,
    const CallCode& code, Frame& frame);

// Warn and return undef, the result of the call.
template <typename... Parts>
Value warn(const CallCode& code, Frame& frame,
           fmt::format_string<Parts...> words, Parts&&... parts) {
  frame.in.warn(code.range, fmt::format(words, std::forward<Parts>(parts)...));
  return Value();
}
// The same; the message names the file relative to the used file that calls.
template <typename... Parts>
Value warn_in_file(const CallCode& code, Frame& frame,
                   fmt::format_string<Parts...> words, Parts&&... parts) {
  frame.in.warn(code.range, fmt::format(words, std::forward<Parts>(parts)...),
                frame.document);
  return Value();
}
Value wrong_count(const CallCode& code, Frame& frame);
Value wrong_type(const CallCode& code, Frame& frame);

}  // namespace lamina::csg
