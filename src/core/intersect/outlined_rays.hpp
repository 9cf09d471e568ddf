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
enum class Judgement { open, missed, met };

/// To find where a box is met costs hardly more than to ask whether it is.
inline bool is_judged(const OutlineBox& box, bool any_will_do) {
  return any_will_do || !box.is_told;
}

/// One ray and the cheap tests.
class OutlinedRay {
 public:
  OutlinedRay(const Accelerator& accelerator, const WorldRay& ray)
      : line_(line_of(ray)),
        start_surface_(ray.start.surface),
        start_leaf_(ray.start.leaf),
        start_side_(ray.start.side),
        left_object_(accelerator.left_for_good(ray.start)) {}

  const OutlineLine<double>& line() const { return line_; }

  /// `any_will_do` where it is asked whether there is a crossing, and not which is the nearest.
  Judgement judge(const Outline& outline, const Outlines& outlines, double limit, bool any_will_do) const {
    double last;
    return judge(outline, outlines, limit, any_will_do, last);
  }

  /// `last` is set for a plane that is met, to a t not before that.
  Judgement judge(const Outline& outline, const Outlines& outlines, double limit, bool any_will_do,
                  double& last) const {
    if (outline.object == left_object_) return Judgement::missed;
    if (!outline.is_judged) return Judgement::open;
    if (outline.kind == Outline::Kind::box) {
      const OutlineBox& box = outlines.box(outline);
      return is_judged(box, any_will_do) ? judged_box(box, limit) : Judgement::open;
    }
    // Of that surface it is known otherwise where the ray meets it.
    if (outline.surface == start_surface_) {
      const bool has_left = outline.kind == Outline::Kind::torus && start_side_ == Side::outside &&
                            leaves_torus(outline, outlines.axis(outline), line_);
      return has_left ? Judgement::missed : Judgement::open;
    }
    return judgement(judge_outline(outline, outlines, line_, limit, any_will_do, last));
  }

  /// Of one that leaf_told() knows of.
  FirstCrossing<double> first_crossing(const Outline& outline, const Outlines& outlines) const {
    if (outline.kind == Outline::Kind::box) return first_crossing_of_box(outlines.box(outline));
    if (outline.kind == Outline::Kind::torus) return first_crossing_at_torus(outline, outlines);
    if (outline.surface == start_surface_ || starts_on_cap(outline, outlines)) return {.unknown = true};
    return core::first_crossing(outline, outlines, line_);
  }

 private:
  static Judgement judgement(const Verdict<bool>& verdict) {
    if (verdict.missed) return Judgement::missed;
    return verdict.met ? Judgement::met : Judgement::open;
  }

  bool starts_on_cap(const Outline& outline, const Outlines& outlines) const {
    if (outline.kind != Outline::Kind::rod || start_surface_ == nothing) return false;
    const auto& [from, to] = outlines.axis(outline).caps;
    return start_surface_ == from || start_surface_ == to;
  }

  friend struct BoxStarts;
  RayMask starting_on(std::uint32_t surface) const { return RayMask{surface == start_surface_}; }
  RayMask starting_on_leaf(std::uint32_t leaf) const { return RayMask{leaf == start_leaf_}; }
  RayMask starting_outwards() const { return RayMask{start_side_ == Side::outside}; }
  RayMask at_front() const { return RayMask{line_.begin >= 0}; }

  BoxStarts starts_on(const OutlineBox& box) const;
  Judgement judged_box(const OutlineBox& box, double limit) const;
  FirstCrossing<double> first_crossing_of_box(const OutlineBox& box) const;
  FirstCrossing<double> first_crossing_at_torus(const Outline& torus, const Outlines& outlines) const;

  OutlineLine<double> line_;
  std::uint32_t start_surface_;
  std::uint32_t start_leaf_;
  Side start_side_;
  std::uint32_t left_object_;
};

/// A packet and the cheap tests.
class OutlinedPacket {
 public:
  explicit OutlinedPacket(const RayPacket& packet) : packet_(packet) {}

  /// Those that have left an object for good.
  RayMask left(const Outline& outline) const {
    return packet_.starts.left_some == 0 ? 0 : rays_with(packet_.starts.left_objects, outline.object);
  }

  /// Of those rays, if it is a box.
  BoxStarts box_starts(const Outline& outline, const Outlines& outlines, RayMask rays) const {
    if ((rays & packet_.starts.on_surface) == 0 || outline.kind != Outline::Kind::box) return {};
    return BoxStarts::of(outlines.box(outline), *this);
  }

  /// Of rays that have not left the object for good; `any_will_do` as OutlinedRay::judge() has it.
  Verdict<RayMask> judge(const Outline& outline, const Outlines& outlines, RayMask rays,
                         const BoxStarts& starts, bool any_will_do) const {
    if (!outline.is_judged) return {};
    if (outline.kind == Outline::Kind::box) {
      return judge_boxed(outlines.box(outline), rays, starts, any_will_do);
    }
    std::array<Lanes, RayPacket::group_count> last;
    return judge(outline, outlines, rays, any_will_do, last);
  }

