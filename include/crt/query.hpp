// Ray queries: what a program asks of the geometry without making a picture. All are safe from any
// number of threads at once.
#pragma once

#include <crt/prepared_scene.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace crt {

/// The points origin + t * direction with t_min < t < t_max; t is in units of the direction's
/// length, which may be any but 0.
struct Ray {
  Vec3 origin{0, 0, 0};
  Vec3 direction{0, 0, 1};
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
};

/// Where a ray meets a surface.
struct Hit {
  double t = 0;
  Vec3 position{0, 0, 0};
  Vec3 normal{0, 1, 0};  ///< unit length, out of the solid; for a surface as its maker turned it
  double u = 0;
  double v = 0;
  std::uint32_t entity_id = 0;
  bool entering = false;  ///< into the solid; for a surface: against its normal
};

/// The nearest hit.
std::optional<Hit> intersect(const PreparedScene& scene, const Ray& ray);

/// Whether anything at all is hit, transparent or not.
bool occluded(const PreparedScene& scene, const Ray& ray);

/// Every crossing along the ray in order: per entity, the solid intervals that CSG leaves.
std::vector<Hit> crossings(const PreparedScene& scene, const Ray& ray);

}  // namespace crt
