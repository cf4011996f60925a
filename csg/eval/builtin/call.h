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

// These warn and return undef.
//
// A call has not as many arguments as expected ("1", "3 or 4").
Value wrong_count(const CallCode& code, Frame& frame,
                  std::string_view expected);
// An argument is `found`, which has not the type that was expected.
Value wrong_type(const CallCode& code, Frame& frame, std::size_t argument,
                 Type expected, const Value& found);
// Warns so in 2026 alone, where 2021.01 says nothing.
Value newly_wrong_type(const CallCode& code, Frame& frame, std::size_t argument,
                       Type expected, const Value& found);
// Warn so of functions that 2021.01 has not.
Value wrong_count_of_new(const CallCode& code, Frame& frame,
                         std::string_view expected);
Value wrong_type_of_new(const CallCode& code, Frame& frame,
                        std::size_t argument, Type expected,
                        const Value& found);

// Runs the arguments from `next` on, where 2026 does so before it finds another
// one wrong, which 2021.01 leaves out.
void run_rest(const CallCode& code, std::size_t next, Frame& frame);

inline Value argument(const CallCode& code, std::size_t i, Frame& frame) {
  return run(code.arguments[i].value, frame);
}

// What `make_result` makes of the one argument of a function.
template <typename MakeResult>
Value with_argument(const CallCode& code, Frame& frame,
                    const MakeResult& make_result) {
  if (code.arguments.size() != 1) return wrong_count(code, frame, "1");
  Value spill;
  return make_result(look(code.arguments[0].value, frame, spill));
}

// The value of each parameter, undef where none was given, of a function that
// takes arguments by name as well. Warns of arguments that belong to no
// parameter.
//
// positional  how many of the parameters arguments without a name reach
std::vector<Value> run_named_arguments(
    std::span<const std::string_view> parameters, std::size_t positional,
    const CallCode& code, Frame& frame);

template <typename... Parts>
Value warn(const CallCode& code, Frame& frame,
           fmt::format_string<Parts...> words, Parts&&... parts) {
  frame.in.warn(code.range, fmt::format(words, std::forward<Parts>(parts)...));
  return Value();
}
// Warns; the message names the file relative to the used file that calls.
template <typename... Parts>
Value warn_in_file(const CallCode& code, Frame& frame,
                   fmt::format_string<Parts...> words, Parts&&... parts) {
  frame.in.warn(code.range, fmt::format(words, std::forward<Parts>(parts)...),
                frame.document);
  return Value();
}

}  // namespace lamina::csg
