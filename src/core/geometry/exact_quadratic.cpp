#include "core/geometry/exact_quadratic.hpp"

#include <utility>

namespace crt::core {

std::array<DoubleDouble, 2> ExactQuadratic::roots() const {
  // In q = -(b + sign(b) sqrt(discriminant)) both summands have one sign, so nothing cancels.
  const ScaledNumber half = sqrt(discriminant().rounded());
  const ScaledNumber q = b.sign() > 0 ? -(b.rounded() + half) : half + -b.rounded();
  if (q.value.hi == 0) return {};
  DoubleDouble first = (q / a.rounded()).unscaled();
  DoubleDouble second = (c.rounded() / q).unscaled();
  const bool first_is_larger = (b.sign() > 0) == (a.sign() < 0);
  if (first_is_larger) std::swap(first, second);
  return {first, second};
}

}  // namespace crt::core
