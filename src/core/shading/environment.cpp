#include "core/shading/environment.hpp"

#include <algorithm>
#include <numbers>
#include <span>

#include "core/math/quick_angle.hpp"
#include "core/shading/quick_sine.hpp"

namespace crt::core {

namespace {

constexpr std::size_t min_rows = 64;
constexpr std::size_t max_rows = 512;
/// Each cell is looked up at so many places a side.
constexpr std::size_t places_a_side = 2;
/// This share of the samples is drawn evenly, as the table does not know all that is in a cell.
constexpr double even_share = 0.1;

/// Returns the directions at places of the grid: turns about y and heights, both in [0, 1].
VectorLanes directions_at(const Lanes& turns, const Lanes& heights) {
  const Lanes level = sqrt(max(Lanes{}, 4.0 * heights * (1.0 - heights)));
  const auto [sine, cosine] = quick_sine_and_cosine((2 * std::numbers::pi) * turns);
  return {level * sine, 1.0 - 2.0 * heights, level * cosine};
}

/// Makes sums of what was there before each entry, divided by the whole.
void accumulate(std::span<double> entries) {
  double sum = 0;
  for (double& entry : entries) {
    const double before = sum;
    sum += entry;
    entry = before;
  }
  for (double& entry : entries) entry /= sum;
}

/// A Drawn is an entry that a number in [0, 1) has drawn.
struct Drawn {
  std::size_t entry;
  double rest;  ///< where in the entry, in [0, 1)
};
Drawn draw(std::span<const double> before, double number) {
  // Halving without branches, as nobody can predict where a random number leads.
  std::size_t entry = 0;
  for (std::size_t count = before.size() - 1; count > 1;) {
    const std::size_t half = count / 2;
    entry += before[entry + half] <= number ? half : 0;
    count -= half;
  }
  const double share = before[entry + 1] - before[entry];
  return {entry, std::min((number - before[entry]) / share, 1 - 0x1p-53)};
}

}  // namespace

Environment::Environment(const PreparedBackground& background)
    : background_(background),
      rows_(std::clamp(static_cast<std::size_t>(background.detail()), min_rows, max_rows)),
      columns_(2 * rows_),
      by_row_(rows_ + 1),
      by_column_(rows_ * (columns_ + 1)) {
  static_assert(places_a_side * places_a_side == lane_count);
  double whole = 0;
  for (std::size_t row = 0; row < rows_; ++row) {
    double* const cells = &by_column_[row * (columns_ + 1)];
    for (std::size_t column = 0; column < columns_; ++column) {
      Lanes turns;
      Lanes heights;
      for (std::size_t place = 0; place < lane_count; ++place) {
        const std::size_t above = place / places_a_side;
        const double across = 0.5 + static_cast<double>(place % places_a_side);
        const double down = 0.5 + static_cast<double>(above);
        turns[place] =
            (static_cast<double>(column) + across / places_a_side) / static_cast<double>(columns_);
        heights[place] =
            (static_cast<double>(row) + down / places_a_side) / static_cast<double>(rows_);
      }
      const ColorLanes colors =
          background_.colors(directions_at(turns, heights), (1u << lane_count) - 1);
      const Lanes light = colors.color.x + colors.color.y + colors.color.z;
      cells[column] = light[0] + light[1] + light[2] + light[3];
      whole += cells[column];
    }
  }
  soften();
  // Where all is black any density does.
  const double mean = whole / static_cast<double>(rows_ * columns_);
  const double least = whole > 0 ? even_share / (1 - even_share) * mean : 1;
  for (std::size_t row = 0; row < rows_; ++row) {
    const std::span cells(&by_column_[row * (columns_ + 1)], columns_ + 1);
    for (double& cell : cells.first(columns_)) by_row_[row] += cell += least;
    accumulate(cells);
  }
  accumulate(by_row_);
}

void Environment::soften() {
  const std::vector<double> sharp = by_column_;
  const auto of_row = [&](std::size_t row, std::size_t column) {
    const double* const cells = &sharp[row * (columns_ + 1)];
    return 0.25 * cells[(column + columns_ - 1) % columns_] + 0.5 * cells[column] +
           0.25 * cells[(column + 1) % columns_];
  };
  for (std::size_t row = 0; row < rows_; ++row) {
    const std::size_t above = row == 0 ? 0 : row - 1;
    const std::size_t below = std::min(row + 1, rows_ - 1);
    for (std::size_t column = 0; column < columns_; ++column) {
      by_column_[row * (columns_ + 1) + column] =
          0.25 * of_row(above, column) + 0.5 * of_row(row, column) + 0.25 * of_row(below, column);
    }
  }
}

void Environment::sample(const LightNumbers& numbers, LightSamples& light) const {
  Lanes turns;
  Lanes heights;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const Drawn row = draw(by_row_, numbers.v[lane]);
    const Drawn column = draw(
        std::span(by_column_).subspan(row.entry * (columns_ + 1), columns_ + 1), numbers.u[lane]);
    turns[lane] = (static_cast<double>(column.entry) + column.rest) / static_cast<double>(columns_);
    heights[lane] = (static_cast<double>(row.entry) + row.rest) / static_cast<double>(rows_);
    light.intensities[lane] = 4 / strength(row.entry, column.entry);
  }
  light.directions = directions_at(turns, heights);
  light.colors = background_.colors(light.directions, (1u << lane_count) - 1).color;
}

double Environment::strength(std::size_t row, std::size_t column) const {
  const double* const before = &by_column_[row * (columns_ + 1) + column];
  const double share = (by_row_[row + 1] - by_row_[row]) * (before[1] - before[0]);
  return share * static_cast<double>(rows_ * columns_);
}

Lanes Environment::densities(const VectorLanes& directions) const {
  const Lanes turn = quick_atan2(directions.x, directions.z) * (0.5 / std::numbers::pi);
  const Lanes columns = (turn - floor(turn)) * static_cast<double>(columns_);
  const Lanes rows = 0.5 * (1.0 - directions.y) * static_cast<double>(rows_);
  Lanes result;
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    const auto row =
        std::min(static_cast<std::size_t>(std::max(0.0, double{rows[lane]})), rows_ - 1);
    const auto column = std::min(static_cast<std::size_t>(columns[lane]), columns_ - 1);
    result[lane] = strength(row, column) / (4 * std::numbers::pi);
  }
  return result;
}

}  // namespace crt::core
