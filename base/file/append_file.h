#pragma once
// A file of lines that only grows.
//
// A line gets there by one call of write() on a descriptor that appends, so
// lines of several writers do not mix. If the machine stops meanwhile, the last
// line may be torn; the next one then begins on a line of its own, so that a
// reader has to pass over one line that is not whole.

#include <string>
#include <string_view>
#include <utility>

#include "base/file/file_access.h"
#include "base/file/open_file.h"

namespace lamina {

class AppendFile {
 public:
  // Makes the file where it is not there. Throws FileError where that cannot
  // be, AccessError where it may not.
  static AppendFile open(const std::string& path, const FileAccess& access);

  // For reading what stands there, whole lines and torn ones.
  const OpenFile& file() const { return file_; }

  // line  without '\n'
  // Throws FileError, as does sync(). What is torn then is not a line.
  void append(std::string_view line);

  // Returns when the machine may stop without losing lines.
  void sync();

 private:
  AppendFile(std::string path, OpenFile file, bool is_torn)
      : path_(std::move(path)), file_(std::move(file)), is_torn_(is_torn) {}

  std::string path_;
  OpenFile file_;
  bool is_torn_;  // its last line lacks the end
};

}  // namespace lamina
