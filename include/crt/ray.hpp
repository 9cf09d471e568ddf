// A Ray is what queries follow and what custom shapes are asked along.
#pragma once

#include <crt/vec.hpp>
#include <limits>

namespace crt {

/// A Ray is the points origin + t * direction with t_min < t < t_max. t is in units of the
/// direction's length, which may be any but 0. If the direction's components are more than 2^1022
/// apart, the smaller ones keep only the digits that doubles have at 2^-1022 of the largest. A hit
/// whose place is beyond the largest double does not count.
struct Ray {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
};

}  // namespace crt
