// Rays' crossings with the spheres that floats have found to be the first are found here.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>

#include "core/accel/embree_tree.hpp"
#include "core/geometry/sphere/sphere.hpp"
#include "core/intersect/bounding_proxy.hpp"
#include "core/ray/coincidence_tolerance.hpp"
#include "core/ray/ray_hit.hpp"

namespace crt::core {

/// A NearestSphereHits has those of a batch's rays. It does not know what floats have left open.
class NearestSphereHits {
 public:
  /// Takes each step for all groups before the next: a step waits for its roots and quotients, but
  /// not for those of other groups.
  NearestSphereHits(const NearestSpheres& spheres, const BoundingProxies& proxies,
                    const RayBatch& rays) {
    std::array<NearGroup, RayBatch::group_count> near;
    RayPacket::for_each_group(spheres.meeting, [&](std::size_t group, RayMask meeting) {
      find_near(spheres, proxies, rays, group, meeting, near[group]);
    });
    RayPacket::for_each_group(spheres.meeting, [&](std::size_t group, RayMask meeting) {
      find(spheres, rays, group, meeting, near[group]);
    });
  }

  RayMask known() const { return known_; }
  const Lanes& t(std::size_t group) const { return t_[group]; }
  /// Returns up to where other crossings may coincide with a ray's.
  const Lanes& reach(std::size_t group) const { return reach_[group]; }
  std::uint32_t object(std::size_t ray) const { return spheres_[ray]->object; }
  std::uint32_t leaf(std::size_t ray) const { return spheres_[ray]->detail; }

  /// Writes a hit as the exact test has it, or that there is none.
  void write(std::size_t ray, bool found, RayHit& hit) const {
    const BoundingProxy& sphere = *spheres_[ray];
    const std::size_t lane = ray % lane_count;
    const bool entering = found && (entering_ >> ray & 1u) != 0;
    hit = {.t = found ? t_[ray / lane_count][lane] : std::numeric_limits<double>::infinity(),
           .error = found ? errors_[ray / lane_count][lane] : 0,
           .object = found ? sphere.object : nothing,
           .leaf = found ? sphere.detail : nothing,
           .face = found ? 0 : no_face,
           .surface = found ? sphere.surface : nothing,
           .root = static_cast<std::uint8_t>(found && !entering),
           .entering = entering};
  }

 private:
  struct NearGroup {
    NearGroup() {}  // NOLINT(modernize-use-equals-default): nothing is written before it is found
    union {
      NearLineOf<Lanes> line;
    };
    Lanes closest;
    Lanes radius;
  };

  void find_near(const NearestSpheres& nearest, const BoundingProxies& proxies,
                 const RayBatch& rays, std::size_t group, RayMask meeting, NearGroup& near) {
    const std::size_t first = group * lane_count;
    const auto spheres = std::span(spheres_).subspan(first, lane_count);
    const std::uint32_t any_box = nearest.boxes[first + first_ray(meeting)];
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const bool meets = (meeting >> lane & 1u) != 0;
      spheres[lane] = &proxies.list[meets ? nearest.boxes[first + lane] : any_box];
    }
    static_assert(offsetof(BoundingProxy, radius) ==
                  offsetof(BoundingProxy, place) + 3 * sizeof(double));
    const auto row = [&](std::size_t lane) {
      std::array<double, lane_count> numbers;
      std::memcpy(&numbers, &spheres[lane]->place, sizeof numbers);
      return lanes_at<Lanes>(numbers.data());
    };
    const auto [x, y, z, radius] = transposed({row(0), row(1), row(2), row(3)});
    const Lanes unit = power_of_two_below(radius);
    new (&near.line) NearLineOf<Lanes>(
        NearLineOf<Lanes>::at_closest(rays.lines[group], VectorLanes{x, y, z}, unit, near.closest));
    near.radius = radius * inverse_of_power(unit);
  }

  /// Returns whether crossings are of no surface through the starts or ends of their rays.
  static LaneMask is_clear_of_ends(const RayBatch& rays, std::size_t group, const Lanes& t,
                                   const Lanes& error) {
    const Lanes start_error = rays.start_errors[group] + rays.max_size_error;
    const Lanes& end = rays.t_max[group];
    const Lanes sure_end = certain_end(end, rays.end_errors[group], rays.max_size_error);
    const Lanes distance = t - rays.t_min[group];
    return (distance - error > flattest_start * start_error) &
           (distance > errors_at_start * error) & ((t < sure_end) | (t >= end));
  }

  void find(const NearestSpheres& nearest, const RayBatch& rays, std::size_t group, RayMask meeting,
            const NearGroup& near) {
    const auto chord = SphereChord<Lanes>::on(near.line, near.closest, near.radius);
    const LaneMask enters = chord.enter > rays.t_min[group];
    const Lanes t = select(enters, chord.enter, chord.leave);
    const Lanes error = chord.error_of(t);
    const Lanes reach = t + coincidence_tolerance(rays.lines[group], t, error);
    t_[group] = t;
    errors_[group] = error;
    reach_[group] = reach;
    entering_ |= mask_of(enters) << (group * lane_count);
    const RayMask known = meeting & mask_of(chord.found & is_clear_of_ends(rays, group, t, error) &
                                            (reach <= nearest.to[group]));
    known_ |= known << (group * lane_count);
  }

  std::array<const BoundingProxy*, packet_size> spheres_;
  RayBatch::Numbers t_;
  RayBatch::Numbers errors_;
  RayBatch::Numbers reach_;
  RayMask entering_ = 0;
  RayMask known_ = 0;
};

}  // namespace crt::core
