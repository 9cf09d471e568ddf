#include "core/shading/prepared_light.hpp"

#include <cmath>
#include <crt/elementary.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/geometry/angles.hpp"
#include "core/math/direction_and_length.hpp"
#include "core/shading/environment.hpp"
#include "core/shading/microfacets.hpp"

namespace crt::core {

namespace {

/// This bound keeps results finite right at a light, where falloff / D^2 has no bound.
constexpr double largest_intensity = 0x1p100;

/// Returns directions within a cone about an axis of unit length, spread evenly over it. The cone's
/// half angle has this versine, 1 - cos. Those of the directions from the axis go into `versines`.
///
/// Source: Shirley, Wang, Zimmerman, Monte Carlo techniques for direct lighting calculations, 1996.
VectorLanes directions_in_cone(const VectorLanes& axis, const Lanes& cone_versine,
                               const LightNumbers& numbers, Lanes& versines) {
  const auto [x, y] = point_of_disc(numbers.u, numbers.v);
  versines = (x * x + y * y) * cone_versine;
  const Lanes outwards =
      sqrt(cone_versine * (2.0 - versines));  // the sine, by distance on the disc
  const NormalFrame<Lanes> frame(axis);
  return (1.0 - versines) * axis + outwards * x * frame.x + outwards * y * frame.y;
}

}  // namespace

PreparedLight::PreparedLight(const Light& light, FalloffModel falloff_model,
                             const Environment* environment)
    : PreparedLight(std::visit([](const auto& kind) { return PreparedLight(kind); }, light)) {
  counts_path_ = falloff_model == FalloffModel::path;
  environment_ = environment;
}

PreparedLight::PreparedLight(const PointLight& light)
    : kind_(Kind::point),
      color_(rgb(light.color)),
      ambient_(light.ambient),
      falloff_(light.falloff),
      origin_(light.origin),
      radius_(light.radius),
      has_size_(light.radius > 0) {
  if (has_size_) kind_ = Kind::ball;
}

PreparedLight::PreparedLight(const ParallelLight& light)
    : kind_(Kind::parallel),
      color_(rgb(light.color)),
      ambient_(light.ambient),
      axis_(direction_and_length(light.pointing - light.from).direction),
      has_size_(light.angle > 0) {
  if (!has_size_) return;
  kind_ = Kind::sun;
  const double sine = elementary::sin(light.angle / 4);
  rim_versine_ = 2 * sine * sine;
}

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

PreparedLight::PreparedLight(const SphereLight& light)
    : kind_(Kind::sphere),
      color_(rgb(light.color)),
      ambient_(0),
      origin_(light.center),
      radius_(light.radius),
      has_size_(true),
      is_visible_(light.visible) {}

PreparedLight::PreparedLight(const DiscLight& light)
    : kind_(Kind::disc),
      color_(rgb(light.color)),
      ambient_(0),
      origin_(light.center),
      axis_(direction_and_length(light.normal).direction),
      radius_(light.radius),
      has_size_(true),
      is_visible_(light.visible),
      is_two_sided_(light.two_sided),
      area_over_pi_(light.radius * light.radius) {
  const NormalFrame<double> frame(axis_);
  edge_a_ = radius_ * frame.x;
  edge_b_ = radius_ * frame.y;
}

PreparedLight::PreparedLight(const RectangleLight& light)
    : kind_(Kind::rectangle),
      color_(rgb(light.color)),
      ambient_(0),
      origin_(light.corner),
      has_size_(true),
      is_visible_(light.visible),
      is_two_sided_(light.two_sided),
      edge_a_(light.edge_a),
      edge_b_(light.edge_b) {
  const auto [direction_a, length_a] = direction_and_length(light.edge_a);
  const auto [direction_b, length_b] = direction_and_length(light.edge_b);
  const auto [normal, sine] = direction_and_length(glm::cross(direction_a, direction_b));
  axis_ = normal;
  area_over_pi_ = length_a * length_b * sine / std::numbers::pi;
}

PreparedLight::PreparedLight(const EnvironmentLight& light)
    : kind_(Kind::environment), color_(light.scale), ambient_(0), has_size_(true) {}

LaneMask PreparedLight::sample(const VectorLanes& points, const Lanes& path_lengths,
                               const LightNumbers& numbers, LightSamples& light) const {
  const Lanes infinity = lanes_of(std::numeric_limits<double>::infinity());
  light.intensities = lanes_of(1);
  light.colors = lanes_of(color_);
  switch (kind_) {
    case Kind::parallel:
      light.directions = lanes_of(-axis_);
      light.distances = infinity;
      return light.distances > 0.0;
    case Kind::sun: {
      Lanes versines;
      light.directions =
          directions_in_cone(lanes_of(-axis_), lanes_of(rim_versine_), numbers, versines);
      light.distances = infinity;
      light.intensities = lanes_of(2 / (2 - rim_versine_));  // so that what faces it gets 1
      return light.distances > 0.0;
    }
    case Kind::cylinder:
      light.directions = lanes_of(-axis_);
      light.distances = way_in_cylinder(points);
      break;
    case Kind::point:
    case Kind::spot:
      directions_and_lengths(lanes_of(origin_) - points, light.directions, light.distances);
      break;
    case Kind::ball:
    case Kind::sphere:
      sample_ball(points, numbers, light);
      break;
    case Kind::environment:
      environment_->sample(numbers, light);
      light.colors = lanes_of(color_) * light.colors;
      light.distances = infinity;
      return light.distances > 0.0;
    case Kind::disc: {
      const auto [x, y] = point_of_disc(numbers.u, numbers.v);
      sample_flat(points, lanes_of(origin_) + x * lanes_of(edge_a_) + y * lanes_of(edge_b_), light);
      break;
    }
    case Kind::rectangle:
      sample_flat(points,
                  lanes_of(origin_) + numbers.u * lanes_of(edge_a_) + numbers.v * lanes_of(edge_b_),
                  light);
      break;
  }
  if (kind_ == Kind::spot) light.intensities = cone_share(light.directions);
  if (falloff_ > 0) {
    const Lanes distance = counts_path_ ? path_lengths + light.distances : light.distances;
    light.intensities *= min(lanes_of(largest_intensity), falloff_ / (distance * distance));
  }
  return light.distances > 0.0;
}

void PreparedLight::sample_ball(const VectorLanes& points, const LightNumbers& numbers,
                                LightSamples& light) const {
  VectorLanes to_center;
  Lanes distances;
  directions_and_lengths(lanes_of(origin_) - points, to_center, distances);
  const Lanes sine = min(radius_ / distances, lanes_of(1));
  const Lanes cosine = sqrt((1.0 - sine) * (1.0 + sine));
  const Lanes cone_versine = sine * sine / (1.0 + cosine);
  Lanes versines;
  light.directions = directions_in_cone(to_center, cone_versine, numbers, versines);
  // The chord's half is known by how far the direction passes from the center.
  const Lanes squared_sines = versines * (2.0 - versines);
  const Lanes passing = distances * sqrt(squared_sines);
  const Lanes half_chord = sqrt(max(Lanes{}, (radius_ - passing) * (radius_ + passing)));
  const Lanes to_surface = max(Lanes{}, distances * (1.0 - versines) - half_chord);
  const LaneMask is_outside = distances > radius_;
  if (kind_ == Kind::sphere) {
    light.distances = select(is_outside, to_surface, Lanes{});
    light.intensities = 2.0 * cone_versine;
    return;
  }
  // Points within are lit by the center.
  light.distances = select(is_outside, to_surface, distances);
  light.directions = select(is_outside, light.directions, to_center);
  light.intensities = select(is_outside, 2.0 / (1.0 + cosine), lanes_of(1));
}

void PreparedLight::sample_flat(const VectorLanes& points, const VectorLanes& on_light,
                                LightSamples& light) const {
  directions_and_lengths(on_light - points, light.directions, light.distances);
  const Lanes towards = -dot(light.directions, lanes_of(axis_));
  const Lanes cosine = is_two_sided_ ? abs(towards) : max(Lanes{}, towards);
  const Lanes squared = light.distances * light.distances;
  light.intensities = min(lanes_of(largest_intensity), area_over_pi_ * cosine / squared);
  light.distances = select(cosine > 0.0, light.distances, Lanes{});
}

LightMet PreparedLight::meet(const RayLanes& lines) const {
  return kind_ == Kind::sphere ? meet_sphere(lines) : meet_plane(lines);
}

Lanes PreparedLight::densities(const RayLanes& lines, const Lanes& t) const {
  LightSamples light;
  if (kind_ == Kind::environment) return environment_->densities(lines.direction);
  if (kind_ == Kind::sphere) {
    sample_ball(lines.origin, {}, light);  // all directions have one density
    return light.densities();
  }
  sample_flat(lines.origin, lines.at(t), light);
  return light.densities();
}

LightMet PreparedLight::meet_sphere(const RayLanes& lines) const {
  const VectorLanes to_center = lanes_of(origin_) - lines.origin;
  const Lanes squared_length = dot(lines.direction, lines.direction);
  const Lanes closest = dot(to_center, lines.direction) / squared_length;
  const VectorLanes passing = to_center - closest * lines.direction;
  const Lanes distance = sqrt(dot(passing, passing));
  const Lanes half_chord =
      sqrt(max(Lanes{}, (radius_ - distance) * (radius_ + distance)) / squared_length);
  const Lanes t = closest - half_chord;
  return {.met = distance < radius_ && t > 0.0, .t = t};
}

LightMet PreparedLight::meet_plane(const RayLanes& lines) const {
  const VectorLanes axis = lanes_of(axis_);
  const VectorLanes to_origin = lanes_of(origin_) - lines.origin;
  const Lanes speed = dot(lines.direction, axis);
  const Lanes t = dot(to_origin, axis) / speed;
  const VectorLanes place = t * lines.direction - to_origin;
  LaneMask met = t > 0.0 && t < std::numeric_limits<double>::infinity();
  if (!is_two_sided_) met = met && speed < 0.0;
  if (kind_ == Kind::disc) return {.met = met && dot(place, place) < radius_ * radius_, .t = t};
  // By Cramer's rule the place is u a + v b.
  const VectorLanes a = lanes_of(edge_a_);
  const VectorLanes b = lanes_of(edge_b_);
  const Lanes whole = dot(cross(a, b), axis);
  const Lanes u = dot(cross(place, b), axis) / whole;
  const Lanes v = dot(cross(a, place), axis) / whole;
  return {.met = met && u >= 0.0 && u <= 1.0 && v >= 0.0 && v <= 1.0, .t = t};
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
