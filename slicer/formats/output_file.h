#pragma once
// An output that appears whole or not at all.
//
// Bytes go to a temporary file beside the target, which a rename makes the
// target at the end; whatever ends the run before that leaves nothing behind.
// What cannot be renamed over (standard output, a device, a FIFO) gets its
// bytes at the end from an unnamed temporary file, so that formats whose
// header is known last (SLC) can still be patched. Everything goes through one
// large buffer: writers append small pieces, the kernel sees megabytes.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::slicer {

// The temporary files and folders of a run, so that whoever stops the run can
// remove them. Safe to use from several threads.
class TemporaryFiles {
 public:
  // Removes them all and forbids new ones and renames from now on: for the
  // thread that ends the process after an interrupt.
  void discard_all();

  // A new folder under a hidden name beside `path`, or beside what it links to;
  // empty if it cannot be made (errno tells why).
  std::string make_folder(const std::string& path);
  // A new file of that folder, for writing; null if it cannot be made (errno).
  std::FILE* open_file_in(const std::string& folder, const std::string& name);
  // Puts that folder in the place of `path`, or of what it links to, and
  // removes what stood there. False if it cannot (errno).
  bool commit_folder(const std::string& folder, const std::string& path);
  void discard(const std::string& folder);

 private:
  friend class OutputFile;
  std::mutex mutex_;
  std::vector<std::string> paths_;
};

class OutputFile {
 public:
  // path  "-": standard output
  // Throws FileError if the file cannot be made.
  OutputFile(std::string path, TemporaryFiles& temporary_files);
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
  // Large enough that system calls do not show, small beside a program's 12 MB.
  static constexpr std::size_t kBufferSize = 1 << 18;

  void flush();
  std::string read(std::uint64_t offset, std::size_t size);
  void copy_to(int target);
  void close_file();
  [[noreturn]] void fail(int error) const;

  std::string path_;
  std::string target_path_;     // what is renamed over; empty: nothing is
  std::string temporary_path_;  // empty: unnamed
  TemporaryFiles& temporary_files_;
  int file_ = -1;
  std::unique_ptr<char[]> buffer_;  // kBufferSize bytes
  std::size_t used_ = 0;
  std::uint64_t flushed_ = 0;
};

}  // namespace lamina::slicer
