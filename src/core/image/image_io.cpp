// Image::read, decode and write are on this side of the border to OpenImageIO.
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "core/base/whole_file.hpp"
#include "core/image/essential_bytes.hpp"
#include "core/image/file_format.hpp"
#include "core/image/file_texts.hpp"
#include "core/image/image_limits.hpp"
#include "core/image/module_loader.hpp"
#include "core/image/pixel_conversion.hpp"
#include "core/image/png_writer.hpp"
#include "core/shading/not_finite.hpp"
#include "crt/error.hpp"
#include "crt/file.hpp"
#include "crt/image.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

using namespace core;

[[noreturn]] void fail(ErrorCode code, const char* action, const std::string& name,
                       const std::string& reason) {
  throw Error(code, text::format("cannot {} '{}': {}", action, name, reason));
}

/// A Failure collects what the module says when it fails.
struct Failure {
  std::string reason;

  ImageFilesError sink() {
    return {this, [](void* context, const char* message) {
              try {
                static_cast<Failure*>(context)->reason = message;
              } catch (const std::exception&) {
                // The status alone must explain the failure then.
                static_cast<Failure*>(context)->reason.clear();
              }
            }};
  }

  void throw_if(ImageFilesStatus status, const char* action, const std::string& name) const {
    switch (status) {
      case image_files_ok:
        return;
      case image_files_unsupported:
        fail(ErrorCode::unsupported, action, name, reason);
      case image_files_out_of_memory:
        fail(ErrorCode::out_of_memory, action, name, "out of memory");
      case image_files_failed:
        break;
    }
    fail(ErrorCode::io, action, name, reason);
  }
};

/// Calls work(), and turns what it refuses of a file into an Error.
template <class Work>
auto unless_refused(const std::string& name, const Work& work) {
  try {
    return work();
  } catch (const TooLarge& refusal) {
    fail(ErrorCode::limit, "read", name, refusal.what());
  } catch (const RefusedFile& refusal) {
    fail(ErrorCode::io, "read", name, refusal.what());
  }
}

/// A Decoding is a picture that the module decodes.
struct Decoding {
  const SizeLimit& limit;
  std::optional<Image> image{};
  int refused_width = 0;  ///< the size of a picture that is too large
  int refused_height = 0;

  static bool accept(void* context, int width, int height) {
    auto& decoding = *static_cast<Decoding*>(context);
    if (decoding.limit.allows(static_cast<std::uint64_t>(width),
                              static_cast<std::uint64_t>(height))) {
      return true;
    }
    decoding.refused_width = width;
    decoding.refused_height = height;
    return false;
  }

  static float* allocate(void* context, int width, int height, bool integer) {
    try {
      auto& result = static_cast<Decoding*>(context)->image.emplace(width, height);
      result.set_display_encoded(integer);
      return result.pixels().data();
    } catch (const std::exception&) {
      return nullptr;
    }
  }

  void throw_if_refused(const std::string& name) const {
    if (refused_width == 0) return;
    unless_refused(name, [&] {
      limit.check(static_cast<std::uint64_t>(refused_width),
                  static_cast<std::uint64_t>(refused_height));
    });
  }
};

/// Returns OpenImageIO's name of the format of a file that begins so.
const char* format_of(FileView content, const std::string& name) {
  const char* const format = format_of_content(content);
  if (format != nullptr) return format;
  fail(ErrorCode::io, "read", name,
       content.empty() ? "it is empty"
                       : "it is not a PNG, JPEG, EXR, HDR, TIFF, BMP, PNM or WebP file");
}

Image decode_content(FileBytes content, const std::string& name, const SizeLimit& limit) {
  const char* const format = format_of(content, name);
  const FileBytes essential =
      unless_refused(name, [&] { return essential_bytes(format, std::move(content), limit); });
  Decoding decoding{.limit = limit};
  const ImageFilesPicture picture = {&decoding, Decoding::accept, Decoding::allocate};
  const ImageFilesContent file = {format, reinterpret_cast<const unsigned char*>(essential.data()),
                                  essential.size()};
  Failure failure;
  const ImageFilesError error = failure.sink();
  const ImageFilesStatus status = image_files().decode(&file, &picture, &error);
  decoding.throw_if_refused(name);
  failure.throw_if(status, "read", name);
  std::optional<Image>& image = decoding.image;
  if (!image->display_encoded()) {  // else the file has integers
    NotFiniteValues values = replace_not_finite(*image);
    if (values.pixels > 0) {
      values.file = name;
      image->set_not_finite(std::move(values));
    }
  }
  return std::move(image).value();
}

std::vector<ImageFileChannel> file_channels(const std::vector<ImageChannel>& channels) {
  std::vector<ImageFileChannel> result;
  for (const ImageChannel& channel : channels) {
    const auto* const floats = std::get_if<std::vector<float>>(&channel.values);
    const auto* const integers = std::get_if<std::vector<std::uint32_t>>(&channel.values);
    result.push_back({.name = channel.name.c_str(),
                      .floats = floats == nullptr ? nullptr : floats->data(),
                      .integers = integers == nullptr ? nullptr : integers->data()});
  }
  return result;
}

