#include "csg/eval/value/memory.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <new>

#include <sanitizer/asan_interface.h>
#include <sys/mman.h>

namespace lamina::csg {

namespace {

constexpr std::size_t kStep = 16;
constexpr std::size_t kLargestSmall = 256;
constexpr std::size_t kClasses = kLargestSmall / kStep + 1;

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kFirstChunk = std::size_t{16} << 10;

struct FreeBlock {
  FreeBlock* next;
};

struct Chunk {
  Chunk* next;
  std::size_t size;
};
static_assert(sizeof(Chunk) == kStep);

struct Pool {
  FreeBlock* free[kClasses];
  char* begin;  // of what no block has used yet
  char* end;
  Chunk* chunks;
  std::size_t chunk_size;
  std::size_t live;
};
// Trivial, so that reaching it costs no more than a global variable.
constinit thread_local Pool pool = {};

// --- Blocks of huge pages: mapped one by one ---------------------------------

std::size_t mapped_bytes(std::size_t bytes) {
  return (bytes + kHugePage - 1) / kHugePage * kHugePage;
}

// A block of the kernel, moved by remapping its pages.
void* map_block(void* block, std::size_t old_bytes, std::size_t bytes) {
  const std::size_t old_size = mapped_bytes(old_bytes);
  const std::size_t size = mapped_bytes(bytes);
  if (size < bytes) throw std::bad_alloc();
  if (size == old_size) return block;
  void* memory = block == nullptr
                     ? ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)
                     : ::mremap(block, old_size, size, MREMAP_MAYMOVE);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  // A wish: where the kernel has no huge pages, all goes on without.
  if (size > old_size) ::madvise(memory, size, MADV_HUGEPAGE);
  return memory;
}

void unmap_block(void* block, std::size_t bytes) {
  ::munmap(block, mapped_bytes(bytes));
}

// --- Small blocks -----------------------------------------------------------

// AddressSanitizer is told which memory of a chunk no block uses; otherwise
// the macros do nothing.

std::size_t class_of(std::size_t bytes) { return (bytes + kStep - 1) / kStep; }

void add_chunk() {
  const std::size_t size =
      std::clamp(pool.chunk_size * 2, kFirstChunk, kHugePage);
  void* memory = allocate_block(size);
  pool.chunks = new (memory) Chunk{pool.chunks, size};
  pool.chunk_size = size;
  pool.begin = static_cast<char*>(memory) + sizeof(Chunk);
  pool.end = static_cast<char*>(memory) + size;
  ASAN_POISON_MEMORY_REGION(pool.begin, size - sizeof(Chunk));
}

[[gnu::noinline]] void* carve_block(std::size_t bytes) {
  if (static_cast<std::size_t>(pool.end - pool.begin) < bytes) add_chunk();
  void* block = pool.begin;
  pool.begin += bytes;
  ASAN_UNPOISON_MEMORY_REGION(block, bytes);
  return block;
}

[[gnu::noinline]] void give_back_chunks() {
  while (pool.chunks != nullptr) {
    Chunk* chunk = pool.chunks;
    pool.chunks = chunk->next;
    ASAN_UNPOISON_MEMORY_REGION(chunk, chunk->size);
    free_block(chunk, chunk->size);
  }
  pool = {};
}

// --- All sizes --------------------------------------------------------------

enum class Kind { kSmall, kMedium, kMapped };  // of malloc: kMedium

Kind kind_of(std::size_t bytes) {
  if (bytes <= kLargestSmall) return Kind::kSmall;
  return bytes < kHugePage ? Kind::kMedium : Kind::kMapped;
}

[[gnu::noinline]] void* resize_large(void* block, std::size_t old_bytes,
                                     std::size_t bytes, Kind kind) {
  if (kind == Kind::kMapped) return map_block(block, old_bytes, bytes);
  void* memory = std::realloc(block, bytes);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

[[gnu::noinline]] void free_large(void* block, std::size_t bytes) {
  if (kind_of(bytes) == Kind::kMapped) {
    unmap_block(block, bytes);
  } else {
    std::free(block);
  }
}

}  // namespace

void* allocate_block(std::size_t bytes) {
  if (bytes > kLargestSmall) {
    return resize_large(nullptr, 0, bytes, kind_of(bytes));
  }
  const std::size_t c = class_of(bytes);
  ++pool.live;
  FreeBlock* block = pool.free[c];
  if (block == nullptr) return carve_block(c * kStep);
  ASAN_UNPOISON_MEMORY_REGION(block, c * kStep);
  pool.free[c] = block->next;
  return block;
}

void* resize_block(void* block, std::size_t old_bytes, std::size_t bytes) {
  const Kind kind = kind_of(bytes);
  if (kind == kind_of(old_bytes)) {
    if (kind != Kind::kSmall) {
      return resize_large(block, old_bytes, bytes, kind);
    }
    if (class_of(old_bytes) == class_of(bytes)) return block;
  }
  void* moved = allocate_block(bytes);
  std::memcpy(moved, block, std::min(old_bytes, bytes));
  free_block(block, old_bytes);
  return moved;
}

void free_block(void* block, std::size_t bytes) noexcept {
  if (bytes > kLargestSmall) {
    free_large(block, bytes);
    return;
  }
  const std::size_t c = class_of(bytes);
  pool.free[c] = new (block) FreeBlock{pool.free[c]};
  ASAN_POISON_MEMORY_REGION(block, c * kStep);
  if (--pool.live == 0) give_back_chunks();
}

}  // namespace lamina::csg
