// Hits of a few rays can be looked up together if they are alike.
#pragma once

#include <cstdint>
#include <span>

#include "core/math/lanes.hpp"
#include "core/prepare/prepared_data.hpp"

namespace crt::core {

/// SameSideRays are rays whose hits are alike: all from the same side and of one material.
struct SameSideRays {
  RayMask on_face = 0;    ///< on the face that the first of them hits
  RayMask on_others = 0;  ///< on other shapes; see PreparedData::on_shapes_like()

  RayMask all() const { return on_face | on_others; }
};

/// HitFaces has the hits of as many rays as there are lanes.
class HitFaces {
 public:
  HitFaces(const PreparedData& data, std::span<const RayHit, lane_count> hits)
      : data_(data),
        hits_(hits),
        faces_([&](auto lane) { return of(hits[lane]); }),
        entering_([&](auto lane) { return std::uint64_t{hits[lane].entering}; }) {}

  /// Returns those of some rays that are like the first of them.
  SameSideRays on_same_side(RayMask some) const {
    const RayHit& first = hits_[first_ray(some)];
    const RayMask on_face =
        mask_of(faces_ == of(first) && entering_ == std::uint64_t{first.entering}) & some;
    const RayMask others = some & ~on_face;
    return {on_face, others == 0 ? 0 : data_.on_shapes_like(first, hits_, others)};
  }

  /// Computes the points in object space where alike rays hit, each at its t. For other rays the
  /// point means nothing.
  void object_points(const SameSideRays& same, const RayLanes& lines, const Lanes& t, bool with_uv,
                     SurfacePointLanes& points) const {
    if (same.on_others == 0) {
      data_.object_points(hits_[first_ray(same.on_face)], same.on_face, lines, t, with_uv, points);
    } else {
      data_.points_on_shapes(hits_, same.all(), lines, t, with_uv, points);
    }
  }

 private:
  static std::uint64_t of(const RayHit& hit) { return std::uint64_t{hit.face} << 32 | hit.leaf; }

  const PreparedData& data_;
  std::span<const RayHit, lane_count> hits_;
  WordLanes faces_;
  WordLanes entering_;
};

}  // namespace crt::core
