#include "base/file/zip.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <minizip/unzip.h>

#include "base/file/format_error.h"
#include "base/text.h"

namespace lamina {
namespace {

// XML of meshes shrinks to about a tenth. What swells further than this is
// made to exhaust memory.
constexpr std::size_t kMostSwelling = 200;
constexpr std::size_t kMostBytes = std::size_t{1} << 31;
constexpr std::size_t kChunk = 1 << 20;

// Bytes in memory, with a place, for minizip to read as a file.
struct Stream {
  std::string_view bytes;
  std::size_t place = 0;
};

Stream& to_stream(voidpf stream) { return *static_cast<Stream*>(stream); }

voidpf open_stream(voidpf opaque, const void*, int) { return opaque; }

uLong read_stream(voidpf, voidpf file, void* buffer, uLong size) {
  Stream& stream = to_stream(file);
  const std::size_t count =
      std::min<std::size_t>(size, stream.bytes.size() - stream.place);
  std::copy_n(stream.bytes.data() + stream.place, count,
              static_cast<char*>(buffer));
  stream.place += count;
  return count;
}

ZPOS64_T tell_stream(voidpf, voidpf file) { return to_stream(file).place; }

long seek_stream(voidpf, voidpf file, ZPOS64_T offset, int origin) {
  Stream& stream = to_stream(file);
  const std::size_t base = origin == ZLIB_FILEFUNC_SEEK_CUR ? stream.place
                           : origin == ZLIB_FILEFUNC_SEEK_END
                               ? stream.bytes.size()
                               : 0;
  if (offset > stream.bytes.size() - base) return -1;
  stream.place = base + offset;
  return 0;
}

int close_stream(voidpf, voidpf) { return 0; }
int test_stream(voidpf, voidpf) { return 0; }

struct Close {
  void operator()(void* archive) const { unzClose(archive); }
};
using Archive = std::unique_ptr<void, Close>;

// stream  must stay as long as the archive
Archive open_archive(Stream& stream) {
  zlib_filefunc64_def functions = {};
  functions.zopen64_file = open_stream;
  functions.zread_file = read_stream;
  functions.ztell64_file = tell_stream;
  functions.zseek64_file = seek_stream;
  functions.zclose_file = close_stream;
  functions.zerror_file = test_stream;
  functions.opaque = &stream;
  Archive archive(unzOpen2_64("", &functions));
  if (!archive) throw FormatError("ZIP archive has no directory");
  return archive;
}

}  // namespace

ZipArchive ZipArchive::open(std::string_view bytes) {
  ZipArchive opened(bytes);
  Stream stream{bytes};
  const Archive archive = open_archive(stream);
  std::vector<char> name(UINT16_MAX);  // as long as any can be
  for (int status = unzGoToFirstFile(archive.get()); status == UNZ_OK;
       status = unzGoToNextFile(archive.get())) {
    unz_file_info64 info = {};
    unz64_file_pos place = {};
    if (unzGetCurrentFileInfo64(archive.get(), &info, name.data(), name.size(),
                                nullptr, 0, nullptr, 0) != UNZ_OK ||
        unzGetFilePos64(archive.get(), &place) != UNZ_OK) {
      throw FormatError("ZIP archive has a broken directory");
    }
    opened.names_.emplace_back(name.data(), info.size_filename);
    opened.places_.try_emplace(
        opened.names_.back(),
        Place{place.pos_in_zip_directory, place.num_of_file});
    opened.unpacked_bytes_ += static_cast<double>(info.uncompressed_size);
  }
  return opened;
}

std::optional<std::string> ZipArchive::read(const std::string& name) const {
  const auto found = places_.find(name);
  if (found == places_.end()) return std::nullopt;
  const auto fail = [&name](std::string_view fault) {
    throw FormatError(
        fmt::format("ZIP entry '{}' {}", on_one_line(name), fault));
  };
  Stream stream{bytes_};
  const Archive archive = open_archive(stream);
  const unz64_file_pos place = {found->second.byte, found->second.number};
  if (unzGoToFilePos64(archive.get(), &place) != UNZ_OK ||
      unzOpenCurrentFile(archive.get()) != UNZ_OK) {
    fail("cannot be unpacked");
  }
  const std::size_t most =
      std::min(kMostBytes, kChunk + kMostSwelling * bytes_.size());
  std::string contents;
  for (int count = 1; count > 0;) {
    const std::size_t size = contents.size();
    contents.resize(size + kChunk);
    count = unzReadCurrentFile(archive.get(), contents.data() + size, kChunk);
    if (count < 0) fail("is broken");
    contents.resize(size + static_cast<std::size_t>(count));
    if (contents.size() > most) fail("is too large");
  }
  if (unzCloseCurrentFile(archive.get()) == UNZ_CRCERROR) fail("is broken");
  return contents;
}

}  // namespace lamina
