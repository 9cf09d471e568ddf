// Which of many spheres rays cross first, by floats, as far as these can tell: intervals say where
// a crossing may be, and one that comes before all others is the first, wherever in its interval it
// is. Where exactly is found afterwards, in double, of one sphere a ray. Rays of which floats
// cannot tell are told clear_of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/csg/evaluate.hpp"
#include "core/geometry/sphere/enclose.hpp"
#include "core/ray/ray_packet.hpp"
#include "core/simd/lanes.hpp"

namespace crt::core {

/// A sphere in the units of the tree, in which all spheres are between -1 and 1.
struct FloatSphere {
  std::array<float, 3> center;
  float radius;
};

/// Rays of a packet as floats, by component, in the same units: from eight rays on.
struct FloatRays {
  std::array<const float*, 3> origin;
  std::array<const float*, 3> direction;
  float* end;  ///< what is beyond does not matter
};

/// The search of up to packet_size rays, which are looked at by their places.
class NearestSphereFilter {
 public:
  /// Bounds on the errors of what follows, of rays as is_near() and is_plain() have them, with u =
  /// 2^-24.
  ///
  /// The offset w from a ray's start to a center has components below 3, so |w| < 5.2; |d| > 0.94,
  /// and rays are next to spheres before t = 7. To round a ray to floats moves its points by less
  /// than 14 u; to round a sphere, and w, is as if the sphere were 5 u off; and the line's distance
  /// from the center is found to 12 u. In all it is as if the radius were off by 31 u.
  static constexpr float distance_error = 0x1p-18F;  // 64 u
  /// The line is closest to the center at t = w . d / d^2, found to 55 u, which is 10 u of |w| /
  /// |d|. Half the chord is found to 4 u, but for what the distance's error does; sums are rounded
  /// by 12 u, the exact crossing is known to 2 u, and what is farther than 32 u from the start is
  /// not at it.
  static constexpr float t_error = 0x1p-17F;  // 128 u

  /// No sphere is as far away as that along a ray that it takes.
  static constexpr double farthest = 8;

  /// Whether rays start so that this holds, at a place in the units of the tree and a t likewise.
  static LaneMask is_near(const VectorLanes& place, const Lanes& t) {
    constexpr double longest_offset = 0x1p20;  // doubles know that to 2^-33
    return (largest_component(place) < 2.0) & (abs(t) < longest_offset);
  }
  /// Whether their directions are such, and whether is_at_start() is sure of all that is not as
  /// near to the start as 32 u; start errors likewise.
  static LaneMask is_plain(const Lanes& squared_length, const Lanes& start_error) {
    constexpr double largest_start_error = 0x1p-19 / flattest_start;
    return (squared_length > 0.9) & (squared_length < 12.1) & (start_error <= largest_start_error);
  }

  NearestSphereFilter() {
    first_.fill(nothing);
    first_from_.fill(std::numeric_limits<float>::infinity());
    others_from_.fill(std::numeric_limits<float>::infinity());
  }

  /// d^2 of the four rays from one on.
  void set_squared_lengths(std::size_t first_ray, const FloatLanes& squares) {
    put_lanes(1.0F / squares, inverse_squared_lengths_, first_ray);
  }

  /// Eight rays, from one on, meet a sphere or pass by it.
  void meet(const FloatSphere& sphere, std::uint32_t number, std::size_t first_ray,
            const OctetMask& valid, const FloatRays& rays) {
    const auto offset = [&](std::size_t axis) {
      return sphere.center[axis] - lanes_at<FloatOctet>(rays.origin[axis]);
    };
    const std::array<FloatOctet, 3> w = {offset(0), offset(1), offset(2)};
    const std::array<FloatOctet, 3> d = {lanes_at<FloatOctet>(rays.direction[0]),
                                         lanes_at<FloatOctet>(rays.direction[1]),
                                         lanes_at<FloatOctet>(rays.direction[2])};
    const auto inverse_squared_length = lanes_at<FloatOctet>(&inverse_squared_lengths_[first_ray]);
    const float margin_error = distance_error * (2 * sphere.radius + distance_error);
    const auto approach =
        closest_approach(w, d, inverse_squared_length, sphere.radius, margin_error);
    const auto part =
        enclosed_chord(approach, inverse_squared_length, margin_error, FloatOctet(t_error));

    const auto end = lanes_at<FloatOctet>(rays.end);
    const OctetMask counts =
        valid && approach.margin >= 0.0F && !part.is_outside(FloatOctet{}, end);
    // The others start on it, as far as floats know.
    const OctetMask is_before = part.enter_from > 0.0F;
    const OctetMask is_inside = part.enter_to < 0.0F;
    const FloatOctet from = select(is_inside, part.leave_from, part.enter_from);
    const FloatOctet to = select(is_inside, part.leave_to, part.enter_to);
    const OctetMask sure =
        counts && part.is_met() && (is_before || (is_inside && part.leave_from > 0.0F));
    // Others that are so near may be at the same place.
    const FloatOctet clear_of = to + t_error;
    const OctetMask is_first = sure && clear_of < end;

    const auto first_from = lanes_at<FloatOctet>(&first_from_[first_ray]);
    const auto others_from = lanes_at<FloatOctet>(&others_from_[first_ray]);
    const FloatOctet other = min(others_from, select(is_first, first_from, from));
    const auto first = lanes_at<BitOctet>(&first_[first_ray]);
    put_lanes(select(counts, other, others_from), others_from_, first_ray);
    put_lanes(select(is_first, from, first_from), first_from_, first_ray);
    put_lanes(select(mask_cast<BitOctet::mask_type>(is_first), number, first), first_, first_ray);
    put_lanes(select(is_first, clear_of, end), rays.end, 0);
  }

  /// What there is to say in the end of the first rays, as many as there are ends.
  struct Outcome {
    RayMask known = 0;    ///< all that they cross but the first sphere is beyond their ends
    RayMask meeting = 0;  ///< there is one that they cross first
  };
  template <std::size_t Count>
  Outcome outcome(const float (&ends)[Count]) const {
    Outcome result;
    for (std::size_t first = 0; first < Count; first += octet_size) {
      const auto others_from = lanes_at<FloatOctet>(&others_from_[first]);
      result.known |= mask_of(others_from > lanes_at<FloatOctet>(&ends[first])) << first;
      result.meeting |= mask_of(lanes_at<BitOctet>(&first_[first]) != nothing) << first;
    }
    return result;
  }
  /// The number of the sphere that rays cross first, by ray; or nothing.
  const std::array<std::uint32_t, packet_size>& first() const { return first_; }

 private:
  alignas(32) std::array<float, packet_size> inverse_squared_lengths_;
  alignas(32) std::array<float, packet_size> first_from_;   ///< no crossing with the sphere found
                                                            ///< first is before that
  alignas(32) std::array<float, packet_size> others_from_;  ///< no crossing with others
  alignas(32) std::array<std::uint32_t, packet_size> first_;
};

}  // namespace crt::core
