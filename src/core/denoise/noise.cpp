#include "core/denoise/noise.hpp"

#include <cmath>

namespace crt::core {

namespace {

constexpr int radius = 2;  ///< of the pixels that are asked
constexpr std::size_t most_neighbours = std::size_t{2 * radius + 1} * (2 * radius + 1);

/// Neighbours whose surfaces are as far off as this are not asked.
constexpr float farthest_surface = 4;

/// Returns the square of what a pixel differs from the mean of its neighbours by.
float squared_residual(const PicturePlanes& planes, int x, int y) {
  constexpr std::array<std::array<int, 2>, 4> directions = {{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  const std::size_t place = planes.layout.index(x, y);
  std::array<float, 3> sums{};
  float count = 0;
  for (std::size_t pair = 0; pair < directions.size(); pair += 2) {
    bool are_alike = true;
    for (std::size_t i = pair; i < pair + 2; ++i) {
      const auto [dx, dy] = directions[i];
      const std::size_t other = planes.layout.index(x + dx, y + dy);
      are_alike = are_alike && planes.is_known[other] > 0 &&
                  SurfaceDistance(planes, dx, dy)(place, other) < farthest_surface;
    }
    if (!are_alike) continue;
    for (std::size_t i = pair; i < pair + 2; ++i) {
      const auto [dx, dy] = directions[i];
      const std::size_t other = planes.layout.index(x + dx, y + dy);
      for (std::size_t channel = 0; channel < 3; ++channel)
        sums[channel] += planes.light[channel][other];
      ++count;
    }
  }
  if (count == 0) return 0;
  float squares = 0;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const float difference = planes.light[channel][place] - sums[channel] / count;
    squares += difference * difference;
  }
  return squares / (1 + 1 / count);
}

/// Returns the variance that the pixels around one show. The largest differences are left out, as
/// they are those of edges. The factor makes up for that, for noise of Gauss' distribution.
float variance_around(const PicturePlanes& planes, std::span<const float> residuals, int x, int y) {
  constexpr float share = 0.6F;
  constexpr float factor = 4.66F;
  const std::size_t place = planes.layout.index(x, y);
  std::array<float, most_neighbours> squares;
  std::size_t count = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const std::size_t other = planes.layout.index(x + dx, y + dy);
      if (planes.is_known[other] == 0) continue;
      if (SurfaceDistance(planes, dx, dy)(place, other) >= farthest_surface) continue;
      squares[count++] = residuals[other];
    }
  }
  const auto kept = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<float>(count)));
  if (kept == 0) return 0;
  std::sort(squares.begin(), squares.begin() + static_cast<std::ptrdiff_t>(count));
  float sum = 0;
  for (std::ptrdiff_t i = 0; i < kept; ++i) sum += squares[static_cast<std::size_t>(i)];
  return factor * sum / static_cast<float>(kept);
}

/// Returns the mean of the variances of similar pixels around one.
float mean_variance(const PicturePlanes& planes, std::span<const float> own, int x, int y) {
  const std::size_t place = planes.layout.index(x, y);
  float weights = 0;
  float sum = 0;
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const std::size_t other = planes.layout.index(x + dx, y + dy);
      const float weight =
          planes.is_known[other] *
          weight_of(std::min(max_surface_distance, SurfaceDistance(planes, dx, dy)(place, other)));
      weights += weight;
      sum += weight * own[other];
    }
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

void find_residuals(const PicturePlanes& planes, int first_row, int last_row, Plane& squares) {
  for (int y = first_row; y < last_row; ++y) {
    for (int x = 0; x < planes.layout.width(); ++x)
      squares[planes.layout.index(x, y)] = squared_residual(planes, x, y);
  }
}

void find_variances(const PicturePlanes& planes, std::span<const Guide> guides,
                    std::span<const float> own, std::span<const float> residuals, int first_row,
                    int last_row, Plane& variances) {
  const int width = planes.layout.width();
  for (int y = first_row; y < last_row; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                static_cast<std::size_t>(x);
      const std::size_t place = planes.layout.index(x, y);
      if (planes.is_known[place] == 0) continue;
      variances[place] = guides[pixel].estimates < 2 ? variance_around(planes, residuals, x, y)
                                                     : mean_variance(planes, own, x, y);
    }
  }
}

}  // namespace crt::core
