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

/// Says how Image::write writes a file.
struct WriteOptions {
  /// Leaves out of the file what changes from run to run (the render time), so that equal pictures
  /// are equal files.
  bool reproducible = false;
  /// Leaves out Image::channels(), so that a picture that has some can go into any format.
  bool colors_only = false;
};

/// An ImageChannel holds numbers that a picture has beside its colours, one a pixel: distances, a
/// component of normals, ...
struct ImageChannel {
  /// The name is as EXR files have it: what comes before the last dot is the layer's name.
  std::string name;
  /// There are width * height of them, in rows from the top. EXR files hold both types as they are.
  std::variant<std::vector<float>, std::vector<std::uint32_t>> values;
};

/// Describes values of a picture that are no finite numbers (NaN, infinities), as some image files
/// have them. They count as 0.
struct NotFiniteValues {
  std::string file{};  ///< the file they were in; empty for pixels that were filled in by hand
  std::uint64_t pixels = 0;  ///< pixels that have one or several; 0 if all is well
  int x = 0;                 ///< column of the first of these pixels, row by row from the top left
  int y = 0;                 ///< its row

  /// Returns a line that says so.
  std::string message() const;

  bool operator==(const NotFiniteValues&) const = default;
};

/// Returns what a display shows of a channel of linear light, in [0, 1]: light * 2^exposure,
/// brought into range by the tone map, clamped and raised to 1 / gamma. It is 0 for NaN.
double displayed(double light, const Settings& settings);

/// An Image is a picture: rows of linear RGBA floats from the top, with premultiplied alpha.
/// Rendering gives one, and panoramas and image maps take one. It may have other channels beside
/// them.
class Image {
 public:
  Image() = default;

  /// Makes a black, fully covered picture. Throws Error if a side is below 1 or there are over 2^27
  /// pixels.
  Image(int width, int height);

  /// Reads a PNG, JPEG, EXR, HDR, TIFF, BMP, PNM, PFM or WebP file. Its content decides which it
  /// is. Grey becomes RGB, and of several pictures in a file the first is taken. Values that are
  /// not finite become 0, which not_finite() reports. Throws Error: limit, before anything is
  /// decoded, if its header says that it takes more than a quarter of the memory (see
  /// crt/image_limits.hpp), io if it is missing, broken or larger than a picture may be,
  /// unsupported if OpenImageIO cannot be loaded, out_of_memory.
  static Image read(const std::filesystem::path& path);

  /// Reads a picture from a file's content in memory, otherwise as read(). `name` is for messages.
  static Image decode(std::span<const std::byte> content, const std::string& name);

  /// Makes a picture from 8-bit RGBA with straight alpha, as displays want it. There are 4 bytes a
  /// pixel and rows from the top, each starting `row_stride` bytes after the one before (0: 4 *
  /// width). The bytes end with the last row. The image is display_encoded(). Throws Error
  /// (invalid_argument) for a wrong size or number of bytes.
  static Image from_rgba8(int width, int height, std::span<const std::uint8_t> rgba,
                          std::size_t row_stride = 0);

  /// Writes a file whose ending decides the format: png, tif, jpg, bmp and ppm get 8-bit integers
  /// with Settings::exposure, tone_map and gamma applied, exr and hdr linear floats. png, tif and
  /// exr get an alpha if some pixel is not fully covered. The other formats then show the picture
  /// in front of black. Only exr holds channels(). The file is written as write_file() does
  /// (crt/file.hpp): no half file is ever seen, links are followed, devices and pipes are written
  /// to as they are. Throws Error: io, unsupported (an unknown ending, one that cannot hold
  /// channels(), or OpenImageIO cannot be loaded), invalid_argument (no pixels), out_of_memory.
  void write(const std::filesystem::path& path, const WriteOptions& options = {}) const;

  /// Returns the bytes of such a file. `format` is its ending: "png", "exr", ... Throws Error as
  /// write() does.
  std::vector<std::byte> encode(std::string_view format, const WriteOptions& options = {}) const;

  /// Returns the number of pixels across.
  int width() const { return width_; }
  /// Returns the number of pixels down.
  int height() const { return height_; }
  /// Says whether there are no pixels: an Image made without a size.
  bool empty() const { return pixels_.empty(); }

  /// Returns 4 * width * height floats.
  std::span<const float> pixels() const { return pixels_; }
  /// Returns the same floats, to change them.
  std::span<float> pixels() { return pixels_; }

  /// Returns the pixel in column x from the left, row y from the top, as it is stored: with
  /// premultiplied alpha. The coordinates are not checked.
  Color at(int x, int y) const;
  /// Changes a pixel. The coordinates are not checked.
  void set(int x, int y, const Color& color);

  /// Returns what there is beside the colours: what RenderOptions::aovs asked for, or what was set.
  const std::vector<ImageChannel>& channels() const { return channels_; }
  /// Returns the numbers of the channel of this name. There are none if it has no such channel of
  /// floats.
  std::span<const float> channel(std::string_view name) const;
  /// Returns the numbers of a channel of whole numbers, otherwise as channel().
  std::span<const std::uint32_t> integer_channel(std::string_view name) const;
  /// Returns the numbers of a channel of floats, to change them.
  std::span<float> channel(std::string_view name);
  /// Returns the numbers of a channel of whole numbers, to change them.
  std::span<std::uint32_t> integer_channel(std::string_view name);
  /// Replaces all channels. Throws Error (invalid_argument) for a name that is empty, taken (also
  /// by R, G, B or A) or has a character that is not printable ASCII, and for a wrong number of
  /// numbers.
  void set_channels(std::vector<ImageChannel> channels);

  /// Returns the 8-bit RGBA bytes that a file gets: what is displayed() of each channel, rounded to
  /// nearest, with straight alpha. With show_clip, pixels are red where a channel passes what a
  /// display can show. A display-encoded image gets no exposure, tone map and gamma again.
  std::vector<std::uint8_t> to_rgba8() const;

  /// Says whether the values are as a display wants them (read from an 8- or 16-bit file), not
  /// linear. Where such an image serves in a scene it is raised to Settings::gamma, so that at any
  /// gamma it shows as it is, without an exposure and a tone map.
  bool display_encoded() const { return display_encoded_; }
  /// Says whether values that were filled in by hand are as a display wants them.
  void set_display_encoded(bool encoded) { display_encoded_ = encoded; }

  /// Returns what of the file that it was read from was not finite, and is 0 here. A render of a
  /// scene with such a picture (or with one that was filled in by hand and has such values) warns
  /// through RenderOptions::log, once a picture. A script's diagnostics warn where the picture is
  /// named, and then the render does not.
  const NotFiniteValues& not_finite() const { return not_finite_; }
  /// Replaces what not_finite() returns. Pass {} where the user has already been warned.
  void set_not_finite(NotFiniteValues values) { not_finite_ = std::move(values); }

  /// Returns the settings it was rendered with. Exposure, tone map, gamma and show_clip act when it
  /// is written, and the texts and the rest go into the file.
  const Settings& settings() const { return settings_; }
  /// Replaces the settings, to write the same picture with another gamma or title.
  void set_settings(Settings settings) { settings_ = std::move(settings); }

  /// Returns what rendering it took. All is 0 for an image that was not rendered.
  const RenderStats& stats() const { return stats_; }
  /// Returns the same statistics, to fill in the stages that the program did itself.
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
