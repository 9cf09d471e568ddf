// These functions make rays with directions of extreme length.
#pragma once

#include "oracle/ray_maker.hpp"

namespace crt::test {

/// Gives the direction an extreme length, and components that are extremely far apart.
void scale_direction(Counted& random, TestRay& ray);

/// Rounds the direction as lengthening it by ray.scale does.
void round_scaled(TestRay& ray);

}  // namespace crt::test
