#pragma once
// ZIP archives, which zipped AMF and 3MF files are.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamina {

class ZipArchive {
 public:
  // bytes  must stay as long as the archive
  //
  // throws  FormatError where they are not an archive
  static ZipArchive open(std::string_view bytes);

  static bool is_zip(std::string_view bytes) {
    return bytes.starts_with("PK\3\4");
  }

  // The names of the entries, folders included, in the order of the directory.
  const std::vector<std::string>& names() const { return names_; }

  // What all entries take unpacked, as the directory says; none unpacks to
  // more.
  double unpacked_bytes() const { return unpacked_bytes_; }

  // As much as one entry may unpack to, and all that are read together should.
  std::size_t most_bytes() const;

  // The contents of an entry; nothing where there is none of that name. Case
  // counts; of equal names the first one does.
  //
  // throws  FormatError where the entry is broken, or swells beyond what a
  //         model does: a few bytes may unpack to gigabytes
  std::optional<std::string> read(const std::string& name) const;

 private:
  // What the directory says of an entry.
  struct Entry {
    std::uint64_t begin = 0;  // of its header
    std::uint64_t packed_bytes = 0;
    std::uint64_t bytes = 0;
    std::uint32_t crc = 0;
    std::uint16_t flags = 0;
    std::uint16_t method = 0;
  };

  explicit ZipArchive(std::string_view bytes) : bytes_(bytes) {}

  std::string_view bytes_;
  std::vector<std::string> names_;
  std::map<std::string, Entry> entries_;
  double unpacked_bytes_ = 0;
};

}  // namespace lamina
