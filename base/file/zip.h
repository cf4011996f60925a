#pragma once
// ZIP archives, which zipped AMF and 3MF files are.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace lamina {

class ZipArchive {
 public:
  // bytes  must stay as long as the archive
  //
  // throws  FormatError where they are no archive
  static ZipArchive open(std::string_view bytes);

  static bool is_zip(std::string_view bytes) {
    return bytes.starts_with("PK\3\4");
  }

  // The names of the entries, folders included, in the order of the directory.
  const std::vector<std::string>& names() const { return names_; }

  // The contents of an entry; nothing where there is none of that name. Case
  // counts.
  //
  // throws  FormatError where the entry is broken, or swells beyond what a
  //         model does: a few bytes may unpack to gigabytes
  std::optional<std::string> read(const std::string& name) const;

 private:
  ZipArchive(std::string_view bytes, std::vector<std::string> names)
      : bytes_(bytes), names_(std::move(names)) {}

  std::string_view bytes_;
  std::vector<std::string> names_;
};

}  // namespace lamina
