#pragma once
// Names of files as OpenSCAD's messages show them.

#include <string>
#include <string_view>

namespace lamina {

// Absolute path of `path`, without "." and ".."; links are kept.
std::string absolute_path(const std::string& path);

// The folder of a file, absolute.
std::string folder_of(const std::string& path);

// `path` seen from the folder `base`, with as many "../" as it takes.
std::string relative_path(const std::string& path, const std::string& base);

// `path` as a terminal shows it: relative if it lies below the current folder.
std::string shown_path(const std::string& path);

// Whether the name is that of a font, in any letter case.
bool is_font(std::string_view file);

}  // namespace lamina
