// Rays that start on the surfaces of a box, and the box.
#pragma once

#include <array>
#include <cstddef>

#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// What the cheap tests make of rays that start on one of a box's surfaces. Most of them start on
/// something else which touches the box, or whose faces are in line with its own.
struct BoxStarts {
  RayMask some = 0;  ///< those rays; without any the rest means nothing
  RayMask left;      ///< away from it: the box is all behind them
  RayMask open;      ///< of these it is known otherwise where they meet it
  std::array<RayMask, ProxyBox::face_count> on;

  /// Of rays, a bit each, that know which of them
  ///
  ///     RayMask starting_on(std::uint32_t surface) const;
  ///     RayMask starting_on_leaf(std::uint32_t leaf) const;
  ///     RayMask starting_outwards() const;  // of those that start on a surface
  ///     RayMask at_front() const;           // have t_min >= 0
  template <class Rays>
  static BoxStarts of(const ProxyBox& box, const Rays& rays) {
    BoxStarts starts;
    const RayMask outwards = rays.starting_outwards();
    RayMask away = 0;
    for (std::size_t face = 0; face < ProxyBox::face_count; ++face) {
      const RayMask here = rays.starting_on(box.surfaces[face]);
      starts.on[face] = here;
      starts.some |= here;
      away |= here & (box.flipped[face] ? ~outwards : outwards);
    }
    if (starts.some == 0) return starts;
    const RayMask at_front = rays.at_front();
    starts.left = away & at_front;
    starts.open = starts.some & ~starts.left & (~at_front | rays.starting_on_leaf(box.leaf));
    return starts;
  }

  /// Where the lines of a group of rays meet the box, with those that start on it.
  template <class Real>
  BoxMeetings<Real> meetings(const ProxyBox& box, const FilterLine<Real>& line,
                             std::size_t group) const {
    auto result = BoxMeetings<Real>::of(box, line);
    if (RayPacket::lanes(some, group) == 0) return result;
    for (std::size_t face = 0; face < ProxyBox::face_count; ++face) {
      const RayMask lanes = RayPacket::lanes(on[face], group);
      if (lanes != 0) result.start_on(face, lanes_of_mask<Real>(lanes), line);
    }
    return result;
  }
};

}  // namespace crt::core
