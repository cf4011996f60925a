#pragma once
// Memory for values.
//
// A design makes values by the million, most of them short strings and vectors
// of two or three numbers that die soon. malloc would cost as much as running
// the code around it, and fresh pages as much again. So small blocks come from
// chunks, by size in steps of 16 bytes, and a freed block is the next of its
// size to be given out; large blocks and chunks ask the kernel for huge pages.
// Measured on bench/scenes/lang/listcomp.scad: a third less processor time.
//
// Each thread has a pool; a value is freed on the thread that made it. With its
// last block a pool gives back all its chunks, for what comes after.

#include <cstddef>

namespace lamina::csg {

// Throws std::bad_alloc where memory ends.
void* allocate_block(std::size_t bytes);

// Makes a block of `old_bytes` one of `bytes`; what is in it may move.
void* resize_block(void* block, std::size_t old_bytes, std::size_t bytes);

// bytes: as given when the block was allocated or resized last.
void free_block(void* block, std::size_t bytes) noexcept;

}  // namespace lamina::csg
