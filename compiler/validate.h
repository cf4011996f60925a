#pragma once
// What may be asked for: the limits of numbers, and what excludes what.
//
// The command line and the C++ interface fill in a request from different words
// and are checked here alike, so that neither can ask for what the other one
// refuses. Messages name the options of the command line; the interface puts
// its own names in their place.
//
// Only options of slicing may have no effect: the same set of them may be given
// for layers and for texts of a design. (That a design is an outline, which has
// no use for some of them, shows later: compile() warns.)

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "compiler/request.h"

namespace lamina::compiler {

// Thrown where a request is at fault, whatever the design is.
struct RequestError : Error {
  using Error::Error;
};

// words  a format of fmt
template <typename... Args>
void refuse_if(bool is_wrong, fmt::format_string<Args...> words,
               Args&&... args) {
  if (!is_wrong) return;
  throw RequestError(fmt::format(words, std::forward<Args>(args)...));
}

// What GeometryRequest::axis and DesignRequest::language may be.
inline constexpr std::array<std::string_view, 7> kAxisWords = {
    "z", "x", "y", "-x", "-y", "-z", kAutomaticAxis};
inline constexpr std::array<std::string_view, 3> kLanguageWords = {
    "auto", "2021", "2026"};

// A number of a request, and what it may be.
struct NumberLimits {
  std::string_view option;  // that sets it: "--layer"
  double least;
  double greatest;
  // The fault: {0} is the number as it was given, {1} and {2} are the limits.
  std::string_view words;
  double (*value_of)(const Request& request);
  // Whether a request holds 0 where the number was not given.
  bool is_optional = false;

  // Whether the number is finite and within the limits.
  bool hold(double value) const { return value >= least && value <= greatest; }
  std::string fault_of(std::string_view given) const;
};

// The limits of the number that an option sets.
const NumberLimits& limits_of(std::string_view option);

// Throws RequestError where a number is not within its limits, where a word is
// unknown, and where options contradict each other or the format of the output,
// so that nobody believes that an option was obeyed which was not.
void validate(const Request& request);

// Messages about requests name options; other interfaces have names of their
// own. Returns the text with each option in it, "--max-layer", replaced by what
// `own_name` makes of "max-layer".
std::string rename_options(
    std::string_view text,
    const std::function<std::string(std::string name)>& own_name);

}  // namespace lamina::compiler
