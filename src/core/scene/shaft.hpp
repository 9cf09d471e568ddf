// What holds all rays of a packet: candidates are found once for all of them.
//
// The rays go along one coordinate axis w, their *main axis*, all upwards or all downwards. Their other
// coordinates u and v are linear in w, so from a place w0 before all starts on
//   u is in [u0 + (w - w0) u', U0 + (w - w0) U'],
// with the least and the largest u at w0, and the least and the largest slope. A box whose part from w0 on
// is beside that, behind all starts or beyond all ends is met by none of the rays.
// Source: Boulos, Wald, Shirley, Geometric and arithmetic culling methods for entire ray packets, 2006.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "core/geometry/bounds.hpp"
#include "core/scene/ray_packet.hpp"

namespace crt::core {

/// As many boxes as there are lanes, by component. One that is empty is met by nothing.
struct BoxLanes {
  std::array<Lanes, 3> lower;
  std::array<Lanes, 3> upper;
};

class Shaft {
 public:
  /// Around the rays of a packet, for boxes within `space`; none if they go too far apart, or come from too far.
  static std::optional<Shaft> around(const RayPacket& packet, const Bounds& space);

  /// Which boxes some ray may meet, as bits; and where along the main axis they begin, from w0 on.
  std::uint32_t meets(const BoxLanes& boxes, Lanes& begin) const;

  /// Places farther along the main axis than that, as meets() tells them, do not matter any more.
  double end() const { return end_; }
  /// Takes over what has become of the limits of the packet.
  void set_limits(const RayPacket& packet);

 private:
  /// A coordinate across the main axis.
  struct Across {
    std::size_t axis = 0;
    double least = 0;  ///< at w0
    double most = 0;
    double least_slope = 0;
    double most_slope = 0;
  };

  bool set(Across& across, const RayPacket& packet);
  Lanes place_of(const OutlineLine<Lanes>& lines) const { return sign_ * lines.origin[main_]; }
  Lanes speed_of(const OutlineLine<Lanes>& lines) const { return sign_ * lines.direction[main_]; }

  std::size_t main_ = 0;
  double sign_ = 1;   ///< the w of a place is that times its coordinate
  double first_ = 0;  ///< w0
  double start_ = 0;  ///< the first w of a ray, relative to w0
  double end_ = std::numeric_limits<double>::infinity();
  std::array<Across, 2> across_;
};

}  // namespace crt::core
