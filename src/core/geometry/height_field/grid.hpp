// A grid of heights knows between which heights the squares of its cells are.
//
// Cell (x, z) is between the columns x and x + 1 and the rows z and z + 1. A *block* of level k is
// a square of 4^k by 4^k cells, or what there is of one at the upper ends. Its parts are 16 blocks
// of the level below. Source: the maximum mipmaps of Tevs, Ihrke, Seidel, Maximum mipmaps for fast,
// accurate, and scalable dynamic height field rendering, 2008, with the minimum as well.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace crt {

class HeightGrid {
 public:
  /// Throws Error (invalid_argument) as make_height_grid() says.
  HeightGrid(std::vector<double> heights, std::uint32_t columns, std::uint32_t rows);

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return rows_; }
  double height(std::uint32_t column, std::uint32_t row) const {
    return heights_[std::size_t{row} * columns_ + column];
  }
  /// Returns the heights from a column of a row on. There are at least four, of which those beyond
  /// the last column mean nothing.
  const double* heights_from(std::uint32_t column, std::uint32_t row) const {
    return &heights_[std::size_t{row} * columns_ + column];
  }
  double lowest() const { return lowest_; }

  /// A block has so many parts along x, and as many along z.
  static constexpr std::uint32_t parts_a_side = 4;
  static constexpr std::uint32_t parts_a_block = parts_a_side * parts_a_side;

  /// Ranges say between which heights the parts of a block are, along x and then along z. They are
  /// rounded outwards to multiples of 2^-16. What is not there has an empty one.
  struct alignas(64) Ranges {
    static constexpr double step = 0x1p-16;
    std::array<std::uint16_t, parts_a_block> low;            ///< in steps
    std::array<std::uint16_t, parts_a_block> high_less_1{};  ///< in steps, less 1

    Ranges() { low.fill(0xffff); }
  };

  /// Returns the level of the one block that has all cells.
  std::uint32_t top_level() const { return static_cast<std::uint32_t>(levels_.size()) - 1; }
  /// Returns how many blocks of a level there are along x and along z.
  std::uint32_t blocks_along_x(std::uint32_t level) const { return levels_[level].width; }
  std::uint32_t blocks_along_z(std::uint32_t level) const { return levels_[level].depth; }
  /// Returns between which heights the parts of a block of level 2 or more are. Parts on the border
  /// begin at 0.
  const Ranges& ranges(std::uint32_t level, std::uint32_t x, std::uint32_t z) const {
    const Level& blocks = levels_[level];
    return ranges_[blocks.begin + std::size_t{z} * blocks.width + x];
  }

  std::size_t bytes() const;

 private:
  struct Level {
    std::uint32_t width = 0;
    std::uint32_t depth = 0;
    std::size_t begin = 0;  ///< of its ranges
  };

  void check() const;
  void make_levels();
  void find_ranges();
  void find_range(std::uint32_t x, std::uint32_t z);
  void set_range(std::uint32_t level, std::uint32_t x, std::uint32_t z, std::uint16_t low,
                 std::uint16_t high_less_1);

  std::vector<double> heights_;  ///< and a few more, as four are read at once
  std::uint32_t columns_;
  std::uint32_t rows_;
  double lowest_ = 1;
  std::vector<Level> levels_;  ///< the first two have cells and squares of 16, and no ranges
  std::vector<Ranges> ranges_;
};

}  // namespace crt