  /// Whatever it is, if it is known and no box; `last` as OutlinedRay::judge() has it.
  Verdict<RayMask> judge(const Outline& outline, const Outlines& outlines, RayMask rays, bool any_will_do,
                         std::array<Lanes, RayPacket::group_count>& last) const {
    Verdict<RayMask> verdict = judge_groups(rays, [&](std::size_t group) {
      return judge_outline(outline, outlines, packet_.groups[group], packet_.limits[group], any_will_do,
                           last[group]);
    });
    if ((rays & packet_.starts.on_surface) != 0) {
      const RayMask open = starting_on(outline.surface);
      verdict.missed &= ~open;
      verdict.met &= ~open;
      const RayMask outwards = open & rays & packet_.starts.outwards;
      if (outline.kind == Outline::Kind::torus && outwards != 0)
        verdict.missed |= outwards & leaving(outline, outlines.axis(outline), outwards);
    }
    return among(rays, verdict);
  }

  /// Those whose crossings first_crossing() tells, of one that leaf_told() knows of.
  RayMask told(const Outline& outline, const Outlines& outlines, const BoxStarts& starts) const {
    if (packet_.starts.on_surface == 0) return ~RayMask{0};
    if (outline.kind == Outline::Kind::box) return starts.some == 0 ? ~RayMask{0} : ~starts.open;
    RayMask starting = starting_on(outline.surface);
    if (outline.kind == Outline::Kind::rod) {
      for (const std::uint32_t cap : outlines.axis(outline).caps) {
        if (cap != nothing) starting |= starting_on(cap);
      }
    }
    return outline.kind == Outline::Kind::torus ? ~starting | packet_.starts.outwards : ~starting;
  }

  /// Of rays that it is asked for, by lane.
  FirstCrossing<Lanes> first_crossing(const Outline& outline, const Outlines& outlines, std::size_t group,
                                      RayMask asked, const BoxStarts& starts) const {
    const OutlineLine<Lanes>& lines = packet_.groups[group];
    if (outline.kind == Outline::Kind::torus) return first_crossing_at_torus(outline, outlines, group, asked);
    if (outline.kind != Outline::Kind::box) return core::first_crossing(outline, outlines, lines);
    const OutlineBox& box = outlines.box(outline);
    return first_crossing_of_box(box, starts.meetings(box, lines, group), lines);
  }

 private:
  friend struct BoxStarts;
  RayMask starting_on(std::uint32_t surface) const { return rays_with(packet_.starts.surfaces, surface); }
  RayMask starting_on_leaf(std::uint32_t leaf) const { return rays_with(packet_.starts.leaves, leaf); }
  RayMask starting_outwards() const { return packet_.starts.outwards; }
  RayMask at_front() const {
    return in_groups(~RayMask{0}, [&](std::size_t group) { return packet_.groups[group].begin >= 0.0; });
  }

  FirstCrossing<Lanes> first_crossing_at_torus(const Outline& torus, const Outlines& outlines,
                                               std::size_t group, RayMask asked) const;

  /// Those of some rays for which a test of a group says yes.
  template <class Test>
  static RayMask in_groups(RayMask rays, const Test& test) {
    RayMask result = 0;
    RayPacket::for_each_group(
        rays, [&](std::size_t group, RayMask) { result |= mask_of(test(group)) << (group * lane_count); });
    return result;
  }

  /// judge(group) of each group that has some of the rays.
  template <class Judge>
  static Verdict<RayMask> judge_groups(RayMask rays, const Judge& judge) {
    Verdict<RayMask> verdict{};
    RayPacket::for_each_group(rays, [&](std::size_t group, RayMask) {
      const std::size_t first = group * lane_count;
      const Verdict<LaneMask> of_lanes = judge(group);
      verdict.missed |= mask_of(of_lanes.missed) << first;
      verdict.met |= mask_of(of_lanes.met) << first;
    });
    return verdict;
  }

  Verdict<RayMask> judge_boxed(const OutlineBox& box, RayMask rays, const BoxStarts& starts,
                               bool any_will_do) const {
    Verdict<RayMask> verdict{};
    if (is_judged(box, any_will_do)) {
      verdict = judge_groups(rays, [&](std::size_t group) {
        const OutlineLine<Lanes>& lines = packet_.groups[group];
        return judge_box(starts.meetings(box, lines, group), lines, packet_.limits[group]);
      });
    }
    if (starts.some != 0) {
      verdict.missed = (verdict.missed & ~starts.open) | starts.left;
      verdict.met &= ~starts.open;
    }
    return among(rays, verdict);
  }

  /// What is said of those rays alone.
  static Verdict<RayMask> among(RayMask rays, const Verdict<RayMask>& verdict) {
    const RayMask missed = verdict.missed & rays;
    return {.missed = missed, .met = verdict.met & rays & ~missed};
  }

  /// Those that leave a torus for good, of rays that start on it.
  RayMask leaving(const Outline& torus, const OutlineAxis& axis, RayMask rays) const {
    return in_groups(rays,
                     [&](std::size_t group) { return leaves_torus(torus, axis, packet_.groups[group]); });
  }

  const RayPacket& packet_;
};

}  // namespace crt::core
