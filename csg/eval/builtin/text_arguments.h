#pragma once
// What text(), textmetrics() and fontmetrics() have in common: their arguments.

#include <functional>
#include <string>
#include <string_view>

#include "csg/eval/value/value.h"
#include "csg/tree.h"

namespace lamina::csg {

struct TextArguments {
  // The value of a parameter; undef where none is given, or there is no such
  // parameter.
  std::function<const Value&(std::string_view name)> find;
  std::function<void(const std::string& words)> warn;
  std::string_view caller;
  Language language = Language::k2021;
};

// Warns of arguments that have another type than their parameter.
void check_types(const TextArguments& arguments);

// Reads all but `facets` and `csg_text`.
//
// script   keeps the name of the script
// returns  views of the arguments' strings and of `script`
TextParams read_text(const TextArguments& arguments, std::string& script);

}  // namespace lamina::csg
