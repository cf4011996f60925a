#pragma once
// Fingerprints: bytes known again by a few of their own.
//
// A batch has a million names of outputs, and the files that it reads may be
// large. What is only asked whether it is the same keeps a fingerprint. They
// are those of XXH3 (Yann Collet's xxHash): made to be fast and evenly spread,
// not to withstand people who look for two texts with one fingerprint.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lamina {

// Among n texts two have the same one with a likelihood of n² / 2^65: 3e-8 for
// a million.
std::uint64_t fingerprint(std::string_view bytes);

// 128 bits in 32 hexadecimal digits: for what is never compared in full.
std::string digest(std::string_view bytes);

// The digest of bytes that come in blocks.
//
// next  the next block, which is empty behind the last one
std::string digest(const std::function<std::string_view()>& next);

// A set of fingerprints in 8 to 16 bytes each; the nodes of std::set take 48.
class FingerprintSet {
 public:
  // Returns false where it was there.
  bool insert(std::uint64_t value);
  bool contains(std::uint64_t value) const;
  void erase(std::uint64_t value);
  std::size_t size() const { return size_; }

 private:
  // Slots are a power of two; a value stands at the first free slot from its
  // own on.
  std::size_t slot_of(std::uint64_t value) const;
  void grow();

  std::vector<std::uint64_t> slots_;
  std::size_t size_ = 0;
};

}  // namespace lamina
