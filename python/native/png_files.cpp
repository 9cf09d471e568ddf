// This is a module for image files that knows PNG alone. A Python wheel holds it beside the one
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
#include <vector>

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
/// alpha.
void convert(const unsigned char* from, std::size_t pixels, float* to) {
  constexpr float largest = 65535.0f;
  const auto number = [&](std::size_t i) {
    return static_cast<float>(from[2 * i] << 8 | from[2 * i + 1]) / largest;
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
  if (width > content.max_pixels / height) {
    return failed(error,
                  ("its header says " + std::to_string(width) + " x " + std::to_string(height) +
                   " pixels; the limit is " + std::to_string(content.max_pixels) + " altogether")
                      .c_str());
  }
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
    convert(bytes.get(), count * width, to);
    to += 4 * count * width;
  }
  return image_files_ok;
}

// ---- encoding -------------------------------------------------------------------------------

/// A Writer has libpng's structs, and the bytes so far.
struct Writer {
  Failure failure;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  std::vector<unsigned char> bytes;

  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

void write_bytes(png_structp png, png_bytep from, std::size_t count) {
  auto& writer = *static_cast<Writer*>(png_get_io_ptr(png));
  bool has_room = true;
  try {
    writer.bytes.insert(writer.bytes.end(), from, from + count);
  } catch (const std::bad_alloc&) {
    has_room = false;
  }
  if (!has_room) fail(png, "out of memory");
}

void flush_nothing(png_structp) {}

/// Returns PNG's name of a text that has one of OpenImageIO's names.
std::string png_name(std::string_view name) {
  constexpr std::size_t longest = 79;
  if (name == "DocumentName") return "Title";
  if (name == "Artist") return "Author";
  if (name == "ImageDescription") return "Description";
  return std::string(name.substr(0, longest));
}

bool write_picture(Writer& writer, const ImageFilesRequest& request, std::vector<png_text>& texts) {
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  const bool has_alpha = request.channels == 4;
  png_set_write_fn(writer.png, &writer, write_bytes, flush_nothing);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(request.width),
               static_cast<png_uint_32>(request.height), 8,
               has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_text(writer.png, writer.info, texts.data(), static_cast<int>(texts.size()));
  png_write_info(writer.png, writer.info);
  const auto row_size =
      static_cast<std::size_t>(request.channels) * static_cast<std::size_t>(request.width);
  for (int y = 0; y < request.height; ++y)
    png_write_row(writer.png, request.bytes + static_cast<std::size_t>(y) * row_size);
  png_write_end(writer.png, writer.info);
  return true;
}

ImageFilesStatus encode_png(const ImageFilesRequest& request, const ImageFilesBytes& sink,
                            const ImageFilesError& error) {
  Writer writer;
  if (writer.info == nullptr) return image_files_out_of_memory;
  std::vector<std::string> names;
  std::vector<std::string> values;
  std::vector<png_text> texts;
  for (std::size_t i = 0; i < request.text_count; ++i) {
    names.push_back(png_name(request.texts[i].name));
    values.emplace_back(request.texts[i].value);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool is_ascii = std::all_of(values[i].begin(), values[i].end(),
                                      [](char c) { return static_cast<unsigned char>(c) < 0x80; });
    png_text& text = texts.emplace_back();
    text.compression = is_ascii ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    text.key = names[i].data();
    text.text = values[i].data();
    (is_ascii ? text.text_length : text.itxt_length) = values[i].size();
  }
  if (!write_picture(writer, request, texts)) return failed(error, writer.failure.message.data());
  const bool is_taken = sink.append(sink.context, writer.bytes.data(), writer.bytes.size());
  return is_taken ? image_files_ok : image_files_out_of_memory;
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

ImageFilesStatus encode(const ImageFilesRequest* request, const ImageFilesBytes* sink,
                        const ImageFilesError* error) noexcept {
  try {
    if (std::string_view(request->format) != "png") return unsupported(request->format, *error);
    return encode_png(*request, *sink, *error);
  } catch (const std::bad_alloc&) {
    return image_files_out_of_memory;
  } catch (...) {
    return image_files_failed;
  }
}

}  // namespace

}  // namespace crt::core

extern "C" __attribute__((visibility("default"))) const crt::core::ImageFiles* crt_image_files() {
  static constexpr crt::core::ImageFiles functions = {crt::core::image_files_version,
                                                      crt::core::decode, crt::core::encode};
  return &functions;
}
