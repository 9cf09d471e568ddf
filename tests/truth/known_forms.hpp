// These are random solids of which all is known by formulas, or by counting.
#pragma once

#include <cmath>
#include <string>

#include "crt/entity.hpp"
#include "geometry/random.hpp"

namespace crt::truth {

using test::Random;

/// A Known has what is known of a solid, to rounding.
struct Known {
  std::string name;
  Entity solid;
  double volume = 0;
  double area = 0;
  Vec3 centroid{0, 0, 0};  ///< if `has_centroid`
  bool has_centroid = false;
  /// The smallest box around it, if its corners are not NaN.
  Vec3 lower{NAN, NAN, NAN};
  Vec3 upper{NAN, NAN, NAN};
};

/// Returns a solid of a random kind and size.
Known random_known(Random& random);

}  // namespace crt::truth
