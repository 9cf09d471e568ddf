#include "core/shading/prepared_light.hpp"

#include <cmath>
#include <crt/elementary.hpp>
#include <limits>

#include "core/math/direction_and_length.hpp"

namespace crt::core {

namespace {

/// This bound keeps results finite right at a light, where falloff / D^2 has no bound.
constexpr double largest_intensity = 0x1p100;

}  // namespace

PreparedLight::PreparedLight(const Light& light, FalloffModel falloff_model)
    : PreparedLight(std::visit([](const auto& kind) { return PreparedLight(kind); }, light)) {
  counts_path_ = falloff_model == FalloffModel::path;
}

PreparedLight::PreparedLight(const PointLight& light)
    : kind_(Kind::point),
      color_(rgb(light.color)),
      ambient_(light.ambient),
      falloff_(light.falloff),
      origin_(light.origin) {}

PreparedLight::PreparedLight(const ParallelLight& light)
    : kind_(Kind::parallel),
      color_(rgb(light.color)),
      ambient_(light.ambient),
      axis_(direction_and_length(light.pointing - light.from).direction) {}

PreparedLight::PreparedLight(const SpotLight& light)
    : kind_(Kind::spot),
      color_(rgb(light.color)),
      ambient_(light.ambient),
      falloff_(light.falloff),
      origin_(light.origin),
      axis_(direction_and_length(light.pointing - light.origin).direction) {
  // These are 1 - cos a = 2 sin^2(a / 2), and cos i - cos o = 2 sin((o + i) / 2) sin((o - i) / 2).
  const double rim = light.angle / 2;
  const double full = rim - light.penumbra;
  rim_versine_ = 2 * elementary::sin(rim / 2) * elementary::sin(rim / 2);
  fading_versine_ = 2 * elementary::sin((rim + full) / 2) * elementary::sin(light.penumbra / 2);
}

PreparedLight::PreparedLight(const CylinderLight& light)
    : kind_(Kind::cylinder),
      color_(rgb(light.color)),
      ambient_(light.ambient),
      falloff_(light.falloff),
      origin_(light.origin),
      axis_(direction_and_length(light.pointing - light.origin).direction),
      radius_(light.radius) {}

LaneMask PreparedLight::sample(const VectorLanes& points, const Lanes& path_lengths,
                               LightSamples& light) const {
  light.intensities = lanes_of(1);
  if (kind_ == Kind::parallel) {
    light.directions = lanes_of(-axis_);
    light.distances = lanes_of(std::numeric_limits<double>::infinity());
    return light.distances > 0.0;
  }
  if (kind_ == Kind::cylinder) {
    light.directions = lanes_of(-axis_);
    light.distances = way_in_cylinder(points);
  } else {
    directions_and_lengths(lanes_of(origin_) - points, light.directions, light.distances);
  }
  if (kind_ == Kind::spot) light.intensities = cone_share(light.directions);
  if (falloff_ > 0) {
    const Lanes distance = counts_path_ ? path_lengths + light.distances : light.distances;
    light.intensities *= min(lanes_of(largest_intensity), falloff_ / (distance * distance));
  }
  return light.distances > 0.0;
}

Lanes PreparedLight::way_in_cylinder(const VectorLanes& points) const {
  const VectorLanes axis = lanes_of(axis_);
  const VectorLanes from_origin = points - lanes_of(origin_);
  const Lanes along = dot(from_origin, axis);
  const VectorLanes from_axis = from_origin - along * axis;
  return select(dot(from_axis, from_axis) <= radius_ * radius_, along, Lanes{});
}

Lanes PreparedLight::cone_share(const VectorLanes& to_light) const {
  const VectorLanes difference = to_light + lanes_of(axis_);
  const Lanes versine = min(0.5 * dot(difference, difference), lanes_of(2));
  const Lanes share = (rim_versine_ - versine) / fading_versine_;
  const Lanes fading = share * share * (3.0 - 2.0 * share);
  const Lanes within_rim = select(versine <= rim_versine_ - fading_versine_, lanes_of(1), fading);
  return select(versine > rim_versine_, Lanes{}, within_rim);
}

}  // namespace crt::core
