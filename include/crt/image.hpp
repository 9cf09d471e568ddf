#pragma once

#include <crt/color.hpp>
#include <crt/settings.hpp>
#include <crt/stats.hpp>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace crt {

/// How Image::write goes about it.
struct WriteOptions {
  /// Leaves out of the file what changes from run to run (the render time), so that equal pictures
  /// are equal files.
  bool reproducible = false;
  /// Leaves out Image::channels(), so that a picture that has some goes into any format.
  bool colors_only = false;
};

/// Numbers that a picture has beside its colours, one a pixel: distances, a component of normals,
/// ...
struct ImageChannel {
  /// As EXR files call it: what comes before the last dot is the layer's name.
  std::string name;
  /// width * height of them, rows from the top. EXR files hold both as they are.
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;
};

/// Values of a picture that are no finite numbers (NaN, infinities), as some image files have them.
/// They count as 0.
struct NotFiniteValues {
  std::string file{};        ///< that they were in; empty for pixels that were filled in by hand
  std::uint64_t pixels = 0;  ///< that have one or several; 0 if all is well
  int x = 0;                 ///< column of the first of these pixels, row by row from the top left
  int y = 0;                 ///< its row

  /// A line that says so.
  std::string message() const;

  bool operator==(const NotFiniteValues&) const = default;
};

/// A picture: rows of linear RGBA floats from the top, alpha premultiplied. What rendering gives,
/// and what panoramas and image maps take. It may have other channels beside them.
class Image {
 public:
  Image() = default;

  /// A black, fully covered picture. Throws Error if a side is below 1 or there are over 2^27
  /// pixels.
  Image(int width, int height);

  /// Reads a PNG, JPEG, EXR, HDR, TIFF, BMP, PNM, PFM or WebP file; its content tells which. Grey
  /// becomes RGB, of several pictures in a file the first is taken, and values that are not finite
  /// become 0, of which not_finite() tells. Throws Error: io if it is missing, broken or larger
  /// than a picture may be, unsupported if OpenImageIO cannot be loaded, out_of_memory.
  static Image read(const std::filesystem::path& path);

  /// The same from a file's content in memory; `name` is for messages.
  static Image decode(std::span<const std::byte> content, const std::string& name);

  /// From 8-bit RGBA with straight alpha, as displays want it: 4 bytes a pixel, rows from the top,
  /// each starting `row_stride` bytes after the one before (0: 4 * width). The bytes end with the
  /// last row. The image is display_encoded(). Throws Error (invalid_argument) for a wrong size or
  /// number of bytes.
  static Image from_rgba8(int width, int height, std::span<const std::uint8_t> rgba,
                          std::size_t row_stride = 0);

  /// Writes a file whose format its ending says: png, tif, jpg, bmp and ppm get 8-bit integers with
  /// Settings::gamma applied, exr and hdr linear floats. png, tif and exr get an alpha if some
  /// pixel is not fully covered; the others then show the picture in front of black. Only exr holds
  /// channels(). The file is written as write_file() does (crt/file.hpp): no half file is ever
  /// seen, links are followed, devices and pipes are written to as they are. Throws Error: io,
  /// unsupported (an unknown ending, one that cannot hold channels(), or OpenImageIO cannot be
  /// loaded), invalid_argument (no pixels), out_of_memory.
  void write(const std::filesystem::path& path, const WriteOptions& options = {}) const;

  /// The bytes of such a file; `format` is its ending: "png", "exr", ... Throws Error as write()
  /// does.
  std::vector<std::byte> encode(std::string_view format, const WriteOptions& options = {}) const;

  /// Pixels across.
  int width() const { return width_; }
  /// Pixels down.
  int height() const { return height_; }
  /// Whether there are no pixels: an Image made without a size.
  bool empty() const { return pixels_.empty(); }

  /// 4 * width * height floats.
  std::span<const float> pixels() const { return pixels_; }
  /// The same, to change them.
  std::span<float> pixels() { return pixels_; }

  /// The pixel in column x from the left, row y from the top, as it is stored: with premultiplied
  /// alpha. There is no check.
  Color at(int x, int y) const;
  /// Changes a pixel; no check.
  void set(int x, int y, const Color& color);

  /// What there is beside the colours: what RenderOptions::aovs asked for, or what was set.
  const std::vector<ImageChannel>& channels() const { return channels_; }
  /// The numbers of the channel of this name; none if there is no such channel of floats.
  std::span<const float> channel(std::string_view name) const;
  /// The same of a channel of whole numbers.
  std::span<const std::uint32_t> integer_channel(std::string_view name) const;
  /// The same numbers, to change them.
  std::span<float> channel(std::string_view name);
  /// The same of a channel of whole numbers, to change them.
  std::span<std::uint32_t> integer_channel(std::string_view name);
  /// Replaces all channels. Throws Error (invalid_argument) for a name that is empty, taken (also
  /// by R, G, B or A) or has a character that is not printable ASCII, and for a wrong number of
  /// numbers.
  void set_channels(std::vector<ImageChannel> channels);

  /// The 8-bit RGBA bytes a file gets: clamp(c)^(1/gamma), rounded to nearest, alpha straight; with
  /// show_clip, red where a channel passes 1. A display-encoded image gets no gamma again.
  std::vector<std::uint8_t> to_rgba8() const;

  /// Whether the values are as a display wants them (read from an 8- or 16-bit file), not linear.
  /// Where such an image serves in a scene it is raised to Settings::gamma, so that at any gamma it
  /// shows as it is.
  bool display_encoded() const { return display_encoded_; }
  /// Says so of pixels that were filled in by hand.
  void set_display_encoded(bool encoded) { display_encoded_ = encoded; }

  /// What of the file that it was read from was not finite, and is 0 here. A render of a scene with
  /// such a picture (or with one that was filled in by hand and has such values) warns through
  /// RenderOptions::log, once a picture; a script's diagnostics do where the picture is named, and
  /// then the render does not.
  const NotFiniteValues& not_finite() const { return not_finite_; }
  /// Replaces that: where the user has been told already, by {}.
  void set_not_finite(NotFiniteValues values) { not_finite_ = std::move(values); }

  /// The settings it was rendered with: gamma and show_clip act when it is written, the texts and
  /// the rest go into the file.
  const Settings& settings() const { return settings_; }
  /// Replaces them, to write the same picture with another gamma or title.
  void set_settings(Settings settings) { settings_ = std::move(settings); }

  /// What rendering it took; all 0 for an image that was not rendered.
  const RenderStats& stats() const { return stats_; }
  /// The same, to fill in the stages that the program did itself.
  RenderStats& stats() { return stats_; }

 private:
  int width_ = 0;
  int height_ = 0;
  bool display_encoded_ = false;
  std::vector<float> pixels_;
  std::vector<ImageChannel> channels_;
  NotFiniteValues not_finite_;
  Settings settings_;
  RenderStats stats_;
};

}  // namespace crt
