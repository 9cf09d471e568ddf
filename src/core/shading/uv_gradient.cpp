#include "core/shading/uv_gradient.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace crt::core {

namespace {

struct Uv {
  double u = 0;
  double v = 0;
};

/// The step is far smaller than what a bump shows, and far larger than the rounding of (u, v).
constexpr double step_of_size = 0x1p-16;

double step_on(const Shape& shape) {
  const Bounds bounds = shape.bounds();
  if (!bounds.finite()) return step_of_size;  // planes measure (u, v) in scene units
  const Vec3 extent = bounds.upper - bounds.lower;
  return step_of_size * std::max({extent.x, extent.y, extent.z});
}

/// Returns (u, v) of the point of the face straight above or below `beside`, if it has one nearby.
std::optional<Uv> uv_near(const Shape& shape, std::uint32_t face, const Vec3& beside,
                          const Vec3& normal, double reach, CrossingList& scratch) {
  ObjectRay ray;
  ray.origin = beside;
  ray.direction = normal;
  scratch.clear();
  shape.crossings(ray, scratch);
  const Crossing* nearest = nullptr;
  for (const Crossing& crossing : scratch) {
    if (crossing.face != face || std::abs(crossing.t) > reach) continue;
    if (nearest == nullptr || std::abs(crossing.t) < std::abs(nearest->t)) nearest = &crossing;
  }
  if (nearest == nullptr) return std::nullopt;
  const SurfacePoint point = shape.surface_point(ray, *nearest);
  return Uv{point.u, point.v};
}

/// Returns the change from one value to another, across the seam where 1 meets 0 if that is
/// shorter.
double change(double from, double to) {
  const double difference = to - from;
  if (difference > 0.5) return difference - 1;
  if (difference < -0.5) return difference + 1;
  return difference;
}

}  // namespace

UvGradient uv_gradient(const Shape& shape, std::uint32_t face, const Vec3& position,
                       const Vec3& normal, CrossingList& scratch) {
  const double step = step_on(shape);
  const Vec3 least_aligned = std::abs(normal.x) < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 across = glm::normalize(glm::cross(normal, least_aligned));
  const Vec3 tangents[] = {across, glm::cross(normal, across)};
  const auto uv_at = [&](const Vec3& point) {
    return uv_near(shape, face, point, normal, step, scratch);
  };

  UvGradient result;
  const std::optional<Uv> here = uv_at(position);
  for (const Vec3& tangent : tangents) {
    std::optional<Uv> before = uv_at(position - step * tangent);
    std::optional<Uv> after = uv_at(position + step * tangent);
    // Beside an edge of the face the difference is taken to the one side there is.
    const double steps = (before ? 1 : 0) + (after ? 1 : 0);
    if (!before) before = here;
    if (!after) after = here;
    if (!before || !after || steps == 0) continue;
    result.u += change(before->u, after->u) / (steps * step) * tangent;
    result.v += change(before->v, after->v) / (steps * step) * tangent;
  }
  return result;
}

}  // namespace crt::core
