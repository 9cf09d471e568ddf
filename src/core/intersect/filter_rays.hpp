// Rays as the cheap tests take them, one or a packet: which objects they leave open.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/intersect/accelerator.hpp"
#include "core/intersect/box_starts.hpp"
#include "core/intersect/first_crossing.hpp"
#include "core/ray/line_of_ray.hpp"
#include "core/ray/ray_packet.hpp"

namespace crt::core {

/// What a cheap test may say of an object.
enum class Answer { undecided, rejected, accepted };

/// To find where a box is met costs hardly more than to ask whether it is.
inline bool has_test(const ProxyBox& box, bool any_will_do) {
  return any_will_do || !box.is_resolved;
}

/// One ray and the cheap tests.
class FilterRay {
 public:
  FilterRay(const Accelerator& accelerator, const WorldRay& ray)
      : line_(line_of(ray)),
        start_surface_(ray.start.surface),
        start_leaf_(ray.start.leaf),
        start_side_(ray.start.side),
        left_object_(accelerator.left_for_good(ray.start)) {}

  const FilterLine<double>& line() const { return line_; }

  /// `any_will_do` where it is asked whether there is a crossing, and not which is the nearest.
  Answer decide(const BoundingProxy& proxy, const BoundingProxies& proxies, double limit,
                bool any_will_do) const {
    double last;
    return decide(proxy, proxies, limit, any_will_do, last);
  }

  /// `last` is set for a plane that is met, to a t not before that.
  Answer decide(const BoundingProxy& proxy, const BoundingProxies& proxies, double limit,
                bool any_will_do, double& last) const {
    if (proxy.object == left_object_) return Answer::rejected;
    if (!proxy.has_test) return Answer::undecided;
    if (proxy.kind == BoundingProxy::Kind::box) {
      const ProxyBox& box = proxies.box(proxy);
      return has_test(box, any_will_do) ? decide_box(box, limit) : Answer::undecided;
    }
    // Of that surface it is known otherwise where the ray meets it.
    if (proxy.surface == start_surface_) {
      const bool has_left = proxy.kind == BoundingProxy::Kind::torus &&
                            start_side_ == Side::outside &&
                            leaves_torus(proxy, proxies.axis(proxy), line_);
      return has_left ? Answer::rejected : Answer::undecided;
    }
    return answer(test_proxy(proxy, proxies, line_, limit, any_will_do, last));
  }

  /// Of one that resolved_leaf() knows of.
  FirstCrossing<double> first_crossing(const BoundingProxy& proxy,
                                       const BoundingProxies& proxies) const {
    if (proxy.kind == BoundingProxy::Kind::box) return first_crossing_of_box(proxies.box(proxy));
    if (proxy.kind == BoundingProxy::Kind::torus) return first_crossing_at_torus(proxy, proxies);
    if (proxy.surface == start_surface_ || starts_on_cap(proxy, proxies)) return {.unknown = true};
    return core::first_crossing(proxy, proxies, line_);
  }

 private:
  static Answer answer(const Decision<bool>& decision) {
    if (decision.rejected) return Answer::rejected;
    return decision.accepted ? Answer::accepted : Answer::undecided;
  }

  bool starts_on_cap(const BoundingProxy& proxy, const BoundingProxies& proxies) const {
    if (proxy.kind != BoundingProxy::Kind::cylinder || start_surface_ == nothing) return false;
    const auto& [from, to] = proxies.axis(proxy).caps;
    return start_surface_ == from || start_surface_ == to;
  }

  friend struct BoxStarts;
  RayMask starting_on(std::uint32_t surface) const { return RayMask{surface == start_surface_}; }
  RayMask starting_on_leaf(std::uint32_t leaf) const { return RayMask{leaf == start_leaf_}; }
  RayMask starting_outwards() const { return RayMask{start_side_ == Side::outside}; }
  RayMask at_front() const { return RayMask{line_.begin >= 0}; }

  BoxStarts starts_on(const ProxyBox& box) const;
  Answer decide_box(const ProxyBox& box, double limit) const;
  FirstCrossing<double> first_crossing_of_box(const ProxyBox& box) const;
  FirstCrossing<double> first_crossing_at_torus(const BoundingProxy& torus,
                                                const BoundingProxies& proxies) const;

  FilterLine<double> line_;
  std::uint32_t start_surface_;
  std::uint32_t start_leaf_;
  Side start_side_;
  std::uint32_t left_object_;
};

/// A packet and the cheap tests.
class FilterPacket {
 public:
  explicit FilterPacket(const RayPacket& packet) : packet_(packet) {}

  /// Those that have left an object for good.
  RayMask left(const BoundingProxy& proxy) const {
    return packet_.starts.left_some == 0 ? 0 : rays_with(packet_.starts.left_objects, proxy.object);
  }

  /// Of those rays, if it is a box.
  BoxStarts box_starts(const BoundingProxy& proxy, const BoundingProxies& proxies,
                       RayMask rays) const {
    if ((rays & packet_.starts.on_surface) == 0 || proxy.kind != BoundingProxy::Kind::box)
      return {};
    return BoxStarts::of(proxies.box(proxy), *this);
  }

  /// Of rays that have not left the object for good; `any_will_do` as FilterRay::decide() has it.
  Decision<RayMask> decide(const BoundingProxy& proxy, const BoundingProxies& proxies, RayMask rays,
                           const BoxStarts& starts, bool any_will_do) const {
    if (!proxy.has_test) return {};
    if (proxy.kind == BoundingProxy::Kind::box) {
      return decide_box(proxies.box(proxy), rays, starts, any_will_do);
    }
    std::array<Lanes, RayPacket::group_count> last;
    return decide(proxy, proxies, rays, any_will_do, last);
  }

