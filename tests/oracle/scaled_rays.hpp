// Rays with directions of extreme length.
#pragma once

#include "oracle/ray_maker.hpp"

namespace crt::test {

/// Gives the direction an extreme length, and components that are extremely far apart.
void scale_direction(Counted& random, TestRay& ray);

/// Makes the direction what is left of it when it is lengthened by ray.scale.
void round_scaled(TestRay& ray);

}  // namespace crt::test
