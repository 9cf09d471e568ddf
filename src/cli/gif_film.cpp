// The format is GIF89a, "Graphics Interchange Format, Version 89a", CompuServe 1990. Sections are
// named where they matter.
#include "cli/gif_film.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <crt/file.hpp>
#include <string_view>
#include <utility>

#include "cli/gif_palette.hpp"

namespace crt::cli {

namespace {

using namespace std::string_view_literals;

constexpr int most_code_bits = 12;

/// Packs indices of 8 bits by the variant of LZW that GIF has (appendix F).
class LzwPacker {
 public:
  std::string packed(const std::vector<std::uint8_t>& indices) {
    clear();
    int prefix = indices.front();
    for (std::size_t i = 1; i < indices.size(); ++i) {
      std::uint16_t& longer = longer_[static_cast<std::size_t>(prefix)][indices[i]];
      if (longer != 0) {
        prefix = longer;
        continue;
      }
      put(prefix);
      prefix = indices[i];
      if (next_ == 1 << most_code_bits) {
        clear();
        continue;
      }
      longer = static_cast<std::uint16_t>(next_);
      if (next_ == 1 << bits_) ++bits_;
      ++next_;
    }
    put(prefix);
    put(end_code);
    if (filled_ > 0) bytes_.push_back(static_cast<char>(pending_));
    return std::move(bytes_);
  }

 private:
  static constexpr int clear_code = 256;
  static constexpr int end_code = 257;

  void clear() {
    put(clear_code);
    longer_.assign(std::size_t{1} << most_code_bits, {});
    next_ = end_code + 1;
    bits_ = 9;
  }

  void put(int code) {
    pending_ |= static_cast<std::uint32_t>(code) << filled_;
    filled_ += bits_;
    for (; filled_ >= 8; filled_ -= 8) {
      bytes_.push_back(static_cast<char>(pending_));
      pending_ >>= 8;
    }
  }

  /// Holds the code of a sequence of indices and one more, or 0.
  std::vector<std::array<std::uint16_t, 256>> longer_;
  std::string bytes_;
  std::uint32_t pending_ = 0;
  int filled_ = 0;  ///< bits that are pending
  int next_ = 0;    ///< code of the next new sequence
  int bits_ = 9;    ///< of a code
};

}  // namespace

GifFilm::GifFilm(std::filesystem::path file, const FilmShape& shape)
    : file_(std::move(file)), shape_(shape) {
  content_ = "GIF89a";
  add_number(shape_.width);
  add_number(shape_.height);
  content_ += "\x70\0\0"sv;  // 8 bits a channel, no global colours
  // It begins again and again (Netscape's application extension).
  content_ += "!\xff\x0bNETSCAPE2.0\x03\x01\0\0\0"sv;
}

void GifFilm::add(const std::vector<std::uint8_t>& rgb) {
  const PalettePicture picture = with_palette(rgb, shape_.width);
  content_ += "!\xf9\x04\0"sv;  // graphic control extension, section 23
  add_number(delay_of_next_frame());
  content_ += "\0\0"sv;
  content_ += ",\0\0\0\0"sv;  // image descriptor, section 20
  add_number(shape_.width);
  add_number(shape_.height);
  content_ += "\x87"sv;  // with 256 colours of its own
  for (const std::uint8_t value : picture.colors) content_.push_back(static_cast<char>(value));
  content_ += "\x08"sv;  // bits of an index
  const std::string packed = LzwPacker().packed(picture.indices);
  constexpr std::size_t most_in_block = 255;
  for (std::size_t at = 0; at < packed.size(); at += most_in_block) {
    const std::string_view block = std::string_view(packed).substr(at, most_in_block);
    content_.push_back(static_cast<char>(block.size()));
    content_ += block;
  }
  content_.push_back('\0');
}

void GifFilm::finish() {
  write_file(file_, content_ + ";");
}

void GifFilm::add_number(int number) {
  content_.push_back(static_cast<char>(number & 0xff));
  content_.push_back(static_cast<char>(number >> 8 & 0xff));
}

/// Frames last whole hundredths of a second. They are rounded so that the film has its length.
int GifFilm::delay_of_next_frame() {
  constexpr int least_delay = 2;  // viewers take less for a mistake
  constexpr int most_delay = 65535;
  ++frames_;
  const double until = std::min(100.0 * frames_ / shape_.frames_per_second, 1e9);
  const int delay =
      std::clamp(static_cast<int>(std::lround(until)) - hundredths_, least_delay, most_delay);
  hundredths_ += delay;
  return delay;
}

}  // namespace crt::cli
