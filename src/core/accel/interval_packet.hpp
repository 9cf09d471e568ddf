// An interval packet takes rays of a packet together, to find what none of them can do.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// An Extent is the least and the greatest of some numbers that come by lanes.
class Extent {
 public:
  [[gnu::always_inline]] void include(const Lanes& values, const LaneMask& lanes) {
    low_ = min(low_, select(lanes, values, low_));
    high_ = max(high_, select(lanes, values, high_));
  }
  double low() const { return std::min(std::min(low_[0], low_[1]), std::min(low_[2], low_[3])); }
  double high() const {
    return std::max(std::max(high_[0], high_[1]), std::max(high_[2], high_[3]));
  }

 private:
  Lanes low_ = lanes_of(infinity);
  Lanes high_ = lanes_of(-infinity);
};

/// An IntervalPacket holds at least one ray of a packet. None of its rays is all but parallel to a
/// coordinate plane.
///
/// At t >= 0 no ray is above highest origin + t * highest direction on an axis, nor below lowest
/// origin + t * lowest direction. So the times when those two cross the ends of a box bound when
/// any ray can be in there.
class IntervalPacket {
 public:
  [[gnu::always_inline]] IntervalPacket(const RayPacket& packet, RayMask rays) {
    Extent begins;
    std::array<Extent, 3> origins;
    std::array<Extent, 3> directions;
    for (std::size_t group = 0; group < RayPacket::group_count; ++group) {
      const LaneMask lanes = lanes_with(RayPacket::lanes(rays, group));
      const FilterLine<Lanes>& lines = packet.groups[group];
      begins.include(lines.begin, lanes);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        origins[axis].include(lines.origin[axis], lanes);
        directions[axis].include(lines.direction[axis], lanes);
      }
    }
    begin_ = begins.low();
    end_ = last_limit(packet, rays);
    for (std::size_t axis = 0; axis < 3; ++axis)
      axes_[axis] = Axis(origins[axis], directions[axis]);
  }

  /// The interval of t extends from the first ray's begin to the last one's limit.
  double begin() const { return begin_; }
  double end() const { return end_; }

  /// Returns the limit of the ray that goes farthest.
  static double last_limit(const RayPacket& packet, RayMask rays) {
    Extent limits;
    RayPacket::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      limits.include(packet.limits[group], lanes_with(lanes));
    });
    return limits.high();
  }

  /// Narrows down when a ray may be in boxes, of which `lower` and `upper` are the ends along an
  /// axis.
  void bound(std::size_t axis, const Lanes& lower, const Lanes& upper, Lanes& from,
             Lanes& to) const {
    const Axis& rays = axes_[axis];
    const Lanes at_lower = (lower - rays.highest) * rays.inverse_highest;
    if (rays.rises) {
      from = max(from, at_lower);
    } else {
      to = min(to, at_lower);
    }
    const Lanes at_upper = (upper - rays.lowest) * rays.inverse_lowest;
    if (rays.falls) {
      from = max(from, at_upper);
    } else {
      to = min(to, at_upper);
    }
  }

 private:
  struct Axis {
    double lowest = 0;  ///< origin
    double highest = 0;
    double inverse_lowest = 0;  ///< direction
    double inverse_highest = 0;
    bool falls = false;  ///< some ray does
    bool rises = false;

    Axis() = default;
    Axis(const Extent& origins, const Extent& directions)
        : lowest(origins.low()),
          highest(origins.high()),
          inverse_lowest(1 / directions.low()),
          inverse_highest(1 / directions.high()),
          falls(inverse_lowest < 0),
          rises(inverse_highest > 0) {}
  };

  std::array<Axis, 3> axes_;
  double begin_ = 0;
  double end_ = 0;
};

}  // namespace crt::core
