#include "cli/terminal_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "cli/film.hpp"
#include "cli/terminal_graphics.hpp"
#include "text/base64.hpp"

namespace crt::cli {

namespace {

/// A BytePicture has 3 bytes a pixel.
struct BytePicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  const std::uint8_t* at(int x, int y) const {
    return rgb.data() + 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(x));
  }
};

/// Returns the picture with at most so many pixels across. Each is the mean of those it stands for.
BytePicture fitted(const Image& image, int most_across) {
  BytePicture all{image.width(), image.height(), film_frame(image)};
  if (all.width <= most_across) return all;
  BytePicture small;
  small.width = most_across;
  small.height = std::max(1, static_cast<int>(std::int64_t{all.height} * most_across / all.width));
  const auto begin_of = [](int i, int from, int to) {
    return static_cast<int>(std::int64_t{i} * from / to);
  };
  for (int y = 0; y < small.height; ++y) {
    const int top = begin_of(y, all.height, small.height);
    const int bottom = std::max(top + 1, begin_of(y + 1, all.height, small.height));
    for (int x = 0; x < small.width; ++x) {
      const int left = begin_of(x, all.width, small.width);
      const int right = std::max(left + 1, begin_of(x + 1, all.width, small.width));
      std::array<std::int64_t, 3> sum{};
      for (int from_y = top; from_y < bottom; ++from_y)
        for (int from_x = left; from_x < right; ++from_x)
          for (std::size_t i = 0; i < 3; ++i) sum[i] += all.at(from_x, from_y)[i];
      const std::int64_t count = std::int64_t{1} * (bottom - top) * (right - left);
      for (const std::int64_t channel : sum)
        small.rgb.push_back(static_cast<std::uint8_t>(channel / count));
    }
  }
  return small;
}

// ---- half blocks ----------------------------------------------------------------------------

std::string half_blocks(const BytePicture& picture) {
  std::string text;
  for (int y = 0; y < picture.height; y += 2) {
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* const upper = picture.at(x, y);
      text += fmt::format("\033[38;2;{};{};{}m", upper[0], upper[1], upper[2]);
      if (y + 1 < picture.height) {
        const std::uint8_t* const lower = picture.at(x, y + 1);
        text += fmt::format("\033[48;2;{};{};{}m", lower[0], lower[1], lower[2]);
      }
      text += "\u2580";  // the upper half of a block
    }
    text += "\033[0m\n";
  }
  return text;
}

// ---- sixels ---------------------------------------------------------------------------------

constexpr int levels = 6;  // of each channel
constexpr int sixel_rows = 6;

/// Returns the number of a pixel's colour among 6 x 6 x 6. A pattern hides the steps between them.
int sixel_color(const BytePicture& picture, int x, int y) {
  constexpr int bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  const int threshold = (2 * bayer[y % 4][x % 4] + 1) * 255 / 32;
  int number = 0;
  for (std::size_t i = 0; i < 3; ++i)
    number = number * levels + (picture.at(x, y)[i] * (levels - 1) + threshold) / 255;
  return number;
}

void append_run(std::string& text, char sixel, int length) {
  text += length > 3 ? fmt::format("!{}{}", length, sixel)
                     : std::string(static_cast<std::size_t>(length), sixel);
}

/// Appends six rows: for each colour that they have, the pixels that have it.
void append_band(std::string& text, const BytePicture& picture, int top) {
  const int bottom = std::min(top + sixel_rows, picture.height);
  std::array<std::string, std::size_t{levels} * levels * levels> sixels;
  for (int y = top; y < bottom; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      std::string& row = sixels[static_cast<std::size_t>(sixel_color(picture, x, y))];
      constexpr char no_pixel = '?';
      if (row.empty()) row.assign(static_cast<std::size_t>(picture.width), no_pixel);
      char& sixel = row[static_cast<std::size_t>(x)];
      sixel = static_cast<char>(no_pixel + ((sixel - no_pixel) | 1 << (y - top)));
    }
  }
  for (std::size_t color = 0; color < sixels.size(); ++color) {
    const std::string& row = sixels[color];
    if (row.empty()) continue;
    text += fmt::format("#{}", color);
    for (std::size_t begin = 0; begin < row.size();) {
      const std::size_t end = std::min(row.find_first_not_of(row[begin], begin), row.size());
      append_run(text, row[begin], static_cast<int>(end - begin));
      begin = end;
    }
    text += '$';
  }
  text += '-';
}

std::string sixels(const BytePicture& picture) {
  std::string text = fmt::format("\033P0;1;0q\"1;1;{};{}", picture.width, picture.height);
  for (int i = 0; i < levels * levels * levels; ++i) {
    const auto percent = [](int level) { return 100 * level / (levels - 1); };
    text += fmt::format("#{};2;{};{};{}", i, percent(i / (levels * levels)),
                        percent(i / levels % levels), percent(i % levels));
  }
  for (int top = 0; top < picture.height; top += sixel_rows) append_band(text, picture, top);
  return text + "\033\\\n";
}

// ---- kitty ----------------------------------------------------------------------------------

/// Returns a PNG file in pieces of 4096 characters, the most that the protocol allows.
std::string kitty(const Image& image) {
  constexpr std::size_t most = 4096;
  const std::string file = text::base64(image.encode("png", {.colors_only = true}));
  std::string text;
  for (std::size_t at = 0; at < file.size(); at += most) {
    const int more_follows = at + most < file.size() ? 1 : 0;
    text += fmt::format("\033_G{}m={};{}\033\\", at == 0 ? "a=T,f=100," : "", more_follows,
                        file.substr(at, most));
  }
  return text + "\n";
}

}  // namespace

std::string terminal_picture(const Image& image) {
  const TerminalSize size = terminal_size();
  switch (terminal_graphics()) {
    case TerminalGraphics::kitty:
      return kitty(image);
    case TerminalGraphics::sixel: {
      constexpr int usual_pixels_across = 800;
      return sixels(
          fitted(image, size.pixels_across > 0 ? size.pixels_across : usual_pixels_across));
    }
    case TerminalGraphics::half_blocks:
      break;
  }
  return half_blocks(fitted(image, size.columns));
}

}  // namespace crt::cli
