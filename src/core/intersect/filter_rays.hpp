// The filter stage decides by conservative tests for which rays of a packet an object is to be
// looked at more closely.
#pragma once

#include <array>
#include <cstddef>

#include "core/intersect/bounding_proxy.hpp"
#include "core/intersect/first_crossing.hpp"
#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// BoxStarts says what the tests make of rays that start on one of a box's surfaces. Most of them
/// start on something else which touches the box, or whose faces are in line with its own.
struct BoxStarts {
  RayMask some = 0;  ///< those rays; without any the rest means nothing
  RayMask left;      ///< the rays that go away from the box, which is all behind them
  RayMask unknown;   ///< the rays of which these tests cannot say where they meet the box
  std::array<RayMask, ProxyBox::face_count> on;
};

/// A FilterRays applies the conservative tests to the rays of a packet. Crossings at the start of a
/// ray are known by identity: the tests leave a surface undecided for the rays that start on it.
template <class Real>
class FilterRays {
 public:
  using Packet = RayPacketOf<Real>;
  using ByGroup = std::array<Real, Packet::group_count>;

  explicit FilterRays(const Packet& packet) : packet_(packet), starts_(packet.starts) {}

  /// Returns the rays that have left an object for good.
  RayMask left(const BoundingProxy& proxy) const {
    return starts_.left_some == 0 ? 0 : rays_with(starts_.left_objects, proxy.object);
  }

  /// Returns how some rays start on a box, if the proxy is one.
  BoxStarts box_starts(const BoundingProxy& proxy, const BoundingProxies& proxies,
                       RayMask rays) const {
    BoxStarts starts;
    if ((rays & starts_.on_surface) == 0 || proxy.kind != BoundingProxy::Kind::box) return starts;
    const ProxyBox& box = proxies.box(proxy);
    RayMask away = 0;
    for (std::size_t face = 0; face < ProxyBox::face_count; ++face) {
      const RayMask here = rays_with(starts_.surfaces, box.surfaces[face]);
      starts.on[face] = here;
      starts.some |= here;
      away |= here & (box.flipped[face] ? ~starts_.outwards : starts_.outwards);
    }
    if (starts.some == 0) return starts;
    const RayMask at_front =
        in_groups(starts.some, [&](std::size_t group) { return lines(group).begin >= 0.0; });
    starts.left = away & at_front;
    starts.unknown = starts.some & ~starts.left & (~at_front | rays_with(starts_.leaves, box.leaf));
    return starts;
  }

  /// Decides for rays that have not left the object for good. With `any_will_do` it matters
  /// whether there is a crossing, and not which is the nearest.
  [[gnu::always_inline]] Decision<RayMask> decide(const BoundingProxy& proxy,
                                                  const BoundingProxies& proxies, RayMask rays,
                                                  const BoxStarts& starts, bool any_will_do) const {
    if (!proxy.has_test) return {};
    if (proxy.kind == BoundingProxy::Kind::box)
      return decide_box(proxies.box(proxy), rays, starts, any_will_do);
    ByGroup last;
    return decide(proxy, proxies, rays, any_will_do, last);
  }

  /// Decides for an object that has a test and is no box. For a plane, `last` gets a t for each
  /// accepted ray up to which the ray has surely met the plane.
  [[gnu::always_inline]] Decision<RayMask> decide(const BoundingProxy& proxy,
                                                  const BoundingProxies& proxies, RayMask rays,
                                                  bool any_will_do, ByGroup& last) const {
    const RayMask starting =
        (rays & starts_.on_surface) != 0 ? rays & rays_with(starts_.surfaces, proxy.surface) : 0;
    Decision<RayMask> decision{};
    for (std::size_t group = 0; group < Packet::group_count; ++group) {
      const RayMask lanes = Packet::lanes(rays & ~starting, group);
      if (lanes == 0) continue;
      put(decision, group, lanes,
          test_proxy(proxy, proxies, lines(group), packet_.limits[group], any_will_do,
                     last[group]));
    }
    const RayMask outwards = starting & starts_.outwards;
    if (outwards != 0 && proxy.kind == BoundingProxy::Kind::torus) {
      decision.rejected |= outwards & in_groups(outwards, [&](std::size_t group) {
                             return leaves_torus(proxy, proxies.axis(proxy), lines(group));
                           });
    }
    return decision;
  }

