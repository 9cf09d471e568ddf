// Points of a plane, such as the picture's or the lens's, have two coordinates.
#pragma once

#include <cstddef>

#include "core/math/lanes.hpp"

namespace crt::core {

template <class Real>
struct PlanePointOf {
  Real x{};
  Real y{};
};
using PlanePoint = PlanePointOf<double>;
/// PlanePointLanes are as many points side by side as there are lanes.
using PlanePointLanes = PlanePointOf<Lanes>;

inline void set_lane(PlanePointLanes& points, std::size_t lane, const PlanePoint& point) {
  points.x[lane] = point.x;
  points.y[lane] = point.y;
}

inline PlanePoint lane_of(const PlanePointLanes& points, std::size_t lane) {
  return {points.x[lane], points.y[lane]};
}

}  // namespace crt::core
