#pragma once
// A second line of defence behind FileAccess: the kernel, where it has Landlock
// (Linux 5.13 and later).
//
// From then on this process can read only in the folders that it may use and in
// those that it needs itself: shared libraries, Fontconfig's configuration,
// what /proc and /sys say about it and the machine. It writes in the root
// alone. So a fault in lamina, or in a library that reads a stranger's file,
// reaches no further. Landlock does not hide whether a file exists; FileAccess
// does.

#include "base/file/file_access.h"

namespace lamina::cli {

// The version of Landlock that the kernel offers, from 1 up; less than 1 where
// it offers none.
long landlock_version();

// Restricts this process, for good, to what `access` allows. To be called while
// it has one thread. Does nothing where `access` allows all files, or where the
// kernel does not offer it.
void restrict_process(const FileAccess& access);

}  // namespace lamina::cli
