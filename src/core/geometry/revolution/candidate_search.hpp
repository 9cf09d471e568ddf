// A line finds in a tree the pieces of a profile that it may cross as the profile turns.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/geometry/near_line.hpp"
#include "core/geometry/open_nodes.hpp"
#include "core/geometry/revolution/turned_walls.hpp"

namespace crt::core {

/// A CandidateSearch finds the pieces whose boxes a line passes through.
class CandidateSearch {
 public:
  CandidateSearch(const TurnedProfile& turned, const ObjectRay& ray)
      : size_(turned.size()),
        unit_(power_of_two_below(size_)),
        middle_(0, 0.5 * turned.profile->bounds().lower.y + 0.5 * turned.profile->bounds().upper.y,
                0),
        line_(NearLine::at_closest(ray, middle_, unit_)) {
    const Vec3& p = line_.point;
    const Vec3& d = line_.direction;
    const double closest = line_.closest();
    const Vec3 nearest = line_.at(closest);
    // The solid is within a sphere of this radius.
    const double reach = 2 * size_ / unit_;
    const double distance = glm::length(nearest);
    if (!(distance < reach)) return;
    const double half = reach / std::sqrt(line_.squared_length);
    span_ = {closest - half, closest + half};
    squared_speed_ = d.x * d.x + d.z * d.z;
    lowest_at_ = squared_speed_ > 0 ? -(p.x * d.x + p.z * d.z) / squared_speed_ : 0;
    is_level_ = std::abs(d.y) * half <= margin * reach;
    const double last =
        std::max(std::abs(line_.to_t(span_.enter)), std::abs(line_.to_t(span_.leave)));
    shortest_ = roundings * rounding_of(last) * glm::length(ray.direction);
  }

  bool misses() const { return span_.empty(); }
  /// Returns the length below which a body may not be seen: both ends of its part of the line may
  /// have one t.
  double shortest() const { return shortest_; }
  /// Returns whether the line is so nearly across the axis, and so near the height of a corner,
  /// that nothing else is plain.
  bool is_along(const Vec3& corner) const {
    constexpr double wide_margin = 4 * margin;
    const double height = (corner.y - middle_.y) / unit_ - line_.point.y;
    return is_level_ && std::abs(height) <= wide_margin * (size_ / unit_);
  }

  bool comes_near(const Bounds& box) const {
    const double off = margin * (size_ / unit_);
    const double low = (box.lower.y - middle_.y) / unit_ - off - line_.point.y;
    const double high = (box.upper.y - middle_.y) / unit_ + off - line_.point.y;
    LineSpan part = span_;
    const double climb = line_.direction.y;
    if (is_level_) {
      if (low > 4 * off || high < -4 * off) return false;
    } else {
      part.enter = std::max(part.enter, std::min(low / climb, high / climb));
      part.leave = std::min(part.leave, std::max(low / climb, high / climb));
      if (part.empty()) return false;
    }
    const double nearest = std::clamp(lowest_at_, part.enter, part.leave);
    const double inner = std::max(box.lower.x / unit_ - off, 0.0);
    const double outer = box.upper.x / unit_ + off;
    const double farthest = std::max(squared_distance(part.enter), squared_distance(part.leave));
    return squared_distance(nearest) <= outer * outer + off * off &&
           farthest >= inner * inner - off * off;
  }

  template <class Meet>
  void each(const Bvh& tree, const Meet& meet) const {
    OpenNodes<std::uint32_t, 128> open;
    open.push(0);
    while (!open.empty()) {
      tree.for_each_child(open.pop(), [&](Bvh::Child child, const Bounds& box) {
        if (!comes_near(box)) return;
        if (child.is_leaf()) {
          for (const std::uint32_t item : tree.order().subspan(child.index(), child.count())) {
            meet(item);
          }
        } else {
          open.push(child.index());
        }
      });
    }
  }

 private:
  static constexpr double margin = 0x1p-40;
  static constexpr double roundings = 4;

  double squared_distance(double x) const {
    const Vec3 p = line_.at(x);
    return p.x * p.x + p.z * p.z;
  }

  double size_;
  double unit_;
  Vec3 middle_;
  NearLine line_;
  LineSpan span_{0, -1};
  double squared_speed_ = 0;
  double lowest_at_ = 0;
  bool is_level_ = false;
  double shortest_ = 0;
};

}  // namespace crt::core
