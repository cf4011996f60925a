// Reading archives, as APPNOTE 6.3.10 of PKWARE describes them: the directory
// at the end says where everything is, in 64 bits where 32 are too few.

#include "base/file/zip.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <span>

#include <fmt/format.h>
#include <zlib.h>

#include "base/file/format_error.h"
#include "base/text.h"

namespace lamina {
namespace {

// XML of meshes shrinks to about a tenth. What swells further than this is
// made to exhaust memory.
constexpr std::size_t kMostSwelling = 200;
constexpr std::size_t kMostBytes = std::size_t{1} << 31;
constexpr std::size_t kChunk = 1 << 20;

constexpr std::string_view kEntryMark = "PK\3\4";
constexpr std::string_view kDirectoryMark = "PK\1\2";
constexpr std::string_view kEndMark = "PK\5\6";
constexpr std::string_view kWideEndMark = "PK\6\6";
constexpr std::string_view kWideEndPlaceMark = "PK\6\7";

// What a number of 16 or 32 bits is that stands elsewhere in 64.
constexpr std::uint64_t kElsewhere16 = 0xffff;
constexpr std::uint64_t kElsewhere32 = 0xffffffff;

constexpr std::size_t kEndBytes = 22;
constexpr std::size_t kWideEndPlaceBytes = 20;
constexpr std::size_t kDirectoryBytes = 46;  // of an entry, before its name
constexpr std::size_t kEntryBytes = 30;

// A part of the archive from a mark on, whose numbers stand at fixed places.
class Record {
 public:
  // throws  FormatError where the bytes have no such part there
  Record(std::string_view bytes, std::uint64_t begin, std::string_view mark,
         std::size_t size) {
    if (begin > bytes.size() || bytes.size() - begin < size ||
        !bytes.substr(begin).starts_with(mark)) {
      throw FormatError("ZIP archive has a broken directory");
    }
    bytes_ = bytes.substr(begin);
  }

  std::uint64_t number(std::size_t at, std::size_t bytes) const {
    std::uint64_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) {
      value = value << 8 | static_cast<unsigned char>(bytes_[at + i]);
    }
    return value;
  }
  std::uint64_t number16(std::size_t at) const { return number(at, 2); }
  std::uint64_t number32(std::size_t at) const { return number(at, 4); }
  std::uint64_t number64(std::size_t at) const { return number(at, 8); }

  // throws  FormatError where it ends before
  std::string_view text(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || bytes_.size() - at < size) {
      throw FormatError("ZIP archive has a broken directory");
    }
    return bytes_.substr(at, size);
  }

 private:
  std::string_view bytes_;
};

struct Directory {
  std::uint64_t count = 0;
  std::uint64_t begin = 0;
  // By how much all is behind the place that the archive says, as in one that
  // stands behind other bytes.
  std::uint64_t shift = 0;
};

Directory find_directory(std::string_view bytes) {
  const std::size_t end = bytes.rfind(kEndMark);
  if (end == std::string_view::npos || bytes.size() - end < kEndBytes) {
    throw FormatError(bytes.starts_with("PK")
                          ? "ZIP archive is cut off: it has no directory"
                          : "not a ZIP archive");
  }
  const Record record(bytes, end, kEndMark, kEndBytes);
  std::uint64_t count = record.number16(10);
  std::uint64_t size = record.number32(12);
  std::uint64_t stated = record.number32(16);
  std::uint64_t behind = end;  // what follows the directory
  if (count == kElsewhere16 || size == kElsewhere32 || stated == kElsewhere32) {
    const Record place(bytes, end - std::min(end, kWideEndPlaceBytes),
                       kWideEndPlaceMark, kWideEndPlaceBytes);
    behind = place.number64(8);
    const Record wide(bytes, behind, kWideEndMark, 56);
    count = wide.number64(32);
    size = wide.number64(40);
    stated = wide.number64(48);
  }
  if (size > behind || stated > behind - size) {
    throw FormatError("ZIP archive has a broken directory");
  }
  return {count, behind - size, behind - size - stated};
}

// Puts sizes and place of an entry right that stand in its field of 64 bits:
// one after the other, those alone that stand there.
void widen(std::string_view extra, std::span<std::uint64_t> numbers) {
  constexpr std::uint64_t kWideNumbers = 1;
  while (extra.size() >= 4) {
    const Record field(extra, 0, "", 4);
    const std::uint64_t kind = field.number16(0);
    std::string_view rest = field.text(4, field.number16(2));
    extra.remove_prefix(4 + rest.size());
    if (kind != kWideNumbers) continue;
    for (std::uint64_t& number : numbers) {
      if (number != kElsewhere32) continue;
      number = Record(rest, 0, "", 8).number64(0);
      rest.remove_prefix(8);
    }
  }
}

