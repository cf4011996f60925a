#pragma once
// Links that others put where an output is expected.
//
// In a folder such as /tmp, which all may write to, anyone can make a link
// before a run does, from ring.slc to a file of the one who runs it. The kernel
// does not follow such a link where fs.protected_symlinks is set, but a program
// that resolves names itself passes that by. So the kernel's rule is kept here:
// in a sticky folder that all may write to, links count that are the user's own
// or the folder's owner's. It holds for links to folders as well.

#include <optional>
#include <string>

#include <sys/stat.h>

namespace lamina {

// As many links as the kernel follows on the way of a path.
constexpr int kMostLinks = 40;

// Whether the rule forbids to follow a link in that folder.
bool is_planted(const struct stat& link, const struct stat& folder);

// Whether the kernel's rules fs.protected_regular and fs.protected_fifos forbid
// to use the file at `path`: nothing is added to it, and an output in its place
// takes nothing of it.
bool is_planted_at(const std::string& path, const struct stat& file);

// The first planted link on the way of a path, if there is one.
std::optional<std::string> find_planted_link(const std::string& path);

}  // namespace lamina