  /// Returns the rays for which first_crossing() finds the crossing with an object that
  /// resolved_leaf() has a leaf for. Bits of other rays mean nothing.
  RayMask resolved(const BoundingProxy& proxy, const BoundingProxies& proxies,
                   const BoxStarts& starts) const {
    return starts_.on_surface == 0 ? ~RayMask{0} : resolved_of_starting(proxy, proxies, starts);
  }

  /// Finds the first crossings of some resolved() rays of a group, by lane.
  FirstCrossing<Real> first_crossing(const BoundingProxy& proxy, const BoundingProxies& proxies,
                                     std::size_t group, RayMask asked,
                                     const BoxStarts& starts) const {
    if (proxy.kind == BoundingProxy::Kind::torus)
      return first_crossing_at_torus(proxy, proxies, group, asked);
    if (proxy.kind != BoundingProxy::Kind::box)
      return core::first_crossing(proxy, proxies, lines(group));
    const ProxyBox& box = proxies.box(proxy);
    return first_crossing_of_box(box, meetings(box, starts, group), lines(group));
  }

 private:
  RayMask resolved_of_starting(const BoundingProxy& proxy, const BoundingProxies& proxies,
                               const BoxStarts& starts) const {
    if (proxy.kind == BoundingProxy::Kind::box)
      return starts.some == 0 ? ~RayMask{0} : ~starts.unknown;
    RayMask starting = rays_with(starts_.surfaces, proxy.surface);
    if (proxy.kind == BoundingProxy::Kind::cylinder) {
      for (const std::uint32_t cap : proxies.axis(proxy).caps) {
        if (cap != nothing) starting |= rays_with(starts_.surfaces, cap);
      }
    }
    return proxy.kind == BoundingProxy::Kind::torus ? ~starting | starts_.outwards : ~starting;
  }

  const FilterLine<Real>& lines(std::size_t group) const { return packet_.groups[group]; }

  /// Returns where a group's lines meet the planes of a box, on which some of them start.
  BoxMeetings<Real> meetings(const ProxyBox& box, const BoxStarts& starts,
                             std::size_t group) const {
    auto result = BoxMeetings<Real>::of(box, lines(group));
    if (Packet::lanes(starts.some, group) == 0) return result;
    for (std::size_t face = 0; face < ProxyBox::face_count; ++face) {
      const RayMask lanes = Packet::lanes(starts.on[face], group);
      if (lanes != 0) result.start_on(face, lanes_of_mask<Real>(lanes), lines(group));
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

  Decision<RayMask> decide_box(const ProxyBox& box, RayMask rays, const BoxStarts& starts,
                               bool any_will_do) const {
    // To find where a resolved box is met costs hardly more than to ask whether it is.
    const bool has_test = any_will_do || !box.is_resolved;
    const RayMask left = starts.some != 0 ? rays & starts.left : 0;
    if (!has_test) return {.rejected = left, .accepted = 0};
    const RayMask tested = starts.some != 0 ? rays & ~left & ~starts.unknown : rays;
    Decision<RayMask> decision{.rejected = left, .accepted = 0};
    Packet::for_each_group(tested, [&](std::size_t group, RayMask lanes) {
      const Enclosure<Real> part = meetings(box, starts, group).enclosure();
      put(decision, group, lanes, core::decide(part, lines(group), packet_.limits[group], true));
    });
    return decision;
  }

  FirstCrossing<Real> first_crossing_at_torus(const BoundingProxy& torus,
                                              const BoundingProxies& proxies, std::size_t group,
                                              RayMask asked) const {
    const ProxyAxis& axis = proxies.axis(torus);
    const RayMask starting =
        starts_.on_surface != 0
            ? asked & Packet::lanes(rays_with(starts_.surfaces, torus.surface), group)
            : 0;
    const RayMask elsewhere = asked & ~starting;
    FirstCrossing<Real> first;
    if (elsewhere != 0)
      first = first_crossing_of_torus(axis, lines(group), lanes_of_mask<Real>(elsewhere));
    if (starting != 0) {
      const auto again =
          first_crossing_from_torus(axis, lines(group), lanes_of_mask<Real>(starting));
      first.unknown = first.unknown || again.unknown;
    }
    return first;
  }

  const Packet& packet_;
  const typename Packet::Starts& starts_;
};

}  // namespace crt::core
