// Tests of revolutions share these profiles, which have no point beyond the axis.
#pragma once

#include <algorithm>
#include <memory>

#include "crt/validate.hpp"
#include "geometry/profiles.hpp"
#include "geometry/torus_oracle.hpp"

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

/// Returns all parameters at which a line may cross what a piece makes, or its arc.
inline std::vector<Real> wall_candidates(const Profile& profile, const Profile::Piece& piece,
                                         const RealRay& ray) {
  if (piece.arc != core::invalid_index) {
    const Profile::Arc& arc = profile.arcs()[piece.arc];
    const RealVec center(0, arc.center.y, 0);
    const Real ring = magnitude(arc.center.x);
    if (ring == 0) {
      const RealVec p = ray.origin - center;
      return quadratic_roots(dot(ray.direction, ray.direction), dot(p, ray.direction),
                             dot(p, p) - Real{arc.radius} * arc.radius);
    }
    return torus_candidates(ray, center, RealVec(0, 1, 0), ring, arc.radius);
  }
  const Real height = Real{piece.to.y} - piece.from.y;
  const Real width = Real{piece.to.x} - piece.from.x;
  if (height == 0) return plane_roots(ray, {0, 1, 0}, RealVec(piece.from));
  // These are about the point closest to the middle of the piece, for fewer roundings.
  const RealVec middle(0, (Real{piece.from.y} + piece.to.y) / 2, 0);
  const Real closest = -dot(ray.origin - middle, ray.direction) / dot(ray.direction, ray.direction);
  const RealVec p = ray.at(closest);
  const RealVec& d = ray.direction;
  const Real radius = height * piece.from.x + width * (p.y - piece.from.y);
  const Real rate = width * d.y;
  std::vector<Real> roots =
      quadratic_roots(height * height * (d.x * d.x + d.z * d.z) - rate * rate,
                      height * height * (p.x * d.x + p.z * d.z) - radius * rate,
                      height * height * (p.x * p.x + p.z * p.z) - radius * radius);
  for (Real& root : roots) root += closest;
  return roots;
}

inline RealVec in_profile(const RealVec& p) {
  return {square_root(p.x * p.x + p.z * p.z), p.y, 0};
}

}  // namespace crt::test
