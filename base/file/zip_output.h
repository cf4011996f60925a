#pragma once
// Writes a ZIP archive, entry by entry, into an output file.
//
// Entries have no date (ZIP's first, 1 January 1980), so that the same design
// gives the same bytes.

#include <cstdint>
#include <exception>
#include <string>
#include <string_view>

#include "base/file/output_file.h"

namespace lamina {

class ZipOutput {
 public:
  // `output` must be empty and outlive the archive.
  explicit ZipOutput(OutputFile& output);
  ~ZipOutput();
  ZipOutput(const ZipOutput&) = delete;
  ZipOutput& operator=(const ZipOutput&) = delete;

  // Adds an entry. Throws FileError.
  void add_text(const std::string& name, std::string_view bytes);

  // Add an entry in two steps, the first of which several threads may take at
  // once: it packs the bytes. The second adds what came of them.
  static std::string pack(std::string_view bytes);
  void add_packed(const std::string& name, std::string_view packed);

  // Write a text in several parts, below 4 GB in all. Throw FileError.
  void begin_text(const std::string& name);
  void write(std::string_view bytes);
  void end_entry();

  // Writes the directory; nothing may be added then. Throws FileError.
  void finish();

  // What the library that makes the archive writes to: an output and a place in
  // it.
  struct Stream {
    OutputFile& output;
    std::uint64_t place = 0;
    std::exception_ptr fault;  // of the output: none may pass through C
  };

 private:
  void begin(const std::string& name, bool is_packed);
  void check(int status);

  Stream stream_;
  void* archive_ = nullptr;
};

}  // namespace lamina
