// This is a module for image files that reads PNG alone. A Python wheel holds it beside the one
// with OpenImageIO, and libcrt takes it where OpenImageIO is not installed. The border is that of
// core/image/files/interface.hpp.
//
// libpng reports errors by a long jump. So each function that may be left in this way has no
// objects with a destructor: its caller owns them.
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "core/image/files/interface.hpp"

namespace crt::core {

namespace {

/// A Failure is what libpng says when it fails.
struct Failure {
  std::array<char, 200> message{};

  void set(const char* text) { std::strncpy(message.data(), text, message.size() - 1); }
};

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  static_cast<Failure*>(png_get_error_ptr(png))->set(message);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

// ---- decoding -------------------------------------------------------------------------------

/// A Reader has libpng's structs, and the bytes of the file.
struct Reader {
  Failure failure;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  const unsigned char* next;
  std::size_t left;

  Reader(const unsigned char* bytes, std::size_t count) : next(bytes), left(count) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto& reader = *static_cast<Reader*>(png_get_io_ptr(png));
  if (count > reader.left) fail(png, "it is cut short");
  std::memcpy(to, reader.next, count);
  reader.next += count;
  reader.left -= count;
}

/// Reads the header, and has libpng turn whatever is in the file into RGBA of 16 bits.
bool read_header(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_read_fn(reader.png, &reader, read_bytes);
  constexpr png_uint_32 longest_side = 1u << 27;
  png_set_user_limits(reader.png, longest_side, longest_side);
  png_read_info(reader.png, reader.info);
  png_set_expand_16(reader.png);
  png_set_gray_to_rgb(reader.png);
  png_set_add_alpha(reader.png, 0xffff, PNG_FILLER_AFTER);
  return true;
}

/// Reads so many rows, which are all of an interlaced file, or the next ones of another. Rows that
/// a short file does not have are not even touched.
bool read_rows(Reader& reader, int passes, unsigned char* to, std::size_t row_size,
               std::size_t count) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t y = 0; y < count; ++y) png_read_row(reader.png, to + y * row_size, nullptr);
  }
  return true;
}

bool start_reading(Reader& reader, int& passes) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

/// Converts RGBA of 16 bits, the higher byte first and alpha straight, to floats with premultiplied
/// alpha. They have the bits that OpenImageIO gives them, which multiplies by the rounded inverse
/// of the largest number in the file. It takes numbers of fewer than 8 bits for 8 bits.
void convert(const unsigned char* from, std::size_t pixels, bool has_sixteen_bits, float* to) {
  const float scale = 1.0f / (has_sixteen_bits ? 65535.0f : 255.0f);
  const auto number = [&](std::size_t i) {
    const int high = from[2 * i];
    return static_cast<float>(has_sixteen_bits ? high << 8 | from[2 * i + 1] : high) * scale;
  };
  for (std::size_t i = 0; i < 4 * pixels; i += 4) {
    const float alpha = number(i + 3);
    for (std::size_t channel = 0; channel < 3; ++channel)
      to[i + channel] = number(i + channel) * alpha;
    to[i + 3] = alpha;
  }
}

ImageFilesStatus failed(const ImageFilesError& error, const char* message) {
  error.report(error.context, message);
  return image_files_failed;
}

ImageFilesStatus unsupported(const char* format, const ImageFilesError& error) {
  const std::string message =
      std::string("this module knows PNG files alone; those of ") + format +
      " need OpenImageIO, of the version that the module beside it was built with";
  error.report(error.context, message.c_str());
  return image_files_unsupported;
}

ImageFilesStatus decode_png(const ImageFilesContent& content, const ImageFilesPicture& picture,
                            const ImageFilesError& error) {
  Reader reader(content.bytes, content.count);
  if (reader.info == nullptr) return image_files_out_of_memory;
  if (!read_header(reader)) return failed(error, reader.failure.message.data());
  const std::size_t width = png_get_image_width(reader.png, reader.info);
  const std::size_t height = png_get_image_height(reader.png, reader.info);
  const bool has_sixteen_bits = png_get_bit_depth(reader.png, reader.info) == 16;
  if (!picture.accept(picture.context, static_cast<int>(width), static_cast<int>(height)))
    return image_files_failed;
  int passes = 1;
  if (!start_reading(reader, passes)) return failed(error, reader.failure.message.data());

  // The picture is allocated when the first strip is there, so that a short file with a tall claim
  // costs nothing. An interlaced file is one strip.
  constexpr std::size_t most_rows = 64;
  constexpr std::size_t strip_pixels = std::size_t{1} << 20;
  const std::size_t row_size = 8 * width;
  const std::size_t strip =
      passes > 1 ? height : std::clamp(strip_pixels / width, std::size_t{1}, most_rows);
  const auto bytes =
      std::make_unique_for_overwrite<unsigned char[]>(std::min(strip, height) * row_size);
  float* to = nullptr;
  for (std::size_t y = 0; y < height; y += strip) {
    const std::size_t count = std::min(strip, height - y);
    if (!read_rows(reader, passes, bytes.get(), row_size, count))
      return failed(error, reader.failure.message.data());
    if (y == 0) {
      to = picture.allocate(picture.context, static_cast<int>(width), static_cast<int>(height),
                            true);
    }
    if (to == nullptr) return image_files_out_of_memory;
    convert(bytes.get(), count * width, has_sixteen_bits, to);
    to += 4 * count * width;
  }
  return image_files_ok;
}

// ---- the border -----------------------------------------------------------------------------

ImageFilesStatus decode(const ImageFilesContent* content, const ImageFilesPicture* picture,
                        const ImageFilesError* error) noexcept {
  try {
    if (std::string_view(content->format) != "png") return unsupported(content->format, *error);
    return decode_png(*content, *picture, *error);
  } catch (const std::bad_alloc&) {
    return image_files_out_of_memory;
  } catch (...) {
    return image_files_failed;
  }
}

/// CRT writes PNG files without a module, and no other format is known here.
ImageFilesStatus encode(const ImageFilesRequest* request, const ImageFilesBytes*,
                        const ImageFilesError* error) noexcept {
  try {
    return unsupported(request->format, *error);
  } catch (const std::bad_alloc&) {
    return image_files_out_of_memory;
  }
}

}  // namespace

}  // namespace crt::core

extern "C" __attribute__((visibility("default"))) const crt::core::ImageFiles* crt_image_files() {
  static constexpr crt::core::ImageFiles functions = {crt::core::image_files_version,
                                                      crt::core::decode, crt::core::encode};
  return &functions;
}
