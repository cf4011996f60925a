#pragma once
// What this process takes of memory, as the system counts it.

#include <cstdint>

namespace lamina {

// The memory that this process takes now [bytes]; 0: unknown.
std::uint64_t resident_memory();

// The address space that this process may write to: what limits on data count
// [bytes]; 0: unknown.
std::uint64_t writable_memory();

}  // namespace lamina
