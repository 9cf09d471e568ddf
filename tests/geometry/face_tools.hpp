// Tests of face functions share boxes, and what is said of their points.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/face_functions.hpp"
#include "crt/primitives.hpp"

namespace crt::test {

inline core::PointOf<core::Interval> box_about(const Vec3& middle, const Vec3& reach) {
  const Vec3 lower = middle - reach;
  const Vec3 upper = middle + reach;
  return {core::Interval{lower.x, upper.x}, core::Interval{lower.y, upper.y},
          core::Interval{lower.z, upper.z}};
}

/// Returns what faces near a box say of a point, if they say it plainly.
inline std::optional<bool> said_of(const core::FaceFunctions& functions,
                                   const core::NearFaces& near, const Vec3& point) {
  using enum core::NearFaces::Kind;
  if (near.kind == outside) return false;
  if (near.kind == inside) return true;
  if (near.kind == unknown) return std::nullopt;
  if (near.kind == by_signs) {
    std::uint32_t negative = 0;
    std::uint32_t open = 0;
    for (std::size_t i = 0; i < near.faces.size(); ++i) {
      const core::Interval value = functions.value(near.faces[i], core::known_point(point));
      if (value.hi < 0) negative |= 1U << i;
      if (value.contains(0)) open |= 1U << i;
    }
    const auto is_inside = [&](std::uint32_t some) {
      return (near.inside >> (negative | some) & 1U) != 0;
    };
    for (std::uint32_t some = open; some != 0; some = (some - 1) & open)
      if (is_inside(some) != is_inside(0)) return std::nullopt;
    return is_inside(0);
  }
  const bool is_all = near.kind == where_all_negative;
  bool is_open = false;
  for (const std::uint32_t face : near.faces) {
    const core::Interval value = functions.value(face, core::known_point(point));
    if (is_all ? value.lo > 0 : value.hi < 0) return !is_all;
    is_open = is_open || value.contains(0);
  }
  if (is_open) return std::nullopt;
  return is_all;
}

inline core::PointOf<core::Jet> as_jets(const core::PointOf<core::Interval>& box) {
  core::PointOf<core::Jet> point;
  for (std::size_t i = 0; i < 3; ++i) {
    point[i] = {.value = box[i], .slope = {}};
    point[i].slope[i] = core::Interval::of(1);
  }
  return point;
}

inline std::shared_ptr<const Profile> profile_of(const Contour& contour) {
  return make_profile(std::vector<Contour>{contour});
}

}  // namespace crt::test
