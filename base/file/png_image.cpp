// libpng reports faults by longjmp, so the function that calls it has nothing
// to destroy.
#include "base/file/png_image.h"

#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

#include <png.h>

#include "base/file/format_error.h"

namespace lamina {
namespace {

struct Image : PngImage {
  std::string_view bytes;  // not yet read
  PngChannels wanted = PngChannels::kRgba;
  const CheckPngSize* check_size = nullptr;
  std::string fault;
  bool lacks_memory = false;
};

void read_bytes(png_structp png, png_bytep data, std::size_t size) {
  Image& image = *static_cast<Image*>(png_get_io_ptr(png));
  if (image.bytes.size() < size) png_error(png, "the file is cut off");
  std::memcpy(data, image.bytes.data(), size);
  image.bytes.remove_prefix(size);
}

void keep_fault(png_structp png, png_const_charp message) {
  static_cast<Image*>(png_get_error_ptr(png))->fault = message;
  png_longjmp(png, 1);
}
void ignore_warning(png_structp, png_const_charp) {}

// libpng reports a lack of memory in many words, and passes over some.
png_voidp allocate(png_structp png, png_alloc_size_t size) {
  void* memory = std::malloc(size);
  if (memory == nullptr) {
    static_cast<Image*>(png_get_mem_ptr(png))->lacks_memory = true;
  }
  return memory;
}
void deallocate(png_structp, png_voidp memory) { std::free(memory); }

// Asks for 8 bits of red, green, blue and alpha, without gamma correction.
void ask_for_rgba(png_structp png) {
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_gray_to_rgb(png);
  png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
}

// Asks for 8 bits of grey, or of red, green and blue.
void ask_for_stored(png_structp png) {
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_strip_alpha(png);
}

// What libpng keeps while it reads.
struct Reader {
  explicit Reader(Image& image)
      : png(png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &image, keep_fault,
                                     ignore_warning, &image, allocate,
                                     deallocate)),
        info(png == nullptr ? nullptr : png_create_info_struct(png)) {}
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  png_structp png;
  png_infop info;
};

// Returns false where it failed; image.fault says why.
//
// throws  what the check of the size does
bool decode(png_structp png, png_infop info, Image& image) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, &image, read_bytes);
  // For the rest (texts, profiles) libpng would allocate as much memory as the
  // length says, before it sees that the file is shorter.
  constexpr int kAllButThePicture = -1;
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr,
                              kAllButThePicture);
  png_read_info(png, info);
  image.columns = png_get_image_width(png, info);
  image.rows = png_get_image_height(png, info);
  (*image.check_size)(image.columns, image.rows);
  if (image.wanted == PngChannels::kRgba) {
    ask_for_rgba(png);
  } else {
    ask_for_stored(png);
  }
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  image.channels = png_get_channels(png, info);
  const std::size_t stride = png_get_rowbytes(png, info);
  image.pixels.resize(stride * image.rows);
  // In an interlaced image every pass goes over all rows.
  const int passes = png_get_interlace_type(png, info) == PNG_INTERLACE_NONE
                         ? 1
                         : PNG_INTERLACE_ADAM7_PASSES;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t row = 0; row < image.rows; ++row) {
      png_read_row(png, image.pixels.data() + row * stride, nullptr);
    }
  }
  png_read_end(png, nullptr);
  return true;
}

}  // namespace

PngImage read_png_image(std::string_view bytes, PngChannels channels,
                        const CheckPngSize& check_size) {
  Image image;
  image.bytes = bytes;
  image.wanted = channels;
  image.check_size = &check_size;
  const Reader reader(image);
  const bool is_read =
      reader.info != nullptr && decode(reader.png, reader.info, image);
  if (image.lacks_memory) throw std::bad_alloc();
  if (!is_read) throw FormatError("PNG: " + image.fault);
  return image;
}

}  // namespace lamina
