// Affine maps are composed and inverted without rounding.
#pragma once

#include <array>

#include "core/math/dyadic_vector.hpp"
#include "core/math/precise_transform.hpp"

namespace crt::core {

struct DyadicTransform {
  std::array<DyadicVector, 3> rows{DyadicVector{1, 0, 0}, DyadicVector{0, 1, 0},
                                   DyadicVector{0, 0, 1}};
  DyadicVector translation;
};

DyadicTransform exactly(const Transform& transform);
DyadicTransform exactly(const PreciseTransform& transform);

/// Returns the map that applies `first` and then `second`.
DyadicTransform compose(const DyadicTransform& second, const DyadicTransform& first);

/// A DyadicInverse is the inverse of a map's linear part by Cramer's rule, with the division left
/// out: it is rows / weight. The map must have an inverse.
struct DyadicInverse {
  std::array<DyadicVector, 3> rows;
  Dyadic weight;  ///< > 0

  explicit DyadicInverse(const DyadicTransform& map);
  DyadicVector operator*(const DyadicVector& v) const {
    return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  }
};

}  // namespace crt::core