  /// Whatever it is, if it is known and no box; `last` as FilterRay::decide() has it.
  Decision<RayMask> decide(const BoundingProxy& proxy, const BoundingProxies& proxies, RayMask rays,
                           bool any_will_do,
                           std::array<Lanes, RayPacket::group_count>& last) const {
    Decision<RayMask> decision = decide_groups(rays, [&](std::size_t group) {
      return test_proxy(proxy, proxies, packet_.groups[group], packet_.limits[group], any_will_do,
                        last[group]);
    });
    if ((rays & packet_.starts.on_surface) != 0) {
      const RayMask open = starting_on(proxy.surface);
      decision.rejected &= ~open;
      decision.accepted &= ~open;
      const RayMask outwards = open & rays & packet_.starts.outwards;
      if (proxy.kind == BoundingProxy::Kind::torus && outwards != 0)
        decision.rejected |= outwards & leaving(proxy, proxies.axis(proxy), outwards);
    }
    return among(rays, decision);
  }

  /// Those whose crossings first_crossing() tells, of one that resolved_leaf() knows of.
  RayMask resolved(const BoundingProxy& proxy, const BoundingProxies& proxies,
                   const BoxStarts& starts) const {
    if (packet_.starts.on_surface == 0) return ~RayMask{0};
    if (proxy.kind == BoundingProxy::Kind::box)
      return starts.some == 0 ? ~RayMask{0} : ~starts.open;
    RayMask starting = starting_on(proxy.surface);
    if (proxy.kind == BoundingProxy::Kind::cylinder) {
      for (const std::uint32_t cap : proxies.axis(proxy).caps) {
        if (cap != nothing) starting |= starting_on(cap);
      }
    }
    return proxy.kind == BoundingProxy::Kind::torus ? ~starting | packet_.starts.outwards
                                                    : ~starting;
  }

  /// Of rays that it is asked for, by lane.
  FirstCrossing<Lanes> first_crossing(const BoundingProxy& proxy, const BoundingProxies& proxies,
                                      std::size_t group, RayMask asked,
                                      const BoxStarts& starts) const {
    const FilterLine<Lanes>& lines = packet_.groups[group];
    if (proxy.kind == BoundingProxy::Kind::torus)
      return first_crossing_at_torus(proxy, proxies, group, asked);
    if (proxy.kind != BoundingProxy::Kind::box) return core::first_crossing(proxy, proxies, lines);
    const ProxyBox& box = proxies.box(proxy);
    return first_crossing_of_box(box, starts.meetings(box, lines, group), lines);
  }

 private:
  friend struct BoxStarts;
  RayMask starting_on(std::uint32_t surface) const {
    return rays_with(packet_.starts.surfaces, surface);
  }
  RayMask starting_on_leaf(std::uint32_t leaf) const {
    return rays_with(packet_.starts.leaves, leaf);
  }
  RayMask starting_outwards() const { return packet_.starts.outwards; }
  RayMask at_front() const {
    return in_groups(~RayMask{0},
                     [&](std::size_t group) { return packet_.groups[group].begin >= 0.0; });
  }

  FirstCrossing<Lanes> first_crossing_at_torus(const BoundingProxy& torus,
                                               const BoundingProxies& proxies, std::size_t group,
                                               RayMask asked) const;

  /// Those of some rays for which a test of a group says yes.
  template <class Test>
  static RayMask in_groups(RayMask rays, const Test& test) {
    RayMask result = 0;
    RayPacket::for_each_group(rays, [&](std::size_t group, RayMask) {
      result |= mask_of(test(group)) << (group * lane_count);
    });
    return result;
  }

  /// decide(group) of each group that has some of the rays.
  template <class Decide>
  static Decision<RayMask> decide_groups(RayMask rays, const Decide& decide) {
    Decision<RayMask> decision{};
    RayPacket::for_each_group(rays, [&](std::size_t group, RayMask) {
      const std::size_t first = group * lane_count;
      const Decision<LaneMask> of_lanes = decide(group);
      decision.rejected |= mask_of(of_lanes.rejected) << first;
      decision.accepted |= mask_of(of_lanes.accepted) << first;
    });
    return decision;
  }

  Decision<RayMask> decide_box(const ProxyBox& box, RayMask rays, const BoxStarts& starts,
                               bool any_will_do) const {
    Decision<RayMask> decision{};
    if (has_test(box, any_will_do)) {
      decision = decide_groups(rays, [&](std::size_t group) {
        const FilterLine<Lanes>& lines = packet_.groups[group];
        return test_box(starts.meetings(box, lines, group), lines, packet_.limits[group]);
      });
    }
    if (starts.some != 0) {
      decision.rejected = (decision.rejected & ~starts.open) | starts.left;
      decision.accepted &= ~starts.open;
    }
    return among(rays, decision);
  }

  /// What is said of those rays alone.
  static Decision<RayMask> among(RayMask rays, const Decision<RayMask>& decision) {
    const RayMask rejected = decision.rejected & rays;
    return {.rejected = rejected, .accepted = decision.accepted & rays & ~rejected};
  }

  /// Those that leave a torus for good, of rays that start on it.
  RayMask leaving(const BoundingProxy& torus, const ProxyAxis& axis, RayMask rays) const {
    return in_groups(
        rays, [&](std::size_t group) { return leaves_torus(torus, axis, packet_.groups[group]); });
  }

  const RayPacket& packet_;
};

}  // namespace crt::core
