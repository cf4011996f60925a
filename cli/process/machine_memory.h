#pragma once
// How much memory there is for this process.
//
// A container's share is not what the machine has: it is the limit of a control
// group, this process's own or one above it, version 1 or 2.

#include <cstdint>
#include <string>

namespace lamina::cli {

// The least limit among the control groups of this process [bytes]; 0: none.
//
// root  stands before /proc and /sys
std::uint64_t control_group_memory(const std::string& root = "");

// The machine's memory, or that limit if it is less [bytes]; 0: unknown.
std::uint64_t machine_memory();

}  // namespace lamina::cli
