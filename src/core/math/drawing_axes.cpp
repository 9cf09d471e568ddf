#include "core/math/drawing_axes.hpp"

#include <cmath>
#include <glm/geometric.hpp>

#include "crt/error.hpp"

namespace crt::core {

Vec3 unit_normal(const Vec3& normal) {
  const double largest = largest_component(normal);
  if (!std::isfinite(normal.x) || !std::isfinite(normal.y) || !std::isfinite(normal.z))
    throw Error(ErrorCode::invalid_argument, "the normal must be finite", "normal");
  if (!(largest > 0))
    throw Error(ErrorCode::invalid_argument, "the normal must have a length above 0", "normal");
  const Vec3 scaled = normal * inverse_of_power(power_of_two_below(largest));
  return scaled / glm::length(scaled);
}

DrawingAxes axes_across(const Vec3& normal) {
  if (normal.x == 0 && normal.z == 0)
    return {.x = {1, 0, 0}, .y = {0, 0, normal.y > 0 ? 1.0 : -1.0}};
  const double length = std::sqrt(normal.x * normal.x + normal.z * normal.z);
  const Vec3 x = Vec3(0 - normal.z, 0, normal.x) / length;
  return {.x = x, .y = glm::cross(x, normal)};
}

}  // namespace crt::core
