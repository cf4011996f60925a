#pragma once
// An output that appears whole or not at all.
//
// Bytes go to a temporary file (temporary_files.h), which takes the target's
// name at the end. What cannot be renamed over (standard output, a device, a
// FIFO) gets its bytes at the end from an unnamed one, so that formats whose
// header is known last (SLC) can still be patched. Everything goes through one
// large buffer.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/file/temporary_files.h"

namespace lamina {

// Throws for what write_all() returned; "-" is standard output.
[[noreturn]] void fail_to_write(const std::string& path, int error);

class OutputFile {
 public:
  // path  "-": standard output
  // Throws FileError if the file cannot be made, AccessError if it may not be.
  static OutputFile open(std::string path, TemporaryFiles& temporary_files);
  ~OutputFile();  // discards what was not committed
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  const std::string& path() const { return path_; }

  // Room for `size` bytes (at most kLargestPiece) at the end of the output;
  // `advance` then says how many of them were written.
  char* reserve(std::size_t size) {
    if (kBufferSize - used_ < size) flush();
    return buffer_.get() + used_;
  }
  void advance(std::size_t size) { used_ += size; }
  static constexpr std::size_t kLargestPiece = 1 << 16;

  // Throws FileError, as do all that follow.
  void write(std::string_view bytes);

  // Replaces bytes written before.
  void patch(std::uint64_t offset, std::string_view bytes);

  // Puts bytes between bytes written before. Cost: all that stand behind them
  // are moved.
  void insert(std::uint64_t offset, std::string_view bytes);

  // Makes the output visible under its name.
  void commit();

  // Bytes so far.
  std::uint64_t size() const { return flushed_ + used_; }

 private:
  // So large that system calls do not show.
  static constexpr std::size_t kBufferSize = 1 << 18;

  OutputFile(std::string path, OutputPlace place,
             TemporaryFiles& temporary_files, TemporaryFiles::File temporary,
             std::unique_ptr<char[]> buffer)
      : path_(std::move(path)),
        place_(std::move(place)),
        temporary_files_(temporary_files),
        temporary_(std::move(temporary)),
        buffer_(std::move(buffer)) {}

  void flush();
  std::string read(std::uint64_t offset, std::size_t size);

  std::string path_;
  OutputPlace place_;  // what is replaced; no path: nothing is
  TemporaryFiles& temporary_files_;
  TemporaryFiles::File temporary_;
  std::unique_ptr<char[]> buffer_;  // kBufferSize bytes
  std::size_t used_ = 0;
  std::uint64_t flushed_ = 0;
};

}  // namespace lamina
