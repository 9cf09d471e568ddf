// A flat box list holds a few boxes in a row, for rays through scenes of few objects.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "core/accel/interval_packet.hpp"
#include "core/csg/evaluate.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/math/lanes.hpp"

namespace crt::core {

/// A FlatBoxList does what EmbreeTree does, for boxes so few that to test them all takes less than
/// a tree takes to begin. It tests four at a time, in doubles.
class FlatBoxList {
 public:
  static constexpr std::size_t max_boxes = 64;

  FlatBoxList() = default;
  /// Takes up to max_boxes boxes, all of them finite.
  explicit FlatBoxList(std::span<const Bounds> boxes)
      : groups_((boxes.size() + lane_count - 1) / lane_count), count_(boxes.size()) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      Group& group = groups_[i / lane_count];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        group.lower[axis][i % lane_count] = boxes[i].lower[static_cast<int>(axis)];
        group.upper[axis][i % lane_count] = boxes[i].upper[static_cast<int>(axis)];
      }
    }
  }

  std::uint64_t bytes() const { return groups_.capacity() * sizeof(Group); }

  /// Returns for which rays of a packet it can be asked: not for those that begin behind their
  /// origin, or that are all but parallel to boxes' sides.
  template <class Real>
  static RayMask takes(const RayPacketOf<Real>& packet, RayMask rays) {
    RayMask taken = 0;
    packet.for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      const FilterLine<Real>& lines = packet.groups[group];
      const Real steepest =
          max(max(abs(lines.inverse[0]), abs(lines.inverse[1])), abs(lines.inverse[2]));
      const auto is_taken = lines.begin >= 0.0 && steepest < RaySlabs::largest_inverse;
      taken |= (lanes & mask_of(is_taken)) << (group * packet.group_size);
    });
    return taken;
  }

  /// Visits, from near to far, at least every box that the ray meets at t_min <= t <= limit.
  /// visit(box) returns the t beyond which nothing matters, or one below t_min to stop.
  template <class Visit>
  void traverse(const SingleRay& ray, const Visit& visit) const {
    BoxTimes enter;
    const std::uint64_t met = boxes_met(ray.groups[0], ray.limits[0], enter);
    visit_all<true>(met, enter, ray.groups[0].begin, ray.limits[0], visit);
  }

  /// Visits at least every box that some rays of a packet meet, all of which must be taken.
  /// visit(box, met) gets a box and those rays that may meet it within their limits, and returns
  /// the rays whose limits it has changed. All rays share one order from near to far, and without
  /// FromNear the order is any.
  template <bool FromNear, class Visit>
  void traverse(const RayPacket& packet, RayMask rays, const Visit& visit) const {
    const IntervalPacket intervals(packet, rays);
    BoxTimes enter;
    const std::uint64_t met = boxes_met(intervals, enter);
    double limit = intervals.end();
    visit_all<FromNear>(met, enter, intervals.begin(), limit, [&](std::uint32_t box) {
      const RayMask meeting = rays_meeting(box, packet, rays);
      if (meeting != 0 && visit(box, meeting) != 0)
        limit = IntervalPacket::last_limit(packet, rays);
      return limit;
    });
  }

 private:
  /// ByAxis has the lower or upper ends of boxes by axis, or the origins of lines, or their inverse
  /// directions.
  using ByAxis = std::array<Lanes, 3>;
  struct Group {
    ByAxis lower{};
    ByAxis upper{};
  };

  /// BoxTimes are when something enters each of the boxes. They are of use only where it does.
  struct BoxTimes {
    alignas(sizeof(Lanes)) std::array<double, max_boxes> of;

    void set(std::size_t group, const Lanes& times) { put_lanes(times, of, group * lane_count); }
  };

  /// Spans are when lines are in boxes.
  struct Spans {
    Lanes from;
    Lanes to;

    /// Returns which spans are empty, if `from` is not below 0. What overflows is NaN, and no span
    /// is empty that begins with it.
    LaneMask empty() const { return safe_from() > to; }
    /// Returns `from` made earlier by as much as all roundings of both ends, by which RaySlabs
    /// widens each end.
    Lanes safe_from() const { return fma(from, lanes_of(-4 * RaySlabs::slack), from); }
  };

  [[gnu::always_inline]] static Spans spans(const Group& boxes, const ByAxis& origin,
                                            const ByAxis& inverse, const Lanes& begin,
                                            const Lanes& limit) {
    Spans result{begin, limit};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Lanes first = (boxes.lower[axis] - origin[axis]) * inverse[axis];
      const Lanes second = (boxes.upper[axis] - origin[axis]) * inverse[axis];
      result.from = max(result.from, min(first, second));
      result.to = min(result.to, max(first, second));
    }
    return result;
  }

  template <bool FromNear, class Visit>
  static void visit_all(std::uint64_t boxes, const BoxTimes& enter, double begin, double limit,
                        const Visit& visit) {
    while (boxes != 0) {
      const std::size_t box = FromNear ? nearest(boxes, enter) : first_of(boxes);
      boxes &= ~(std::uint64_t{1} << box);
      if (enter.of[box] > limit) {
        if (FromNear) return;
        continue;
      }
      limit = visit(static_cast<std::uint32_t>(box));
      if (limit < begin) return;
    }
  }

  static std::size_t first_of(std::uint64_t boxes) {
    return static_cast<std::size_t>(std::countr_zero(boxes));
  }
  static std::size_t nearest(std::uint64_t boxes, const BoxTimes& enter) {
    std::size_t nearest = first_of(boxes);
    for (std::uint64_t rest = boxes & (boxes - 1); rest != 0; rest &= rest - 1) {
      const std::size_t other = first_of(rest);
      if (enter.of[other] < enter.of[nearest]) nearest = other;
    }
    return nearest;
  }

  /// Returns a bit for each box that the ray meets, and sets when it enters those.
  [[gnu::always_inline]] std::uint64_t boxes_met(const FilterLine<double>& line, double limit,
                                                 BoxTimes& enter) const {
    ByAxis origin;
    ByAxis inverse;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin[axis] = lanes_of(line.origin[axis]);
      inverse[axis] = lanes_of(line.inverse[axis]);
    }
    std::uint64_t missed = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      const Spans of_ray =
          spans(groups_[i], origin, inverse, lanes_of(line.begin), lanes_of(limit));
      enter.set(i, of_ray.safe_from());
      missed |= static_cast<std::uint64_t>(mask_of(of_ray.empty())) << (i * lane_count);
    }
    return ~missed & all_boxes();
  }

  /// Returns a bit for each box that some ray may meet, and sets a time before which none is in
  /// there.
  [[gnu::always_inline]] std::uint64_t boxes_met(const IntervalPacket& intervals,
                                                 BoxTimes& enter) const {
    std::uint64_t missed = 0;
    for (std::size_t i = 0; i < groups_.size(); ++i) {
      Spans of_any{lanes_of(intervals.begin()), lanes_of(intervals.end())};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        intervals.bound(axis, groups_[i].lower[axis], groups_[i].upper[axis], of_any.from,
                        of_any.to);
      }
      enter.set(i, of_any.safe_from());
      missed |= static_cast<std::uint64_t>(mask_of(of_any.empty())) << (i * lane_count);
    }
    return ~missed & all_boxes();
  }

  [[gnu::always_inline]] RayMask rays_meeting(std::uint32_t box, const RayPacket& packet,
                                              RayMask rays) const {
    const Group& boxes = groups_[box / lane_count];
    const std::size_t i = box % lane_count;
    Group same;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      same.lower[axis] = lanes_of(boxes.lower[axis][i]);
      same.upper[axis] = lanes_of(boxes.upper[axis][i]);
    }
    RayMask met = 0;
    RayPacket::for_each_group(rays, [&](std::size_t group, RayMask lanes) {
      const FilterLine<Lanes>& lines = packet.groups[group];
      const Spans of_rays =
          spans(same, lines.origin, lines.inverse, lines.begin, packet.limits[group]);
      met |= (lanes & ~mask_of(of_rays.empty())) << (group * lane_count);
    });
    return met;
  }

  std::uint64_t all_boxes() const {
    return count_ == 0 ? 0 : ~std::uint64_t{0} >> (max_boxes - count_);
  }

  std::vector<Group> groups_;
  std::size_t count_ = 0;
};

}  // namespace crt::core
