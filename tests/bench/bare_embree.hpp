// This is the least code that asks Embree for spheres or a mesh. Our own queries are measured
// against it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "flows.hpp"
#include "query_rays.hpp"

namespace crt::bench {

/// Says what stands for the spheres.
enum class Stand {
  double_callback,  ///< user geometry, the sphere's equation in double
  float_callback,   ///< user geometry, the sphere's equation in float
  sphere_point,     ///< RTC_GEOMETRY_TYPE_SPHERE_POINT, Embree's own
  triangles,        ///< one triangle in each sphere's place
};

struct Answer {
  double t;          ///< infinite if nothing is hit
  std::uint32_t id;  ///< of the sphere or triangle
};

/// A Surface is triangles with shared corners.
struct Surface {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

class BareEmbree {
 public:
  BareEmbree(std::span<const Ball> balls, Stand stand);
  explicit BareEmbree(const Surface& surface);
  ~BareEmbree();
  BareEmbree(BareEmbree&&) noexcept;
  BareEmbree& operator=(BareEmbree&&) noexcept;

  /// Finds the nearest hit of each ray by rtcIntersect1, or by rtcIntersect16 for 16 at a time.
  void intersect_one_by_one(std::span<const crt_ray> rays, Flow flow,
                            std::span<Answer> answers) const;
  void intersect_packets(std::span<const crt_ray> rays, Flow flow, std::span<Answer> answers) const;

  /// Asks whether a ray hits anything, by rtcOccluded1 and rtcOccluded16.
  void occluded_one_by_one(std::span<const crt_ray> rays, Flow flow,
                           std::span<std::uint8_t> answers) const;
  void occluded_packets(std::span<const crt_ray> rays, Flow flow,
                        std::span<std::uint8_t> answers) const;

 private:
  class World;
  std::unique_ptr<World> world_;
};

}  // namespace crt::bench
