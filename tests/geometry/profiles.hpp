// Tests of profiles share these shapes.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/geometry/profile/profile.hpp"
#include "crt/error.hpp"
#include "geometry/oracle.hpp"
#include "geometry/scaled_profile.hpp"

namespace crt::test {

inline std::shared_ptr<const Profile> profile_of(const std::vector<Contour>& contours) {
  return make_profile(contours);
}

inline Contour rectangle(double left, double low, double right, double high) {
  return {{left, low}, {right, low}, {right, high}, {left, high}};
}

/// Returns a circle of two half circles, or of four quarters.
inline Contour circle(double x, double y, double radius, bool by_quarters = false) {
  if (!by_quarters) return {{x + radius, y, 1}, {x - radius, y, 1}};
  const double bulge = std::numbers::sqrt2 - 1;
  return {{x + radius, y, bulge},
          {x, y + radius, bulge},
          {x - radius, y, bulge},
          {x, y - radius, bulge}};
}

/// Returns corners around a middle, with arcs between some of them. Its contour may cross itself.
inline Contour random_contour(Random& random, double size) {
  const auto corners = 3 + random.bits() % 5;
  const double way = random.one_in(2) ? 1 : -1;
  Contour contour;
  for (std::uint64_t i = 0; i < corners; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(corners);
    const double angle = way * 2 * std::numbers::pi * share;
    const double distance = size * random.uniform(0.3, 1);
    ProfilePoint corner{.x = distance * std::cos(angle), .y = distance * std::sin(angle)};
    if (random.one_in(3)) corner.bulge = random.uniform(0.3, 1.2) * (random.one_in(2) ? 1 : -1);
    contour.push_back(corner);
  }
  return contour;
}

/// Returns one to three contours, of which some are within others.
inline std::vector<Contour> random_contours(Random& random, double size) {
  std::vector<Contour> contours;
  const auto count = 1 + random.bits() % 3;
  for (std::uint64_t i = 0; i < count; ++i) {
    contours.push_back(random_contour(random, size * std::pow(0.5, static_cast<double>(i))));
  }
  return contours;
}

/// Returns corners of small whole numbers, so that pieces touch, overlap and cross, with half and
/// quarter circles between some.
inline std::vector<Contour> whole_contours(Random& random) {
  const auto whole = [&] { return static_cast<double>(random.bits() % 7) - 3; };
  while (true) {
    std::vector<Contour> contours;
    const auto count = 1 + random.bits() % 3;
    for (std::uint64_t i = 0; i < count; ++i) {
      Contour contour;
      const auto corners = 2 + random.bits() % 6;
      for (std::uint64_t k = 0; k < corners; ++k) {
        ProfilePoint corner{.x = whole(), .y = whole()};
        if (random.one_in(3)) corner.bulge = random.one_in(2) ? 1 : -1;
        if (random.one_in(6)) corner.bulge = std::numbers::sqrt2 - 1;
        contour.push_back(corner);
      }
      contours.push_back(contour);
    }
    try {
      make_profile(contours);
      return contours;
    } catch (const Error&) {
      continue;
    }
  }
}

/// A RealProfile says what is in a profile by its definition, in quadruple precision.
class RealProfile {
 public:
  explicit RealProfile(std::shared_ptr<const Profile> profile) : profile_(std::move(profile)) {}

  /// Returns all parameters at which a line may cross a wall.
  std::vector<Real> candidates(const RealRay& ray) const {
    std::vector<Real> all;
    for (const Profile::Piece& piece : profile_->pieces()) {
      const RealVec along = RealVec(piece.to) - RealVec(piece.from);
      const auto roots = plane_roots(ray, {along.y, -along.x, 0}, RealVec(piece.from));
      all.insert(all.end(), roots.begin(), roots.end());
    }
    for (const Profile::Arc& arc : profile_->arcs()) {
      const RealVec d(ray.direction.x, ray.direction.y, 0);
      const RealVec offset(ray.origin.x - arc.center.x, ray.origin.y - arc.center.y, 0);
      const auto roots = quadratic_roots(dot(d, d), dot(d, offset),
                                         dot(offset, offset) - Real{arc.radius} * arc.radius);
      all.insert(all.end(), roots.begin(), roots.end());
    }
    return all;
  }

  bool contains(const RealVec& p) const {
    bool inside = false;
    for (const Profile::Piece& piece : profile_->pieces()) {
      const bool rises = piece.to.y > piece.from.y;
      if ((piece.from.y > p.y) != (piece.to.y > p.y) && is_left(piece, p) == rises) {
        inside = !inside;
      }
      if (piece.arc != core::invalid_index && is_in_segment(piece, p)) inside = !inside;
    }
    return inside;
  }

  /// Returns the distance from the nearest wall.
  Real distance(const RealVec& p) const {
    Real nearest = HUGE_VAL;
    const auto consider = [&](Real distance) { nearest = std::min(nearest, magnitude(distance)); };
    for (const Profile::Piece& piece : profile_->pieces()) {
      const RealVec from(piece.from);
      const RealVec along = RealVec(piece.to) - from;
      const RealVec offset(p.x - from.x, p.y - from.y, 0);
      if (piece.arc == core::invalid_index) {
        const Real share = std::clamp<Real>(dot(offset, along) / dot(along, along), 0, 1);
        consider(length(offset - share * along));
        continue;
      }
      const Profile::Arc& arc = profile_->arcs()[piece.arc];
      const RealVec to_center(p.x - arc.center.x, p.y - arc.center.y, 0);
      if (is_left(piece, p) != arc.is_right) consider(length(to_center) - arc.radius);
      consider(length(offset));
      consider(length(offset - along));
    }
    return nearest;
  }

 private:
  /// Points on the line of a piece count as those next to them on the side of x, or of y.
  static bool is_left(const Profile::Piece& piece, const RealVec& p) {
    const RealVec along = RealVec(piece.to) - RealVec(piece.from);
    const Real left = along.x * (p.y - piece.from.y) - along.y * (p.x - piece.from.x);
    if (left != 0) return left > 0;
    return along.y != 0 ? along.y < 0 : along.x > 0;
  }
  bool is_in_segment(const Profile::Piece& piece, const RealVec& p) const {
    const Profile::Arc& arc = profile_->arcs()[piece.arc];
    const RealVec offset(p.x - arc.center.x, p.y - arc.center.y, 0);
    return is_left(piece, p) != arc.is_right && dot(offset, offset) < Real{arc.radius} * arc.radius;
  }

  std::shared_ptr<const Profile> profile_;
};

}  // namespace crt::test
