// The border between crt_core and the module crt_image_files is a plain table of C functions. The
// module alone links OpenImageIO. It is loaded when the first image file is read or written. So a
// program that touches none pays nothing for OpenImageIO and the many libraries behind it.
//
// No exception crosses the border, and nothing allocated on one side is freed on the other. Both
// sides see files as bytes in memory only.
#pragma once

#include <cstddef>
#include <cstdint>

namespace crt::core {

/// This is the version of what follows. A module of another version is refused.
inline constexpr int image_files_version = 4;

/// An ImageFileText is a name and a text that go into a file beside the pixels. Both end in 0.
struct ImageFileText {
  const char* name;
  const char* value;
};

enum ImageFilesStatus : int {
  image_files_ok = 0,
  image_files_failed = 1,       ///< the file is broken, or its format cannot hold the picture
  image_files_unsupported = 2,  ///< this OpenImageIO cannot do the format
  image_files_out_of_memory = 3,
};

/// An ImageFilesError is called at most once, with why a call failed.
struct ImageFilesError {
  void* context;
  void (*report)(void* context, const char* message);
};

/// An ImageFilesPicture takes a decoded picture.
struct ImageFilesPicture {
  void* context;
  /// This is called when the header was read, before anything is decoded. It returns whether a
  /// picture of this size is wanted. If not, decoding fails without a message.
  bool (*accept)(void* context, int width, int height);
  /// This is called once the size is known and the first rows were read. It returns room for 4 *
  /// width * height floats, or null. `integer` says whether the file has integers or floats.
  float* (*allocate)(void* context, int width, int height, bool integer);
};

/// An ImageFilesBytes takes an encoded file. append returns false if it cannot.
struct ImageFilesBytes {
  void* context;
  bool (*append)(void* context, const unsigned char* bytes, std::size_t count);
};

/// An ImageFilesContent is a file to decode.
struct ImageFilesContent {
  const char* format;  ///< OpenImageIO's name of the format
  const unsigned char* bytes;
  std::size_t count;
};

/// An ImageFileChannel has numbers beside the colours, one a pixel, as `floats` or as `integers`.
/// The other is null.
struct ImageFileChannel {
  const char* name;
  const float* floats;
  const std::uint32_t* integers;
};

/// An ImageFilesRequest is a picture to encode: rows from the top, without gaps, as `bytes` or as
/// `floats`. The other is null.
struct ImageFilesRequest {
  const char* format;
  int width;
  int height;
  int channels;  ///< 3, or 4 with an alpha: straight in bytes, premultiplied in floats
  const unsigned char* bytes;
  const float* floats;
  const ImageFileText* texts;
  std::size_t text_count;
  const ImageFileChannel*
      others;  ///< only beside floats, and if the format takes any number of channels
  std::size_t other_count;
};

struct ImageFiles {
  int version;
  /// Gives RGBA with premultiplied alpha. Floats that are not finite stay as they are.
  ImageFilesStatus (*decode)(const ImageFilesContent*, const ImageFilesPicture*,
                             const ImageFilesError*);
  ImageFilesStatus (*encode)(const ImageFilesRequest*, const ImageFilesBytes*,
                             const ImageFilesError*);
};

/// The one symbol that the module exports is a function of this type.
using ImageFilesEntry = const ImageFiles* (*)();
inline constexpr const char* image_files_entry_name = "crt_image_files";
inline constexpr const char* image_files_module_name = "crt_image_files.so";

}  // namespace crt::core
