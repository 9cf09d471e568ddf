// The background is sampled as a light in proportion to its brightness.
#pragma once

#include <vector>

#include "core/shading/prepared_background.hpp"
#include "core/shading/prepared_light.hpp"

namespace crt::core {

/// An Environment is a table of how bright the background is in the cells of a grid over all
/// directions. Rows are of equal height in y and columns of equal angles about y, so that all cells
/// have the same solid angle (Archimedes).
///
/// Source: Pharr, Jakob, Humphreys, Physically based rendering, 4th edition, 2023, 12.5.
class Environment {
 public:
  /// The background must outlive it.
  explicit Environment(const PreparedBackground& background);

  /// Draws directions, with what comes from there: colours are radiances, and intensities are 1 /
  /// (pi density).
  void sample(const LightNumbers& numbers, LightSamples& light) const;

  /// Returns the densities with which sample() draws directions, by solid angle.
  Lanes densities(const VectorLanes& directions) const;

  /// Returns the bytes of memory that it takes.
  std::size_t bytes() const { return (by_row_.size() + by_column_.size()) * sizeof(double); }

 private:
  /// Spreads what is in each cell to its neighbours, too. The edge of a bright spot may be in a
  /// cell where all places that were looked at are dark, and a sample there would count far too
  /// much.
  void soften();
  /// Returns the probability of a cell over its share of all directions.
  double strength(std::size_t row, std::size_t column) const;

  const PreparedBackground& background_;
  std::size_t rows_;
  std::size_t columns_;
  std::vector<double> by_row_;     ///< the shares of the rows before each, and 1 at the end
  std::vector<double> by_column_;  ///< within each row, likewise
};

}  // namespace crt::core
