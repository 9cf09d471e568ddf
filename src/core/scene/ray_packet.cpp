#include "core/scene/ray_packet.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace crt::core {

bool go_together(std::span<const WorldRay> rays) {
  constexpr std::size_t fewest = 3;
  if (rays.size() < fewest) return false;
  constexpr double widest = 0.9;  // the cosine of the angle with the first ray
  const Vec3& first = rays.front().direction;
  const double first_square = widest * widest * glm::dot(first, first);
  return std::all_of(rays.begin(), rays.end(), [&](const WorldRay& ray) {
    const double along = glm::dot(ray.direction, first);
    return along > 0 && along * along > first_square * glm::dot(ray.direction, ray.direction);
  });
}

}  // namespace crt::core
