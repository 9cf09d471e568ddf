// Tests that scale primitives scale profiles by this.
#pragma once

#include <memory>
#include <vector>

#include "core/geometry/profile/profile.hpp"

namespace crt::test {

/// Returns a profile with all lengths times `factor`.
inline std::shared_ptr<const Profile> scaled_profile(const Profile& profile, double factor) {
  std::vector<Contour> contours = profile.contours();
  for (Contour& contour : contours) {
    for (ProfilePoint& corner : contour) {
      corner.x *= factor;
      corner.y *= factor;
    }
  }
  return make_profile(contours);
}

}  // namespace crt::test
