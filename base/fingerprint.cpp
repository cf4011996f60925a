#include "base/fingerprint.h"

#include <fmt/format.h>

// The few functions that are used become part of this file: a library to load
// would cost every start.
// NOLINTNEXTLINE(readability-identifier-naming) ; the library's word
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace lamina {
namespace {

constexpr std::uint64_t kFree = 0;

std::string text_of(const XXH128_hash_t& hash) {
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

// No value is the mark of a free slot.
std::uint64_t marked(std::uint64_t value) { return value == kFree ? 1 : value; }

}  // namespace

std::uint64_t fingerprint(std::string_view bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

std::string digest(std::string_view bytes) {
  return text_of(XXH3_128bits(bytes.data(), bytes.size()));
}

std::string digest(const std::function<std::string_view()>& next) {
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  for (std::string_view block = next(); !block.empty(); block = next()) {
    XXH3_128bits_update(&state, block.data(), block.size());
  }
  return text_of(XXH3_128bits_digest(&state));
}

// The slot of `value`, or the free one where it would stand.
std::size_t FingerprintSet::slot_of(std::uint64_t value) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = value & mask;
  while (slots_[slot] != kFree && slots_[slot] != value) {
    slot = (slot + 1) & mask;
  }
  return slot;
}

bool FingerprintSet::insert(std::uint64_t value) {
  value = marked(value);
  // At most three quarters are taken.
  if (4 * (size_ + 1) > 3 * slots_.size()) grow();
  std::uint64_t& slot = slots_[slot_of(value)];
  if (slot == value) return false;
  slot = value;
  ++size_;
  return true;
}

bool FingerprintSet::contains(std::uint64_t value) const {
  return size_ > 0 && slots_[slot_of(marked(value))] != kFree;
}

void FingerprintSet::erase(std::uint64_t value) {
  if (!contains(value)) return;
  const std::size_t mask = slots_.size() - 1;
  std::size_t free = slot_of(marked(value));
  slots_[free] = kFree;
  --size_;
  // Move up what stands behind it and belongs at or before the free slot
  // (Knuth, The Art of Computer Programming 3, 6.4, algorithm R).
  for (std::size_t slot = (free + 1) & mask; slots_[slot] != kFree;
       slot = (slot + 1) & mask) {
    const std::size_t own = slots_[slot] & mask;
    if (((slot - own) & mask) < ((slot - free) & mask)) continue;
    slots_[free] = slots_[slot];
    slots_[slot] = kFree;
    free = slot;
  }
}

void FingerprintSet::grow() {
  constexpr std::size_t kFewest = 16;
  std::vector<std::uint64_t> old(slots_.empty() ? kFewest : 2 * slots_.size());
  old.swap(slots_);
  for (const std::uint64_t value : old) {
    if (value != kFree) slots_[slot_of(value)] = value;
  }
}

}  // namespace lamina