/// Returns the bytes of a file that holds the picture.
std::vector<std::byte> encode(const Image& image, const WritableFormat& format,
                              const FileTexts& texts, std::span<const ImageFileChannel> channels,
                              const std::string& name) {
  std::vector<std::uint8_t> bytes;
  std::vector<float> floats;
  bool with_alpha = false;
  if (format.floats) {
    floats = linear_floats(image);
    with_alpha = format.alpha && has_partial_alpha(floats, 1.0f);
    if (!with_alpha) floats = without_alpha(floats);
  } else {
    bytes = display_bytes(image, format.alpha ? AlphaMode::straight : AlphaMode::over_black);
    with_alpha = format.alpha && has_partial_alpha(bytes, std::uint8_t{255});
    if (!with_alpha) bytes = without_alpha(bytes);
  }
  if (format.built_in) {
    return png_file({.width = image.width(),
                     .height = image.height(),
                     .channels = with_alpha ? 4 : 3,
                     .bytes = bytes},
                    texts);
  }
  std::vector<ImageFileText> file_texts;
  for (const auto& [text_name, value] : texts)
    file_texts.push_back({text_name.c_str(), value.c_str()});

  const ImageFilesRequest request = {.format = format.name,
                                     .width = image.width(),
                                     .height = image.height(),
                                     .channels = with_alpha ? 4 : 3,
                                     .bytes = format.floats ? nullptr : bytes.data(),
                                     .floats = format.floats ? floats.data() : nullptr,
                                     .texts = file_texts.data(),
                                     .text_count = file_texts.size(),
                                     .others = channels.data(),
                                     .other_count = channels.size()};
  std::vector<std::byte> content;
  const ImageFilesBytes sink = {
      &content, [](void* context, const unsigned char* added, std::size_t count) {
        try {
          auto& all = *static_cast<std::vector<std::byte>*>(context);
          const auto* const first = reinterpret_cast<const std::byte*>(added);
          all.insert(all.end(), first, first + count);
          return true;
        } catch (const std::exception&) {
          return false;
        }
      }};
  Failure failure;
  const ImageFilesError error = failure.sink();
  failure.throw_if(image_files().encode(&request, &sink, &error), "write", name);
  return content;
}

void check_channels(const Image& image, const WritableFormat& format, const std::string& name) {
  if (image.channels().empty() || format.channels) return;
  fail(ErrorCode::unsupported, "write", name,
       text::format(
           "a file of this format holds colours alone, but the picture has the channel '{}'{}; "
           "the name must end in {}",
           image.channels().front().name, image.channels().size() == 1 ? "" : " and others",
           endings_with_channels()));
}

/// Returns the format for a file name. Throws Error (unsupported) if there is none.
const WritableFormat& format_for(const std::string& file_name, const std::string& name) {
  const WritableFormat* const format = writable_format(file_name);
  if (format == nullptr) {
    fail(ErrorCode::unsupported, "write", name,
         "the name must end in one of " + writable_endings());
  }
  return *format;
}

/// Returns the bytes of a file whose name says its format. `name` is for messages.
std::vector<std::byte> file_bytes(const Image& image, const std::string& file_name,
                                  const WriteOptions& options, const std::string& name) {
  if (image.empty()) fail(ErrorCode::invalid_argument, "write", name, "the picture has no pixels");
  const WritableFormat& format = format_for(file_name, name);
  if (!options.colors_only) check_channels(image, format, name);
  const FileTexts texts = file_texts(image, options.reproducible);
  return encode(
      image, format, format.free_texts ? texts : gathered_texts(texts),
      options.colors_only ? std::vector<ImageFileChannel>() : file_channels(image.channels()),
      name);
}

}  // namespace

Image decode_image(std::span<const std::byte> content, const std::string& name,
                   std::uint64_t most_pixels) {
  try {
    return decode_content(FileBytes(content.begin(), content.end()), name, SizeLimit(most_pixels));
  } catch (const std::bad_alloc&) {
    fail(ErrorCode::out_of_memory, "read", name, "out of memory");
  }
}

Image read_image(const std::filesystem::path& path, std::uint64_t most_pixels) {
  const SizeLimit limit(most_pixels);
  constexpr std::size_t longest_signature = 16;
  try {
    format_of(read_file_start(path, longest_signature), path.string());
    return decode_content(read_whole_file(path, limit.max_file_bytes()), path.string(), limit);
  } catch (const std::bad_alloc&) {
    fail(ErrorCode::out_of_memory, "read", path.string(), "out of memory");
  }
}

Image Image::decode(std::span<const std::byte> content, const std::string& name) {
  return decode_image(content, name);
}

Image Image::read(const std::filesystem::path& path) {
  return read_image(path);
}

void Image::write(const std::filesystem::path& path, const WriteOptions& options) const {
  const std::string name = path.string();
  try {
    write_whole_file(path, file_bytes(*this, path.filename().string(), options, name),
                     Flush::later);
  } catch (const std::bad_alloc&) {
    fail(ErrorCode::out_of_memory, "write", name, "out of memory");
  }
}

void check_picture_name(const std::filesystem::path& path, bool with_channels) {
  const std::string name = path.string();
  if (format_for(path.filename().string(), name).channels || !with_channels) return;
  fail(ErrorCode::unsupported, "write", name,
       text::format("a file of this format holds colours alone and no channels beside them; the "
                    "name must end in {}",
                    endings_with_channels()));
}

std::vector<std::byte> Image::encode(std::string_view format, const WriteOptions& options) const {
  const std::string name = text::format("picture.{}", format);
  try {
    return file_bytes(*this, name, options, name);
  } catch (const std::bad_alloc&) {
    fail(ErrorCode::out_of_memory, "write", name, "out of memory");
  }
}

}  // namespace crt
