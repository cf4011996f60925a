#pragma once
// Names of files as messages show them.
//
// OpenSCAD's messages name files from the working folder, or by whole paths.
// Under --root messages may reach strangers, who need not know where the root
// is: all files in it are named from there. That holds for the process, as the
// working folder does, and nobody else decides how a file is named.

#include <string>
#include <string_view>

namespace lamina {

// Absolute path of `path`, without "." and ".."; links are kept.
std::string absolute_path(const std::string& path);

// The folder of a file, absolute.
std::string folder_of(const std::string& path);

// `path` seen from the folder `base`, with as many "../" as it takes.
std::string relative_path(const std::string& path, const std::string& base);

// Names files in that folder from there, from now on. Called before there are
// other threads.
//
// canonical  its path without links
void name_files_from(const std::string& folder, const std::string& canonical);

// `path` as messages show it: from the folder of name_files_from() if it lies
// there, else as it is. ("-" is a stream.)
std::string display_path(const std::string& path);

// display_path(), as a terminal shows it: relative if it lies below the current
// folder.
std::string shown_path(const std::string& path);

// A path that shown_path() has shown, for reading: where files are named from a
// folder it lies there.
std::string path_of_shown(const std::string& shown);

// `path` in quotes, as OpenSCAD shows it: from the current folder, with as
// many "../" as it takes.
std::string quoted_path(std::string_view path);

// A message that may hold whole paths, with all of them as display_path() has
// them. O(text).
std::string with_display_paths(std::string text);

// Whether the name is that of a font, in any letter case.
bool is_font(std::string_view file);

}  // namespace lamina
