// Nested transforms are composed to about 106 bits, and without rounding for the exact tier.
#pragma once

#include "core/math/dyadic_transform.hpp"
#include "core/math/precise_transform.hpp"

namespace crt::core {

/// A TransformChain is a map that is composed of others. If the product takes more than two doubles
/// a number, the chain keeps the maps it is made of. From these the exact tier finds the exact
/// product. Other users pay for no more than two pointers.
struct TransformChain {
  PreciseTransform product;
  /// The map applies `first` and then `second`, which must outlive it. Both are null if `product`
  /// is the map.
  const TransformChain* second = nullptr;
  const TransformChain* first = nullptr;
  int bits = 0;  ///< a bound on the binary digits of the numbers of a map that is no product

  TransformChain() = default;
  explicit TransformChain(const Transform& transform) : product(transform) {}

  bool is_product() const { return second == nullptr; }
  /// Returns whether the map is twelve doubles.
  bool is_plain() const;
};

/// Numbers of more bits are rounded to those of the product. So exact products have a bounded size,
/// however deeply transforms are nested.
inline constexpr int max_chain_bits = 1024;

/// Returns the map that applies `first` and then `second`. Both must outlive it unless it
/// is_product().
TransformChain compose(const TransformChain& second, const TransformChain& first);

/// Returns the map without rounding.
DyadicTransform exact_product(const TransformChain& chain);

}  // namespace crt::core
