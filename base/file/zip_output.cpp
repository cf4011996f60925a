#include "base/file/zip_output.h"

#include <cstdint>
#include <cstring>
#include <new>

#include <minizip/zip.h>
#include <zlib.h>

#include "base/diagnostic.h"

namespace lamina {
namespace {

// What pack() puts before the packed bytes.
struct PackedHead {
  std::uint64_t size = 0;  // unpacked
  std::uint32_t crc = 0;
};

ZipOutput::Stream& to_stream(voidpf stream) {
  return *static_cast<ZipOutput::Stream*>(stream);
}

voidpf open_stream(voidpf opaque, const void*, int) { return opaque; }

// The library only reads archives that it adds to.
uLong read_stream(voidpf, voidpf, void*, uLong) { return 0; }

uLong write_stream(voidpf, voidpf file, const void* buffer, uLong size) {
  ZipOutput::Stream& stream = to_stream(file);
  const std::string_view bytes(static_cast<const char*>(buffer), size);
  try {
    if (stream.place == stream.output.size()) {
      stream.output.write(bytes);
    } else {
      stream.output.patch(stream.place, bytes);
    }
  } catch (...) {
    stream.fault = std::current_exception();
    return 0;
  }
  stream.place += size;
  return size;
}

ZPOS64_T tell_stream(voidpf, voidpf file) { return to_stream(file).place; }

long seek_stream(voidpf, voidpf file, ZPOS64_T offset, int origin) {
  ZipOutput::Stream& stream = to_stream(file);
  const std::uint64_t base = origin == ZLIB_FILEFUNC_SEEK_CUR ? stream.place
                             : origin == ZLIB_FILEFUNC_SEEK_END
                                 ? stream.output.size()
                                 : 0;
  stream.place = base + offset;
  return 0;
}

int close_stream(voidpf, voidpf) { return 0; }

int test_stream(voidpf, voidpf file) {
  return to_stream(file).fault == nullptr ? 0 : -1;
}

}  // namespace

ZipOutput::ZipOutput(OutputFile& output) : stream_{output, 0, nullptr} {
  zlib_filefunc64_def functions = {};
  functions.zopen64_file = open_stream;
  functions.zread_file = read_stream;
  functions.zwrite_file = write_stream;
  functions.ztell64_file = tell_stream;
  functions.zseek64_file = seek_stream;
  functions.zclose_file = close_stream;
  functions.zerror_file = test_stream;
  functions.opaque = &stream_;
  archive_ = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
  check(archive_ == nullptr ? ZIP_INTERNALERROR : ZIP_OK);
}

ZipOutput::~ZipOutput() {
  if (archive_ != nullptr) zipClose(archive_, nullptr);
}

std::string ZipOutput::pack(std::string_view bytes) {
  // What is packed here are images, which are packed themselves. Where they are
  // small they still repeat themselves; large ones have runs at most, and the
  // search for more would take as long as drawing them.
  constexpr std::size_t kSmall = 1 << 16;
  const int strategy = bytes.size() <= kSmall ? Z_DEFAULT_STRATEGY : Z_RLE;
  z_stream stream = {};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, -MAX_WBITS,
                   MAX_MEM_LEVEL, strategy) != Z_OK) {
    throw std::bad_alloc();
  }
  PackedHead head;
  head.size = bytes.size();
  head.crc = static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
  const auto size = static_cast<uInt>(bytes.size());
  std::string packed(sizeof(head) + deflateBound(&stream, size), '\0');
  std::memcpy(packed.data(), &head, sizeof(head));
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = size;
  stream.next_out = reinterpret_cast<Bytef*>(packed.data() + sizeof(head));
  stream.avail_out = static_cast<uInt>(packed.size() - sizeof(head));
  deflate(&stream, Z_FINISH);
  packed.resize(sizeof(head) + stream.total_out);
  deflateEnd(&stream);
  return packed;
}

void ZipOutput::add_packed(const std::string& name, std::string_view packed) {
  PackedHead head;
  std::memcpy(&head, packed.data(), sizeof(head));
  begin(name, true);
  write(packed.substr(sizeof(head)));
  check(zipCloseFileInZipRaw64(archive_, head.size, head.crc));
}

void ZipOutput::add_text(const std::string& name, std::string_view bytes) {
  begin_text(name);
  write(bytes);
  end_entry();
}

void ZipOutput::begin_text(const std::string& name) { begin(name, false); }

void ZipOutput::begin(const std::string& name, bool is_packed) {
  zip_fileinfo info = {};
  info.tmz_date.tm_year = 1980;
  info.tmz_date.tm_mday = 1;
  constexpr uLong kNamesAreUtf8 = 1 << 11;  // a flag of the entry
  check(zipOpenNewFileInZip4(archive_, name.c_str(), &info, nullptr, 0, nullptr,
                             0, nullptr, Z_DEFLATED, Z_DEFAULT_COMPRESSION,
                             is_packed ? 1 : 0, -MAX_WBITS, DEF_MEM_LEVEL,
                             Z_DEFAULT_STRATEGY, nullptr, 0, 0, kNamesAreUtf8));
}

void ZipOutput::write(std::string_view bytes) {
  check(zipWriteInFileInZip(archive_, bytes.data(),
                            static_cast<unsigned>(bytes.size())));
}

void ZipOutput::end_entry() { check(zipCloseFileInZip(archive_)); }

void ZipOutput::finish() {
  const int status = zipClose(archive_, nullptr);
  archive_ = nullptr;
  check(status);
}

void ZipOutput::check(int status) {
  if (stream_.fault != nullptr) std::rethrow_exception(stream_.fault);
  if (status == ZIP_OK) return;
  throw FileError("Can't write '" + stream_.output.path() + "' as ZIP archive");
}

}  // namespace lamina
