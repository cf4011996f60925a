#pragma once
// Packs bytes that come in runs (stretches of equal bytes), as the rows of a
// layer's image do, into a zlib stream.
//
// An image of millions of bytes is some thousands of runs. zlib looks at every
// byte, which took hundreds of times as long as making the layers; here the
// codes of a run and its part in the checksum follow from its length. The
// stream is blocks of many runs, each in the Huffman code that suits them best
// (RFC 1950, RFC 1951); files are smaller than zlib's.

#include <cstdint>
#include <string>
#include <vector>

namespace lamina::slicer {

class RunDeflater {
 public:
  RunDeflater();  // begins the stream

  // Appends `count` bytes of that value.
  void add(std::uint8_t value, std::uint64_t count);

  // Ends the stream and returns it; nothing may be added then.
  std::string finish();

 private:
  struct Run {
    std::uint64_t value : 8;
    std::uint64_t count : 56;
  };

  void end_run();
  void write_block(bool is_last);
  void put(std::uint64_t bits, int count);

  std::string bytes_;
  std::vector<Run> runs_;   // of the block that is not written yet
  std::uint64_t bits_ = 0;  // not yet in bytes_, the first one lowest
  int bit_count_ = 0;       // below 32
  std::uint8_t value_ = 0;  // of the run that goes on
  std::uint64_t count_ = 0;
  std::uint64_t sum_ = 1;  // the two of Adler-32
  std::uint64_t sum_of_sums_ = 0;
};

}  // namespace lamina::slicer
