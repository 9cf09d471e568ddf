// This is what solids that are made of profiles ask them.
#pragma once

#include "core/geometry/bounds.hpp"
#include "crt/primitives.hpp"

namespace crt::core {

/// Returns the contours that a profile was made of.
const std::vector<Contour>& contours_of(const Profile& profile);
/// Returns the box around it, in the plane z = 0.
const Bounds& bounds_of(const Profile& profile);

}  // namespace crt::core
