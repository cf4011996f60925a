#pragma once
// A folder of files that appears whole or not at all.
//
// It is filled under a hidden name beside the target and put in its place at
// the end. A folder that stands there is replaced if lamina made all that it
// holds: the file of contents, and what that one names.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/file/temporary_files.h"

namespace lamina {

class OutputFolder {
 public:
  // contents  name of the file that lists what the folder holds: in quotes, the
  //           names of its files and a word that begins with "lamina "
  //
  // Throws FileError if the folder cannot be made, or if what stands there may
  // not be replaced.
  static OutputFolder open(std::string path, std::string contents,
                           TemporaryFiles& temporary_files);
  ~OutputFolder();  // discards what was not committed
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Both throw FileError.
  void add(const std::string& name, std::string_view bytes);
  void commit();

  // Bytes so far.
  std::uint64_t size() const { return size_; }

 private:
  OutputFolder(std::string path, std::string contents,
               TemporaryFiles& temporary_files,
               TemporaryFiles::Folder temporary)
      : path_(std::move(path)),
        contents_(std::move(contents)),
        temporary_files_(temporary_files),
        temporary_(std::move(temporary)) {}

  std::string path_;
  std::string contents_;
  TemporaryFiles& temporary_files_;
  TemporaryFiles::Folder temporary_;
  std::uint64_t size_ = 0;
};

}  // namespace lamina
