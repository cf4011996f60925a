#pragma once
// The way to a file, taken step by step without leaving some folders.
//
// The kernel follows symbolic links wherever they lead, and a name can mean
// another file a moment later. So each part of a path is opened by itself,
// below the folder opened before it and never through a link; links are read
// and their words walked like any others. What lies outside is never asked for:
// the walk goes over words there, until these name a permitted folder again.
// openat2() refuses absolute links that stay inside, and some containers forbid
// it.

#include <cerrno>
#include <span>
#include <string>
#include <vector>

#include <sys/stat.h>

#include "base/file/open_file.h"

namespace lamina {

// A folder in which files may be used.
struct PermittedFolder {
  std::vector<std::string>
      given_parts;                 // of its path as it was given, absolute
  std::vector<std::string> parts;  // of its path without links
  OpenFile file;
};

// What a path leads to.
struct Destination {
  enum class State { kOutside, kMissing, kThere };
  State state = State::kOutside;
  int error = EACCES;       // why it is not there, or is not shown (errno)
  bool has_folder = false;  // missing: what would hold it is there
  OpenFile folder;          // that holds it; none for a permitted folder
  std::string name;         // there; no link
  OpenFile file;            // of what is there; opened as a mere place (O_PATH)
  struct stat status {};    // of what is there
  std::string path;         // without links, as far as it is there
};

// The parts of a path between its slashes.
std::vector<std::string> parts_of(const std::string& path);
// "/" and the parts between slashes.
std::string join_parts(std::span<const std::string> parts);

// `path` as the kernel gets it. A name would end at its first NUL there and
// mean another file than all who judged it saw; so a path with a NUL is the
// empty one, which leads nowhere.
const char* kernel_path(const std::string& path);

// Walks `path`, which begins in the current folder unless it is absolute.
Destination walk(std::span<const PermittedFolder> folders,
                 const std::string& path);

}  // namespace lamina
