// Image formats differ in what they can hold, and are recognised by how files begin.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace crt::core {

/// A WritableFormat is a format that pictures are written in.
struct WritableFormat {
  std::string_view ending;  ///< without the dot, in lower case
  const char* name;         ///< OpenImageIO's
  bool floats;              ///< linear floats, else 8-bit integers as displays want them
  bool alpha;               ///< can hold one
  bool free_texts;          ///< takes texts under any name
  bool channels = false;    ///< holds channels beside the colours
  bool built_in = false;    ///< is written without OpenImageIO
};

/// Returns the format for a file name, by its ending in any case, or null if there is none.
const WritableFormat* writable_format(std::string_view file_name);

/// Returns the endings that can be written: "png, tif, ...".
std::string writable_endings();

/// Returns the endings of formats that hold channels beside the colours.
std::string endings_with_channels();

/// Returns OpenImageIO's name of the format that a file's first bytes show, or null. The name of
/// the file does not matter. Formats whose readers are little tested are left out.
const char* format_of_content(std::span<const std::byte> content);

}  // namespace crt::core
