#pragma once
// Names of outputs where there are several: patterns with words in braces,
// such as "out/{name}.slc".
//
// A word can have a divisor, "out/{row:/1000}/{name}.slc": a whole number is
// divided by it and the rest dropped, so that no folder gets more than 1,000
// files.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"

namespace lamina::cli {

// The words in braces, without divisors, in the order in which they stand
// there. A brace that is not closed is text.
std::vector<std::string> words_of_pattern(std::string_view pattern);

// The pattern with its words, and the braces around them, replaced. Throws
// FileError where a word has a divisor and its value is not a whole number, or
// where the result is '-': one of several outputs cannot be standard output.
std::string fill_pattern(
    std::string_view pattern,
    const std::function<std::string(const std::string& word)>& value_of);

// Returns `text`; throws FileError where it cannot be a part of a file's name.
std::string require_part_of_name(const std::string& text);

// Makes the folder of an output and those around it. Where that fails, opening
// the output reports why.
void make_folder_of(const std::string& output, const FileAccess& access);

// The last part of a path without its extension: "ring" of "in/ring.scad".
std::string stem(const std::string& path);

}  // namespace lamina::cli
