// A few boxes in a row, for single rays through scenes of few objects.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/csg/evaluate.hpp"
#include "core/csg/ray_slabs.hpp"
#include "core/math/lanes.hpp"
#include "core/scene/ray_packet.hpp"

namespace crt::core {

/// Does for one ray what EmbreeTree does, where that would take longer to begin than this to look at all
/// boxes, four at a time. All in doubles.
class BoxRow {
 public:
  static constexpr std::size_t most_boxes = 64;

  BoxRow() = default;
  /// Up to most_boxes of them, all finite.
  explicit BoxRow(std::span<const Bounds> boxes)
      : groups_((boxes.size() + lane_count - 1) / lane_count), count_(boxes.size()) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      Group& group = groups_[i / lane_count];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        group.lower[axis][static_cast<int>(i % lane_count)] = boxes[i].lower[static_cast<int>(axis)];
        group.upper[axis][static_cast<int>(i % lane_count)] = boxes[i].upper[static_cast<int>(axis)];
      }
    }
  }

  std::uint64_t bytes() const { return groups_.capacity() * sizeof(Group); }

  /// Whether it can be asked for a ray: not for one that is parallel to boxes' sides, or all but.
  static bool takes(const WorldRay& ray) {
    constexpr double least = 1 / RaySlabs::largest_inverse;
    const Vec3& d = ray.direction;
    return std::abs(d.x) > least && std::abs(d.y) > least && std::abs(d.z) > least;
  }

  /// Visits, from near to far, at least every box that the ray meets at t_min <= t <= limit. visit(box)
  /// returns the t beyond which nothing matters any more (below t_min: stop).
  template <class Visit>
  void traverse(const WorldRay& ray, double limit, const Visit& visit) const {
    alignas(sizeof(Lanes)) std::array<double, most_boxes> enter;
    std::uint64_t met = boxes_met(ray, limit, enter);
    while (met != 0) {
      auto nearest = static_cast<std::size_t>(std::countr_zero(met));
      for (std::uint64_t rest = met & (met - 1); rest != 0; rest &= rest - 1) {
        const auto other = static_cast<std::size_t>(std::countr_zero(rest));
        if (enter[other] < enter[nearest]) nearest = other;
      }
      if (enter[nearest] > limit) return;
      met &= ~(std::uint64_t{1} << nearest);
      limit = visit(static_cast<std::uint32_t>(nearest));
      if (limit < ray.t_min) return;
    }
  }

 private:
  struct Group {
    std::array<Lanes, 3> lower{};  ///< by axis
    std::array<Lanes, 3> upper{};
  };

  /// A bit for each, and where the ray enters those; rounded outwards as RaySlabs has it.
  std::uint64_t boxes_met(const WorldRay& ray, double limit, std::array<double, most_boxes>& enter) const {
    std::array<Lanes, 3> origin;
    std::array<Lanes, 3> inverse;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin[axis] = lanes_of(ray.origin[static_cast<int>(axis)]);
      inverse[axis] = lanes_of(1 / ray.direction[static_cast<int>(axis)]);
    }
    std::uint64_t missed = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const Group& group = groups_[i];
      std::array<Lanes, 3> low;
      std::array<Lanes, 3> high;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const Lanes first = (group.lower[axis] - origin[axis]) * inverse[axis];
        const Lanes second = (group.upper[axis] - origin[axis]) * inverse[axis];
        low[axis] = min(first, second);
        high[axis] = max(first, second);
      }
      const Lanes latest = max(max(low[0], low[1]), low[2]);
      const Lanes earliest = min(min(high[0], high[1]), high[2]);
      const Lanes from = latest - RaySlabs::slack * size_of(latest);
      const Lanes to = earliest + RaySlabs::slack * size_of(earliest);
      std::memcpy(&enter[i * lane_count], &from, sizeof from);
      // What overflowed is no number, and not missed.
      const LaneMask misses = (from > to) | (from > limit) | (to < ray.t_min);
      missed |= static_cast<std::uint64_t>(mask_of(misses)) << (i * lane_count);
    }
    return ~missed & all_boxes();
  }

  std::uint64_t all_boxes() const { return count_ == 0 ? 0 : ~std::uint64_t{0} >> (most_boxes - count_); }

  std::vector<Group> groups_;
  std::size_t count_ = 0;
};

}  // namespace crt::core
