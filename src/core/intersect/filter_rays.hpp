// The filter stage decides by conservative tests for which rays of a packet an object is to be
// looked at more closely.
#pragma once

#include <array>
#include <cstddef>

#include "core/intersect/bounding_proxy.hpp"
#include "core/intersect/first_crossing.hpp"
#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// SolidStarts says what the tests make of rays that start on the surface of one of a solid's
/// faces. Where all faces are flat, most of them start on something else which touches the solid,
/// or whose faces are in line with its own.
struct SolidStarts {
  RayMask some = 0;     ///< those rays; without any the rest means nothing
  RayMask left = 0;     ///< the rays that surely leave the solid for good
  RayMask unknown = 0;  ///< the rays of which these tests cannot say where they meet the solid
  std::array<RayMask, FaceStarts<double>::max_faces> on;  ///< by flat face
};

/// A FilterRays applies the conservative tests to the rays of a packet. Crossings at the start of a
/// ray are known by identity: the tests leave a surface undecided for the rays that start on it.
template <class Real>
class FilterRays {
 public:
  using Packet = RayPacketOf<Real>;
  /// Parts are the parts of a packet's rays in a solid.
  using Parts = std::array<Enclosure<Real>, Packet::group_count>;

  explicit FilterRays(const Packet& packet) : packet_(packet), starts_(packet.starts) {}

  /// Returns the rays that have left an object for good.
  RayMask left(const BoundingProxy& proxy) const {
    return starts_.left_some == 0 ? 0 : rays_with(starts_.left_objects, proxy.object);
  }

  /// Returns how some rays start on an object that has a solid.
  SolidStarts starts_on(const BoundingProxy& proxy, RayMask rays) const {
    SolidStarts starts;
    if ((rays & starts_.on_surface) == 0) return starts;
    const PlacedSolid& solid = *proxy.solid;
    const std::uint32_t flat_faces = solid.flat_faces();
    RayMask away = 0;
    for (std::uint32_t face = 0; face < proxy.face_count; ++face) {
      const FaceSurface& surface = proxy.faces[face];
      const RayMask here = rays_with(starts_.surfaces, surface.surface);
      starts.some |= here;
      away |= here & (surface.flipped ? ~starts_.outwards : starts_.outwards);
      if (flat_faces != 0) starts.on[face] = here;
    }
    if (starts.some == 0) return starts;
    if (flat_faces == 0) {
      starts.left = away & in_groups(away, [&](std::size_t group) {
                      return solid.leaves_for_good(lines(group));
                    });
      starts.unknown = starts.some & ~starts.left;
      return starts;
    }
    const RayMask at_front =
        in_groups(starts.some, [&](std::size_t group) { return lines(group).begin >= 0.0; });
    starts.left = away & at_front;
    starts.unknown =
        starts.some & ~starts.left & (~at_front | rays_with(starts_.leaves, proxy.leaf_index));
    return starts;
  }

  /// Decides for rays that have not left an object for good, which has a solid. `parts` gets where
  /// those are in the solid that are neither rejected nor starts.unknown. Rays are accepted only
  /// where `may_accept`, and a crossing surely counts.
  [[gnu::always_inline]] Decision<RayMask> decide(const BoundingProxy& proxy, RayMask rays,
                                                  const SolidStarts& starts, bool may_accept,
                                                  Parts& parts) const {
    Decision<RayMask> decision{.rejected = rays & starts.left, .accepted = 0};
    const RayMask tested = rays & ~(starts.left | starts.unknown);
    for (std::size_t group = 0; group < Packet::group_count; ++group) {
      const RayMask lanes = Packet::lanes(tested, group);
      if (lanes == 0) continue;
      const FilterLine<Real>& line = lines(group);
      const Real& limit = packet_.limits[group];
      Enclosure<Real>& part = parts[group];
      if (!enclose(proxy, group, lanes, starts, part)) {
        decision.rejected |= lanes << (group * Packet::group_size);
      } else if (proxy.is_within) {
        put(decision, group, lanes, {is_outside(part, line, limit), {}});
      } else {
        put(decision, group, lanes, core::decide(part, line, limit, may_accept));
      }
    }
    return decision;
  }

  /// Finds the first crossings of some lanes of a group with an object that is a leaf. `part` is
  /// theirs in its solid, or null for a leaf with quick spans.
  FirstCrossing<Real> first_crossing(const BoundingProxy& proxy, std::size_t group, RayMask asked,
                                     const SolidStarts& starts, const Enclosure<Real>* part) const {
    const auto find = [&](const FaceStarts<Real>* on_faces) {
      return core::first_crossing(*proxy.leaf, lines(group), lanes_of_mask<Real>(asked), on_faces,
                                  part);
    };
    if (Packet::lanes(starts.some, group) == 0) return find(nullptr);
    const FaceStarts<Real> on_faces = by_lane(proxy, starts, group);
    return find(&on_faces);
  }

  /// Returns which rays of `asked`, which start on an object that is a leaf, surely do not meet it
  /// again.
  RayMask left_again(const BoundingProxy& proxy, RayMask asked) const {
    const RayMask outwards = asked & starts_.outwards;
    return outwards & in_groups(outwards, [&](std::size_t group) {
             const FilterLine<Real>& line = lines(group);
             const auto wanted =
                 lanes_of_mask<Real>(Packet::lanes(outwards, group)) && line.begin >= 0.0;
             const auto ray = proxy.leaf->placement->to_object(plain_ray(line));
             return wanted && proxy.leaf->shape->leaves_for_good(ray, wanted);
           });
  }

 private:
  const FilterLine<Real>& lines(std::size_t group) const { return packet_.groups[group]; }

  bool enclose(const BoundingProxy& proxy, std::size_t group, RayMask lanes,
               const SolidStarts& starts, Enclosure<Real>& part) const {
    const auto asked = lanes_of_mask<Real>(lanes);
    if (Packet::lanes(starts.some, group) == 0)
      return proxy.solid->enclose(lines(group), asked, nullptr, part);
    const FaceStarts<Real> on_faces = by_lane(proxy, starts, group);
    return proxy.solid->enclose(lines(group), asked, &on_faces, part);
  }

  /// Returns the faces that lanes of a group start on, if all are flat.
  static FaceStarts<Real> by_lane(const BoundingProxy& proxy, const SolidStarts& starts,
                                  std::size_t group) {
    FaceStarts<Real> result;
    for (std::size_t face = 0; face < proxy.solid->flat_faces(); ++face) {
      result.on[face] = lanes_of_mask<Real>(Packet::lanes(starts.on[face], group));
    }
    return result;
  }

  /// Returns the rays of some groups for which a test of the group is true.
  template <class Test>
  static RayMask in_groups(RayMask rays, const Test& test) {
    RayMask result = 0;
    Packet::for_each_group(rays, [&](std::size_t group, RayMask) {
      result |= mask_of(test(group)) << (group * Packet::group_size);
    });
    return result;
  }

  /// Puts in what is said of some lanes of a group. No ray is both rejected and accepted.
  static void put(Decision<RayMask>& decision, std::size_t group, RayMask lanes,
                  const Decision<MaskOf<Real>>& of_lanes) {
    const std::size_t first = group * Packet::group_size;
    const RayMask rejected = lanes & mask_of(of_lanes.rejected);
    decision.rejected |= rejected << first;
    decision.accepted |= (lanes & ~rejected & mask_of(of_lanes.accepted)) << first;
  }

  const Packet& packet_;
  const typename Packet::Starts& starts_;
};

}  // namespace crt::core
