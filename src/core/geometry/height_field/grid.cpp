#include "core/geometry/height_field/grid.hpp"

#include <algorithm>
#include <cmath>

#include "crt/error.hpp"
#include "crt/image.hpp"
#include "crt/primitives.hpp"
#include "text/format.hpp"

namespace crt {

namespace {

[[noreturn]] void reject_grid(const std::string& message, const char* argument) {
  throw Error(ErrorCode::invalid_argument, message, argument);
}

}  // namespace

HeightGrid::HeightGrid(std::vector<double> heights, std::uint32_t columns, std::uint32_t rows)
    : heights_(std::move(heights)), columns_(columns), rows_(rows) {
  check();
  make_levels();
  find_ranges();
}

void HeightGrid::check() const {
  if (columns_ < 2) {
    reject_grid(
        text::format("a height field needs at least 2 columns of heights (it has {})", columns_),
        "columns");
  }
  if (rows_ < 2) {
    reject_grid(text::format("a height field needs at least 2 rows of heights (it has {})", rows_),
                "rows");
  }
  const std::uint64_t count = std::uint64_t{columns_} * rows_;
  if (count > most_heights) {
    reject_grid(
        text::format("a height field has at most {} heights (it has {})", most_heights, count),
        "heights");
  }
  if (heights_.size() != count) {
    reject_grid(text::format("{} columns and {} rows need {} heights, not {}", columns_, rows_,
                             count, heights_.size()),
                "heights");
  }
  const auto wrong = std::find_if(heights_.begin(), heights_.end(),
                                  [](double height) { return !(height >= 0 && height <= 1); });
  if (wrong != heights_.end()) {
    const auto place = static_cast<std::size_t>(wrong - heights_.begin());
    reject_grid(text::format("heights must be from 0 to 1 (in column {} of row {} there is {})",
                             place % columns_, place / columns_, *wrong),
                "heights");
  }
  if (std::all_of(heights_.begin(), heights_.end(), [](double height) { return height == 0; })) {
    reject_grid("heights must not all be 0: there is nothing below them", "heights");
  }
}

void HeightGrid::make_levels() {
  levels_.push_back({.width = columns_ - 1, .depth = rows_ - 1});
  std::size_t count = 0;
  do {
    const std::uint32_t width = (levels_.back().width + parts_a_side - 1) / parts_a_side;
    const std::uint32_t depth = (levels_.back().depth + parts_a_side - 1) / parts_a_side;
    const bool has_ranges = levels_.size() > 1;
    levels_.push_back({.width = width, .depth = depth, .begin = count});
    if (has_ranges) count += std::size_t{width} * depth;
  } while (levels_.back().width > 1 || levels_.back().depth > 1);
  ranges_.resize(count);
}

/// Finds the ranges of blocks, level by level.
void HeightGrid::find_ranges() {
  lowest_ = *std::min_element(heights_.begin(), heights_.end());
  heights_.reserve(heights_.size() + parts_a_side);  // not twice as many
  heights_.resize(heights_.size() + parts_a_side);
  if (top_level() < 2) return;
  for (std::uint32_t z = 0; z < levels_[1].depth; ++z) {
    for (std::uint32_t x = 0; x < levels_[1].width; ++x) find_range(x, z);
  }
  for (std::uint32_t level = 3; level < levels_.size(); ++level) {
    const Level& parts = levels_[level - 1];
    for (std::uint32_t z = 0; z < parts.depth; ++z) {
      for (std::uint32_t x = 0; x < parts.width; ++x) {
        const Ranges& part = ranges(level - 1, x, z);
        set_range(level, x, z, *std::min_element(part.low.begin(), part.low.end()),
                  *std::max_element(part.high_less_1.begin(), part.high_less_1.end()));
      }
    }
  }
}

/// Finds the range of a block of level 1, outwards.
void HeightGrid::find_range(std::uint32_t x, std::uint32_t z) {
  double low = 1;
  double high = 0;
  const std::uint32_t last_row = std::min(parts_a_side * (z + 1), rows_ - 1);
  const std::uint32_t last_column = std::min(parts_a_side * (x + 1), columns_ - 1);
  for (std::uint32_t row = parts_a_side * z; row <= last_row; ++row) {
    for (std::uint32_t column = parts_a_side * x; column <= last_column; ++column) {
      low = std::min(low, height(column, row));
      high = std::max(high, height(column, row));
    }
  }
  const bool is_on_border =
      x == 0 || z == 0 || x + 1 == levels_[1].width || z + 1 == levels_[1].depth;
  constexpr double steps = 1 / Ranges::step;
  const double lower = is_on_border ? 0 : std::min(std::floor(steps * low), steps - 1);
  const double upper = std::max(std::ceil(steps * high), 1.0);
  set_range(2, x, z, static_cast<std::uint16_t>(lower), static_cast<std::uint16_t>(upper - 1));
}

/// Sets the range of a part of a block: part (x, z) of the level below.
void HeightGrid::set_range(std::uint32_t level, std::uint32_t x, std::uint32_t z, std::uint16_t low,
                           std::uint16_t high_less_1) {
  const Level& blocks = levels_[level];
  Ranges& ranges =
      ranges_[blocks.begin + std::size_t{z / parts_a_side} * blocks.width + x / parts_a_side];
  const std::size_t part = parts_a_side * (z % parts_a_side) + x % parts_a_side;
  ranges.low[part] = low;
  ranges.high_less_1[part] = high_less_1;
}

std::size_t HeightGrid::bytes() const {
  return sizeof *this + heights_.capacity() * sizeof(double) + levels_.capacity() * sizeof(Level) +
         ranges_.capacity() * sizeof(Ranges);
}

std::shared_ptr<const HeightGrid> make_height_grid(std::vector<double> heights,
                                                   std::uint32_t columns, std::uint32_t rows) {
  return std::make_shared<const HeightGrid>(std::move(heights), columns, rows);
}

std::shared_ptr<const HeightGrid> make_height_grid(const Image& image) {
  const auto columns = static_cast<std::uint32_t>(image.width());
  const auto rows = static_cast<std::uint32_t>(image.height());
  std::vector<double> heights;
  heights.reserve(std::size_t{columns} * rows);
  for (int y = image.height(); y-- > 0;) {
    for (int x = 0; x < image.width(); ++x) {
      const Color color = image.at(x, y);
      heights.push_back((color.r + color.g + color.b) / 3);
    }
  }
  return make_height_grid(std::move(heights), columns, rows);
}

}  // namespace crt
