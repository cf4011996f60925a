#pragma once
// What the readers and the writers of .goo and .ctb have in common.

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>

namespace lamina::slicer {

// Of the light.
inline constexpr unsigned kFullPower = 255;

inline constexpr std::uint32_t kCtbMagic = 0x12FD0086;   // versions 2 and 3
inline constexpr std::uint32_t kCtbMagic4 = 0x12FD0106;  // version 4
inline constexpr std::uint32_t kCtbMagicEncrypted = 0x12FD0107;

// Masks the data of a layer, counted from 0, or takes the mask off: each byte
// with one of a series of 32 bit numbers, low byte first. Key 0: no mask.
//
// Source: cbiffle/catibo, src/crypto.rs.
inline void mask_ctb_layer(std::uint32_t key, std::uint32_t layer,
                           std::string& bytes) {
  if (key == 0) return;
  const std::uint32_t step = key * 0x2D83CDACU + 0xD8A83423U;
  std::uint32_t word = (layer * 0x1E1530CDU + 0xEC3D47CDU) * step;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<char>(bytes[i] ^ (word >> (8 * (i % 4))));
    if (i % 4 == 3) word += step;
  }
}

// The byte behind the runs of a layer of .goo.
inline char goo_checksum(std::string_view runs) {
  const unsigned sum = std::accumulate(
      runs.begin(), runs.end(), 0U, [](unsigned so_far, char byte) {
        return so_far + static_cast<unsigned char>(byte);
      });
  return static_cast<char>(~sum);
}

}  // namespace lamina::slicer
