// Tests of revolutions share these profiles, which have no point beyond the axis.
#pragma once

#include <algorithm>
#include <memory>

#include "crt/validate.hpp"
#include "geometry/profiles.hpp"

namespace crt::test {

/// Returns a profile that `make` made, moved away from the axis. What is still beyond it is put
/// onto it.
template <class Make>
std::shared_ptr<const Profile> turned_profile(double move, const Make& make) {
  for (int i = 0; i < 1000; ++i) {
    std::vector<Contour> contours = make();
    for (Contour& contour : contours) {
      for (ProfilePoint& corner : contour) corner.x = std::max(corner.x + move, 0.0);
    }
    try {
      const auto profile = make_profile(contours);
      validate(Revolution{.profile = profile});
      return profile;
    } catch (const Error&) {
      continue;
    }
  }
  return profile_of({rectangle(1, 0, 2, 1)});
}

inline std::shared_ptr<const Profile> random_turned_profile(Random& random, double size) {
  return turned_profile(size * random.uniform(-0.5, 1.5),
                        [&] { return random_contours(random, size); });
}

/// Returns a profile of small whole numbers.
inline std::shared_ptr<const Profile> whole_turned_profile(Random& random) {
  return turned_profile(random.one_in(2) ? 3 : 1, [&] { return whole_contours(random); });
}

/// Returns an angle of which half are multiples of a quarter of a turn.
inline double random_turn(Random& random) {
  constexpr double quarter = std::numbers::pi / 2;
  if (random.one_in(3)) return 4 * quarter;
  if (random.one_in(3)) return quarter * static_cast<double>(1 + random.bits() % 4);
  return random.uniform(0.1, 4 * quarter);
}

}  // namespace crt::test
