#include "core/image/file_format.hpp"

#include <algorithm>
#include <array>

#include "text/letters.hpp"

namespace crt::core {

namespace {

constexpr std::array<WritableFormat, 9> writable_formats = {{
    {.ending = "png",
     .name = "png",
     .floats = false,
     .alpha = true,
     .free_texts = true,
     .built_in = true},
    {.ending = "tif", .name = "tiff", .floats = false, .alpha = true, .free_texts = false},
    {.ending = "tiff", .name = "tiff", .floats = false, .alpha = true, .free_texts = false},
    {.ending = "jpg", .name = "jpeg", .floats = false, .alpha = false, .free_texts = false},
    {.ending = "jpeg", .name = "jpeg", .floats = false, .alpha = false, .free_texts = false},
    {.ending = "bmp", .name = "bmp", .floats = false, .alpha = false, .free_texts = false},
    {.ending = "ppm", .name = "pnm", .floats = false, .alpha = false, .free_texts = false},
    {.ending = "exr",
     .name = "openexr",
     .floats = true,
     .alpha = true,
     .free_texts = true,
     .channels = true},
    {.ending = "hdr", .name = "hdr", .floats = true, .alpha = false, .free_texts = false},
}};

/// A Signature has the bytes that files of a format begin with.
struct Signature {
  std::string_view start;
  const char* name;
};

using namespace std::string_view_literals;

constexpr std::array<Signature, 18> signatures = {{
    {"\x89PNG\r\n\x1a\n"sv, "png"},
    {"\xff\xd8\xff"sv, "jpeg"},
    {"II*\0"sv, "tiff"},
    {"MM\0*"sv, "tiff"},
    {"II+\0"sv, "tiff"},
    {"MM\0+"sv, "tiff"},
    {"\x76\x2f\x31\x01"sv, "openexr"},
    {"#?RADIANCE"sv, "hdr"},
    {"#?RGBE"sv, "hdr"},
    {"BM"sv, "bmp"},
    {"P1"sv, "pnm"},
    {"P2"sv, "pnm"},
    {"P3"sv, "pnm"},
    {"P4"sv, "pnm"},
    {"P5"sv, "pnm"},
    {"P6"sv, "pnm"},
    {"PF"sv, "pnm"},
    {"Pf"sv, "pnm"},
}};

template <class Condition>
std::string endings_where(const Condition& holds) {
  std::string endings;
  for (const WritableFormat& format : writable_formats) {
    if (!holds(format)) continue;
    if (!endings.empty()) endings += ", ";
    endings += format.ending;
  }
  return endings;
}

}  // namespace

const WritableFormat* writable_format(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  if (dot == std::string_view::npos) return nullptr;
  const std::string ending = text::in_small_letters(file_name.substr(dot + 1));
  const auto found =
      std::find_if(writable_formats.begin(), writable_formats.end(),
                   [&](const WritableFormat& format) { return format.ending == ending; });
  return found == writable_formats.end() ? nullptr : &*found;
}

std::string writable_endings() {
  return endings_where([](const WritableFormat&) { return true; });
}

std::string endings_with_channels() {
  return endings_where([](const WritableFormat& format) { return format.channels; });
}

const char* format_of_content(std::span<const std::byte> content) {
  const std::string_view text(reinterpret_cast<const char*>(content.data()), content.size());
  for (const Signature& signature : signatures) {
    if (text.substr(0, signature.start.size()) == signature.start) return signature.name;
  }
  // A WebP file is a RIFF container with its length between the two marks.
  if (text.substr(0, 4) == "RIFF" && text.size() >= 12 && text.substr(8, 4) == "WEBP")
    return "webp";
  return nullptr;
}

}  // namespace crt::core
