#include "core/shading/prepared_light.hpp"

#include <algorithm>
#include <array>
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

/// Returns how far an ellipse reaches along each coordinate.
Vec3 ellipse_extents(const Vec3& half_axis_a, const Vec3& half_axis_b) {
  Vec3 extents;
  for (int i = 0; i < 3; ++i) extents[i] = elementary::hypot(half_axis_a[i], half_axis_b[i]);
  return extents;
}

}  // namespace

PreparedLight::PreparedLight(const Light& light, FalloffModel falloff_model,
                             const Environment* environment)
    : PreparedLight(std::visit([](const auto& kind) { return PreparedLight(kind); }, light)) {
  counts_path_ = falloff_model == FalloffModel::path;
  environment_ = environment;
  is_found_by_rays_ = is_visible_ || kind_ == Kind::environment;
}

PreparedLight::PreparedLight(const SurfacePiece& piece, const Rgb& radiance, bool is_two_sided)
    : kind_(Kind::sphere),
      color_(radiance),
      ambient_(0),
      origin_(piece.origin),
      radius_(piece.radius),
      has_size_(true),
      is_found_by_rays_(true),
      is_two_sided_(is_two_sided),
      edge_a_(piece.edge_a),
      edge_b_(piece.edge_b) {
  const double parallelogram = glm::length(glm::cross(edge_a_, edge_b_));
  switch (piece.kind) {
    case SurfacePiece::Kind::sphere:
      break;
    case SurfacePiece::Kind::disc:
      kind_ = Kind::disc;
      set_flat(piece.normal, std::numbers::pi * parallelogram);
      break;
    case SurfacePiece::Kind::parallelogram:
      kind_ = Kind::rectangle;
      set_flat(piece.normal, parallelogram);
      break;
    case SurfacePiece::Kind::triangle:
      kind_ = Kind::triangle;
      set_flat(piece.normal, parallelogram / 2);
      break;
    case SurfacePiece::Kind::tube: {
      kind_ = Kind::tube;
      const auto [direction, length] = direction_and_length(edge_a_);
      axis_ = direction;
      area_over_pi_ = 2 / std::numbers::pi * radius_ * length;
      break;
    }
  }
}

void PreparedLight::set_flat(const Vec3& normal, double area) {
  axis_ = normal;
  area_over_pi_ = area / std::numbers::pi;
  set_rectangle_around(area);
}

/// Finds the rectangle along edge_a that holds the light.
void PreparedLight::set_rectangle_around(double area) {
  const auto [x, length] = direction_and_length(edge_a_);
  const Vec3 y = glm::cross(axis_, x);
  const double skew = glm::dot(edge_b_, x);
  const double across = glm::dot(edge_b_, y);
  std::array<double, 4> along = {0, length, skew, length + skew};
  if (kind_ == Kind::triangle) along[3] = 0;
  const auto [left, right] = std::minmax_element(along.begin(), along.end());
  const double bottom = std::min(0.0, across);
  RectangleFrame frame{
      .x = x, .y = y, .z = axis_, .width = *right - *left, .height = std::abs(across)};
  Vec3 corner = origin_ + *left * x + bottom * y;
  if (kind_ == Kind::disc) {
    // The square about an ellipse's axes holds it, whatever their angle.
    const double width = elementary::hypot(length, skew);
    corner = origin_ - width * x - std::abs(across) * y;
    frame.width = 2 * width;
    frame.height = 2 * std::abs(across);
  }
  constexpr double best_fit = 2.5;
  if (frame.width * frame.height > best_fit * area) return;
  around_ = frame;
  corner_ = corner;
  // Rays beside the light are noise, which pays only where its own places differ more.
  constexpr double rounding = 0x1p-40;
  fills_around_ = area >= (1 - rounding) * frame.width * frame.height;
  near_ = (fills_around_ ? 4 : 0.5) * elementary::hypot(frame.width, frame.height);
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
      is_two_sided_(light.two_sided) {
  const NormalFrame<double> frame(axis_);
  edge_a_ = radius_ * frame.x;
  edge_b_ = radius_ * frame.y;
  set_flat(axis_, std::numbers::pi * radius_ * radius_);
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
  set_flat(normal, length_a * length_b * sine);
}

PreparedLight::PreparedLight(const EnvironmentLight& light)
    : kind_(Kind::environment), color_(light.scale), ambient_(0), has_size_(true) {}

LightMet PreparedLight::meet(const RayLanes& lines) const {
  return kind_ == Kind::sphere ? meet_sphere(lines) : meet_plane(lines);
}

LaneMask PreparedLight::holds(const VectorLanes& places) const {
  // By Cramer's rule each is u a + v b.
  const VectorLanes axis = lanes_of(axis_);
  const VectorLanes a = lanes_of(edge_a_);
  const VectorLanes b = lanes_of(edge_b_);
  const Lanes whole = dot(cross(a, b), axis);
  const Lanes u = dot(cross(places, b), axis) / whole;
  const Lanes v = dot(cross(a, places), axis) / whole;
  if (kind_ == Kind::disc) return u * u + v * v < 1.0;
  const LaneMask is_after = u >= 0.0 && v >= 0.0;
  if (kind_ == Kind::triangle) return is_after && u + v <= 1.0;
  return is_after && u <= 1.0 && v <= 1.0;
}

LightExtent PreparedLight::extent() const {
  LightExtent extent{
      .bounds = {}, .axis = kind_ == Kind::tube ? Vec3(0) : axis_, .is_two_sided = is_two_sided_};
  double area = std::numbers::pi * area_over_pi_;
  switch (kind_) {
    case Kind::disc:
      extent.bounds.include_around(origin_, ellipse_extents(edge_a_, edge_b_));
      break;
    case Kind::rectangle:
      extent.bounds.include(origin_ + edge_a_ + edge_b_);
      [[fallthrough]];
    case Kind::triangle:
      for (const Vec3& corner : {origin_, origin_ + edge_a_, origin_ + edge_b_})
        extent.bounds.include(corner);
      break;
    case Kind::tube: {
      const NormalFrame<double> frame(axis_);
      const Vec3 extents = ellipse_extents(radius_ * frame.x, radius_ * frame.y);
      extent.bounds.include_around(origin_, extents);
      extent.bounds.include_around(origin_ + edge_a_, extents);
      break;
    }
    default:
      extent.bounds.include_around(origin_, Vec3(radius_));
      area = std::numbers::pi * radius_ * radius_;
  }
  extent.strength = area * (color_.x + color_.y + color_.z);
  return extent;
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
  return {.met = met && holds(place), .t = t};
}

}  // namespace crt::core
