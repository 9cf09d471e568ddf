// PreparedLight: how points see lights.
#include <cmath>
#include <crt/elementary.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "core/geometry/angles.hpp"
#include "core/math/direction_and_length.hpp"
#include "core/math/quick_angle.hpp"
#include "core/shading/environment.hpp"
#include "core/shading/microfacets.hpp"
#include "core/shading/prepared_light.hpp"

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

LaneMask PreparedLight::sample(const VectorLanes& points, const Lanes& path_lengths,
                               const LightNumbers& numbers, LightSamples& light,
                               LightView& view) const {
  const Lanes infinity = lanes_of(std::numeric_limits<double>::infinity());
  light.intensities = lanes_of(1);
  light.colors = lanes_of(color_);
  light.radii = Lanes{};
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
    case Kind::disc:
    case Kind::rectangle:
    case Kind::triangle:
      if (!std::exchange(view.is_known, true)) {
        view.near = are_near(points);
        if (any(view.near)) view.around.emplace(*around_, lanes_of(corner_) - points);
      }
      if (!all(view.near)) sample_flat(points, places(numbers), light);
      if (any(view.near)) sample_near(points, view, numbers, light);
      break;
    case Kind::tube:
      sample_tube(points, numbers, light);
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
  light.radii = lanes_of(radius_);
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

Lanes PreparedLight::shining_cosines(const VectorLanes& directions,
                                     const VectorLanes& normals) const {
  const Lanes towards = -dot(directions, normals);
  return is_two_sided_ ? abs(towards) : max(Lanes{}, towards);
}

void PreparedLight::sample_area(const VectorLanes& points, const VectorLanes& on_light,
                                const VectorLanes& normals, const Lanes& areas_over_pi,
                                LightSamples& light) const {
  directions_and_lengths(on_light - points, light.directions, light.distances);
  const Lanes cosine = shining_cosines(light.directions, normals);
  const Lanes squared = light.distances * light.distances;
  light.intensities = min(lanes_of(largest_intensity), areas_over_pi * cosine / squared);
  light.distances = select(cosine > 0.0, light.distances, Lanes{});
}

void PreparedLight::sample_flat(const VectorLanes& points, const VectorLanes& on_light,
                                LightSamples& light) const {
  sample_area(points, on_light, lanes_of(axis_), lanes_of(area_over_pi_), light);
}

VectorLanes PreparedLight::places(const LightNumbers& numbers) const {
  Lanes a = numbers.u;
  Lanes b = numbers.v;
  if (kind_ == Kind::disc) {
    const auto [x, y] = point_of_disc(numbers.u, numbers.v);
    a = x;
    b = y;
  } else if (kind_ == Kind::triangle) {
    // Source: Turk, Generating random points in triangles, Graphics Gems, 1990.
    const Lanes root = sqrt(numbers.u);
    a = 1.0 - root;
    b = numbers.v * root;
  }
  return lanes_of(origin_) + a * lanes_of(edge_a_) + b * lanes_of(edge_b_);
}

LaneMask PreparedLight::are_near(const VectorLanes& points) const {
  if (!around_) return LaneMask{};
  constexpr double flattest = 0x1p-20;  // Nearer to its plane it is hardly seen.
  const double squared = around_->width * around_->width + around_->height * around_->height;
  const Vec3 middle = corner_ + 0.5 * (around_->width * around_->x + around_->height * around_->y);
  const VectorLanes offset = points - lanes_of(middle);
  const Lanes height = dot(offset, lanes_of(axis_));
  return dot(offset, offset) < near_ * near_ && height * height > flattest * flattest * squared;
}

void PreparedLight::sample_near(const VectorLanes& points, const LightView& view,
                                const LightNumbers& numbers, LightSamples& light) const {
  const VectorLanes to_light = view.around->sample(numbers);
  VectorLanes directions;
  Lanes distances;
  directions_and_lengths(to_light, directions, distances);
  LaneMask found = shining_cosines(directions, lanes_of(axis_)) > 0.0;
  if (!fills_around_) found &= holds(points + to_light - lanes_of(origin_));
  distances = select(found, distances, Lanes{});
  light.directions = select(view.near, directions, light.directions);
  light.distances = select(view.near, distances, light.distances);
  const Lanes intensities = (1 / std::numbers::pi) * view.around->solid_angles();
  light.intensities = select(view.near, intensities, light.intensities);
}

PreparedLight::TubeView PreparedLight::view_of_tube(const VectorLanes& points) const {
  const VectorLanes axis = lanes_of(axis_);
  const VectorLanes from_origin = points - lanes_of(origin_);
  TubeView view;
  Lanes distances;
  directions_and_lengths(from_origin - dot(from_origin, axis) * axis, view.outwards, distances);
  view.across = cross(axis, view.outwards);
  const Lanes squared = max(Lanes{}, (distances - radius_) * (distances + radius_));
  view.half_angles = quick_atan2<Lanes>(sqrt(squared), lanes_of(radius_));
  return view;
}

void PreparedLight::sample_tube(const VectorLanes& points, const LightNumbers& numbers,
                                LightSamples& light) const {
  const TubeView view = view_of_tube(points);
  // Half of the angle is within an eighth of a turn.
  const auto [sine, cosine] =
      of_eighth_turns<Lanes>((2 / std::numbers::pi) * view.half_angles * (2.0 * numbers.u - 1.0));
  const VectorLanes normals =
      (1.0 - 2.0 * sine * sine) * view.outwards + (2.0 * sine * cosine) * view.across;
  const VectorLanes on_light =
      lanes_of(origin_) + numbers.v * lanes_of(edge_a_) + radius_ * normals;
  sample_area(points, on_light, normals, area_over_pi_ * view.half_angles, light);
  light.radii = lanes_of(radius_);
}

Lanes PreparedLight::densities(const RayLanes& lines, const Lanes& t) const {
  LightSamples light;
  const VectorLanes& points = lines.origin;
  switch (kind_) {
    case Kind::environment:
      return environment_->densities(lines.direction);
    case Kind::sphere:
      sample_ball(points, {}, light);  // all directions have one density
      break;
    case Kind::tube: {
      const VectorLanes axis = lanes_of(axis_);
      const VectorLanes place = lines.at(t) - lanes_of(origin_);
      const VectorLanes normals = (1 / radius_) * (place - dot(place, axis) * axis);
      sample_area(points, lines.at(t), normals, area_over_pi_ * view_of_tube(points).half_angles,
                  light);
      break;
    }
    default:
      sample_flat(points, lines.at(t), light);
  }
  if (const LaneMask near = are_near(points); any(near)) {
    const SphericalRectangle around(*around_, lanes_of(corner_) - points);
    light.intensities =
        select(near, (1 / std::numbers::pi) * around.solid_angles(), light.intensities);
  }
  return select(light.distances > 0.0, light.densities(), Lanes{});
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
