#include "core/shading/prepared_light.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math/direction_and_length.hpp"

namespace crt::core {

namespace {

/// Keeps what is computed from it finite right at a light, where falloff / D^2 has no bound.
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
  // 1 - cos a = 2 sin^2(a / 2), and cos i - cos o = 2 sin((o + i) / 2) sin((o - i) / 2).
  const double rim = light.angle / 2;
  const double full = rim - light.penumbra;
  rim_versine_ = 2 * std::sin(rim / 2) * std::sin(rim / 2);
  fading_versine_ = 2 * std::sin((rim + full) / 2) * std::sin(light.penumbra / 2);
}

PreparedLight::PreparedLight(const CylinderLight& light)
    : kind_(Kind::cylinder),
      color_(rgb(light.color)),
      ambient_(light.ambient),
      falloff_(light.falloff),
      origin_(light.origin),
      axis_(direction_and_length(light.pointing - light.origin).direction),
      radius_(light.radius) {}

bool PreparedLight::sample(const Vec3& point, double path_length, LightSample& light) const {
  light.intensity = 1;
  if (kind_ == Kind::parallel) {
    light.direction = -axis_;
    light.distance = std::numeric_limits<double>::infinity();
    return true;
  }
  if (kind_ == Kind::cylinder) {
    light.direction = -axis_;
    light.distance = way_in_cylinder(point);
  } else {
    const DirectionAndLength to_light = direction_and_length(origin_ - point);
    light.direction = to_light.direction;
    light.distance = to_light.length;
  }
  if (!(light.distance > 0)) return false;
  if (kind_ == Kind::spot) light.intensity = cone_share(light.direction);
  if (falloff_ != 0) {
    const double way = counts_path_ ? path_length + light.distance : light.distance;
    light.intensity *= std::min(falloff_ / (way * way), largest_intensity);
  }
  return true;
}

double PreparedLight::way_in_cylinder(const Vec3& point) const {
  const Vec3 from_origin = point - origin_;
  const double along = glm::dot(from_origin, axis_);
  const Vec3 from_axis = from_origin - along * axis_;
  return glm::dot(from_axis, from_axis) <= radius_ * radius_ ? along : 0;
}

double PreparedLight::cone_share(const Vec3& to_light) const {
  const Vec3 difference = to_light + axis_;
  const double versine = std::min(2.0, 0.5 * glm::dot(difference, difference));
  if (versine > rim_versine_) return 0;
  if (versine <= rim_versine_ - fading_versine_) return 1;
  const double share = (rim_versine_ - versine) / fading_versine_;
  return share * share * (3 - 2 * share);
}

}  // namespace crt::core