class Inflater {
 public:
  Inflater() {
    if (inflateInit2(&stream_, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  // What Deflate has packed, as far as `most` bytes; nothing where it is
  // broken.
  std::optional<std::string> unpack(std::string_view packed, std::size_t most) {
    std::string contents;
    for (int status = Z_OK; status != Z_STREAM_END;) {
      // zlib counts in 32 bits.
      if (stream_.avail_in == 0) {
        const std::string_view next = packed.substr(0, kChunk);
        packed.remove_prefix(next.size());
        stream_.next_in =
            reinterpret_cast<Bytef*>(const_cast<char*>(next.data()));
        stream_.avail_in = static_cast<uInt>(next.size());
      }
      const std::size_t size = contents.size();
      contents.resize(size + kChunk);
      stream_.next_out = reinterpret_cast<Bytef*>(contents.data() + size);
      stream_.avail_out = static_cast<uInt>(kChunk);
      status = inflate(&stream_, Z_NO_FLUSH);
      contents.resize(contents.size() - stream_.avail_out);
      if (contents.size() > most) return contents;
      if (status != Z_OK && status != Z_STREAM_END) return std::nullopt;
    }
    return contents;
  }

 private:
  z_stream stream_ = {};
};

}  // namespace

ZipArchive ZipArchive::open(std::string_view bytes) {
  ZipArchive opened(bytes);
  const Directory directory = find_directory(bytes);
  std::uint64_t at = directory.begin;
  for (std::uint64_t i = 0; i < directory.count; ++i) {
    const Record record(bytes, at, kDirectoryMark, kDirectoryBytes);
    const std::size_t name_bytes = record.number16(28);
    const std::size_t extra_bytes = record.number16(30);
    std::array numbers = {record.number32(24), record.number32(20),
                          record.number32(42)};
    widen(record.text(kDirectoryBytes + name_bytes, extra_bytes), numbers);
    Entry entry;
    entry.flags = static_cast<std::uint16_t>(record.number16(8));
    entry.method = static_cast<std::uint16_t>(record.number16(10));
    entry.crc = static_cast<std::uint32_t>(record.number32(16));
    entry.packed_bytes = numbers[1];
    entry.bytes = numbers[0];
    entry.begin = numbers[2] + directory.shift;
    opened.names_.emplace_back(record.text(kDirectoryBytes, name_bytes));
    opened.entries_.try_emplace(opened.names_.back(), entry);
    opened.unpacked_bytes_ += static_cast<double>(numbers[0]);
    at += kDirectoryBytes + name_bytes + extra_bytes + record.number16(32);
  }
  return opened;
}

std::size_t ZipArchive::most_bytes() const {
  return std::min(kMostBytes, kChunk + kMostSwelling * bytes_.size());
}

std::optional<std::string> ZipArchive::read(const std::string& name) const {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return std::nullopt;
  const Entry& entry = found->second;
  const auto fail = [&name](std::string_view fault) {
    throw FormatError(
        fmt::format("ZIP entry '{}' {}", on_one_line(name), fault));
  };
  constexpr std::uint16_t kIsEncrypted = 1;
  if ((entry.flags & kIsEncrypted) != 0) fail("is encrypted");
  constexpr std::uint16_t kStored = 0;
  constexpr std::uint16_t kDeflated = 8;
  if (entry.method != kStored && entry.method != kDeflated) {
    fail(fmt::format("is packed by method {}: expected Deflate", entry.method));
  }
  const Record header(bytes_, entry.begin, kEntryMark, kEntryBytes);
  const std::uint64_t begin =
      entry.begin + kEntryBytes + header.number16(26) + header.number16(28);
  if (begin > bytes_.size() || bytes_.size() - begin < entry.packed_bytes) {
    fail("is broken");
  }
  const std::string_view packed = bytes_.substr(begin, entry.packed_bytes);
  const std::size_t most = most_bytes();
  std::optional<std::string> contents;
  if (entry.method == kStored) {
    contents = std::string(packed);
  } else {
    contents = Inflater().unpack(
        packed, std::min(most, static_cast<std::size_t>(entry.bytes)));
  }
  if (!contents) fail("is broken");
  if (contents->size() > most) fail("is too large");
  const auto crc = crc32_z(0, reinterpret_cast<const Bytef*>(contents->data()),
                           contents->size());
  if (crc != entry.crc || contents->size() != entry.bytes) fail("is broken");
  return contents;
}

}  // namespace lamina
