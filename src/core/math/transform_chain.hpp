// Transforms in one another: their product to about 106 bits, and without rounding for those who
// ask.
#pragma once

#include "core/math/dyadic_transform.hpp"
#include "core/math/precise_transform.hpp"

namespace crt::core {

/// A map that is composed of others. Where the product takes more than two doubles a number it
/// keeps what it is made of, so that the exact tier can find it as it is; nobody else pays for more
/// than two pointers.
struct TransformChain {
  PreciseTransform product;
  /// The map applies first `first` and then `second`, which must outlive it; none if the product is
  /// the map.
  const TransformChain* second = nullptr;
  const TransformChain* first = nullptr;
  int bits = 0;  ///< of the numbers of such a map, at most

  TransformChain() = default;
  explicit TransformChain(const Transform& transform) : product(transform) {}

  bool is_product() const { return second == nullptr; }
  /// Whether the map is twelve doubles.
  bool is_plain() const;
};

/// Numbers of more bits are rounded to those of the product: so much of what is nested as deeply as
/// anybody likes is meant to be exact.
inline constexpr int most_chain_bits = 1024;

/// The map that applies `first` and then `second`; both must outlive it unless it is_product().
TransformChain compose(const TransformChain& second, const TransformChain& first);

/// The map itself.
DyadicTransform exact_product(const TransformChain& chain);

}  // namespace crt::core
