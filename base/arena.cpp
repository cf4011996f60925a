#include "base/arena.h"

#include <algorithm>

namespace lamina {

namespace {

// Small designs should stay small; large ones should need few blocks. Blocks
// grow from the first size to the second.
constexpr std::size_t kFirstBlock = std::size_t{1} << 14;
constexpr std::size_t kLargestBlock = std::size_t{1} << 22;

}  // namespace

void* Arena::allocate(std::size_t bytes, std::size_t alignment) {
  std::size_t begin = (used_ + alignment - 1) & ~(alignment - 1);
  if (block_ >= blocks_.size() || begin + bytes > blocks_[block_].size) {
    open_block(bytes);
    begin = 0;
  }
  used_ = begin + bytes;
  return blocks_[block_].memory.get() + begin;
}

void Arena::open_block(std::size_t bytes) {
  // After a release the next block may be there already.
  if (!blocks_.empty()) ++block_;
  if (block_ < blocks_.size() && blocks_[block_].size >= bytes) return;
  const std::size_t last = block_ == 0 ? 0 : blocks_[block_ - 1].size;
  const std::size_t size =
      std::max(bytes, std::clamp(2 * last, kFirstBlock, kLargestBlock));
  const auto place = blocks_.begin() + static_cast<std::ptrdiff_t>(block_);
  // NOLINTNEXTLINE(modernize-make-unique): make_unique would clear the block.
  blocks_.insert(place,
                 {std::unique_ptr<std::byte[]>(new std::byte[size]), size});
}

void Arena::release(Mark mark) {
  block_ = mark.block;
  used_ = mark.used;
}

}  // namespace lamina
