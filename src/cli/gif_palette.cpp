// The colours are chosen by median cut (Heckbert, "Color image quantization for frame buffer
// display", SIGGRAPH 1982), on colours of 5 bits a channel.
#include "cli/gif_palette.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace crt::cli {

namespace {

constexpr int bits = 5;
constexpr int lost_bits = 8 - bits;
constexpr std::size_t cells = std::size_t{1} << (3 * bits);
constexpr std::size_t most_colors = 256;

using Color = std::array<int, 3>;

/// Holds the pixels whose colours are the same in their 5 upper bits.
struct Cell {
  std::size_t place = 0;
  std::int64_t count = 0;
  std::array<std::int64_t, 3> sum{};

  int upper_bits(std::size_t channel) const {
    return static_cast<int>(place >> (bits * channel)) & ((1 << bits) - 1);
  }
};

std::size_t cell_of(const Color& color) {
  std::size_t place = 0;
  for (std::size_t channel = 0; channel < 3; ++channel)
    place |= static_cast<std::size_t>(color[channel] >> lost_bits) << (bits * channel);
  return place;
}

Color color_at(const std::vector<std::uint8_t>& rgb, std::size_t pixel) {
  return {rgb[3 * pixel], rgb[3 * pixel + 1], rgb[3 * pixel + 2]};
}

std::vector<Cell> used_cells(const std::vector<std::uint8_t>& rgb) {
  std::vector<Cell> all(cells);
  for (std::size_t pixel = 0; pixel < rgb.size() / 3; ++pixel) {
    const Color color = color_at(rgb, pixel);
    Cell& cell = all[cell_of(color)];
    ++cell.count;
    for (std::size_t channel = 0; channel < 3; ++channel) cell.sum[channel] += color[channel];
  }
  std::vector<Cell> used;
  for (std::size_t place = 0; place < cells; ++place) {
    all[place].place = place;
    if (all[place].count > 0) used.push_back(all[place]);
  }
  return used;
}

/// A Box is a range of cells that will have one colour.
struct Box {
  std::size_t begin = 0;
  std::size_t end = 0;
  std::size_t longest_channel = 0;
  std::int64_t weight = 0;  ///< pixels times the length of the longest side; 0 for a single cell
};

Box box_of(const std::vector<Cell>& used, std::size_t begin, std::size_t end) {
  Box box{.begin = begin, .end = end};
  std::int64_t count = 0;
  for (std::size_t i = begin; i < end; ++i) count += used[i].count;
  int longest = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    int least = 1 << bits;
    int most = 0;
    for (std::size_t i = begin; i < end; ++i) {
      least = std::min(least, used[i].upper_bits(channel));
      most = std::max(most, used[i].upper_bits(channel));
    }
    if (most - least <= longest) continue;
    longest = most - least;
    box.longest_channel = channel;
  }
  box.weight = count * longest;
  return box;
}

/// Cuts a box across its longest side so that both parts have about as many pixels.
std::pair<Box, Box> cut(std::vector<Cell>& used, const Box& box) {
  const auto first = used.begin() + static_cast<std::ptrdiff_t>(box.begin);
  const auto last = used.begin() + static_cast<std::ptrdiff_t>(box.end);
  std::sort(first, last, [&](const Cell& a, const Cell& b) {
    const std::pair left(a.upper_bits(box.longest_channel), a.place);
    return left < std::pair(b.upper_bits(box.longest_channel), b.place);
  });
  std::int64_t all = 0;
  for (std::size_t i = box.begin; i < box.end; ++i) all += used[i].count;
  std::size_t middle = box.begin + 1;
  std::int64_t below = used[box.begin].count;
  while (middle + 1 < box.end && 2 * below < all) below += used[middle++].count;
  return {box_of(used, box.begin, middle), box_of(used, middle, box.end)};
}

std::vector<Color> chosen_colors(std::vector<Cell> used) {
  std::vector<Box> boxes{box_of(used, 0, used.size())};
  while (boxes.size() < most_colors) {
    const auto largest = std::max_element(
        boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.weight < b.weight; });
    if (largest->weight == 0) break;
    const auto [low, high] = cut(used, *largest);
    *largest = low;
    boxes.push_back(high);
  }
  std::vector<Color> colors;
  for (const Box& box : boxes) {
    std::int64_t count = 0;
    std::array<std::int64_t, 3> sum{};
    for (std::size_t i = box.begin; i < box.end; ++i) {
      count += used[i].count;
      for (std::size_t channel = 0; channel < 3; ++channel) sum[channel] += used[i].sum[channel];
    }
    Color& color = colors.emplace_back();
    for (std::size_t channel = 0; channel < 3; ++channel)
      color[channel] = static_cast<int>((sum[channel] + count / 2) / count);
  }
  return colors;
}

std::uint8_t nearest(const std::vector<Color>& colors, const Color& color) {
  int least = 3 * 256 * 256;
  std::size_t best = 0;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    int squares = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int difference = colors[i][channel] - color[channel];
      squares += difference * difference;
    }
    if (squares >= least) continue;
    least = squares;
    best = i;
  }
  return static_cast<std::uint8_t>(best);
}

/// Returns the step of a 4 x 4 Bayer matrix at a pixel, from -8 to 7.
int dither_step(std::size_t x, std::size_t y) {
  constexpr int bayer[4][4] = {{0, 8, 2, 10}, {12, 4, 14, 6}, {3, 11, 1, 9}, {15, 7, 13, 5}};
  return bayer[y % 4][x % 4] - 8;
}

}  // namespace

PalettePicture with_palette(const std::vector<std::uint8_t>& rgb, int width) {
  const std::vector<Cell> used = used_cells(rgb);
  const std::vector<Color> colors = chosen_colors(used);
  PalettePicture picture;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel)
      picture.colors[3 * i + channel] = static_cast<std::uint8_t>(colors[i][channel]);
  }
  // With few colours each has one of its own, and nothing is to be hidden.
  const int strength = used.size() <= most_colors ? 0 : 1;
  std::vector<int> known(cells, -1);
  picture.indices.resize(rgb.size() / 3);
  for (std::size_t pixel = 0; pixel < picture.indices.size(); ++pixel) {
    Color color = color_at(rgb, pixel);
    const int step = strength * dither_step(pixel % static_cast<std::size_t>(width),
                                            pixel / static_cast<std::size_t>(width));
    for (int& value : color) value = std::clamp(value + step, 0, 255);
    int& index = known[cell_of(color)];
    if (index < 0) {
      constexpr int half_a_cell = 1 << (lost_bits - 1);
      Color middle = color;
      for (int& value : middle) value = (value >> lost_bits << lost_bits) + half_a_cell;
      index = nearest(colors, strength == 0 ? color : middle);
    }
    picture.indices[pixel] = static_cast<std::uint8_t>(index);
  }
  return picture;
}

}  // namespace crt::cli
