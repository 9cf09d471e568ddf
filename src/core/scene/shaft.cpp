#include "core/scene/shaft.hpp"

#include <algorithm>
#include <cmath>

namespace crt::core {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Relative, far more than the few roundings of a place.
constexpr double slack = 0x1p-46;

double least_of(const Lanes& a) {
  return std::min(std::min(a[0], a[1]), std::min(a[2], a[3]));
}

double most_of(const Lanes& a) {
  return std::max(std::max(a[0], a[1]), std::max(a[2], a[3]));
}

}  // namespace

std::optional<Shaft> Shaft::around(const RayPacket& packet, const Bounds& space) {
  Shaft shaft;
  const std::array<Lanes, 3>& direction = packet.groups.front().direction;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (std::abs(direction[axis][0]) > std::abs(direction[shaft.main_][0])) shaft.main_ = axis;
  }
  const int main = static_cast<int>(shaft.main_);
  shaft.sign_ = direction[shaft.main_][0] < 0 ? -1 : 1;

  Lanes start = lanes_of(infinity);
  for (const OutlineLine<Lanes>& lines : packet.groups) {
    const Lanes place = shaft.place_of(lines);
    const Lanes way = lines.begin * shaft.speed_of(lines);
    start = min(start, place + way - slack * (size_of(place) + size_of(way)));
  }
  shaft.first_ = std::max(least_of(start), shaft.sign_ > 0 ? space.lower[main] : -space.upper[main]);
  shaft.start_ = least_of(start) - shaft.first_;
  for (std::size_t i = 0; i < shaft.across_.size(); ++i) {
    shaft.across_[i].axis = (shaft.main_ + 1 + i) % 3;
    if (!shaft.set(shaft.across_[i], packet)) return std::nullopt;
  }
  shaft.set_limits(packet);
  return shaft;
}

bool Shaft::set(Across& across, const RayPacket& packet) {
  Lanes least = lanes_of(infinity);
  Lanes most = lanes_of(-infinity);
  Lanes least_slope = lanes_of(infinity);
  Lanes most_slope = lanes_of(-infinity);
  for (const OutlineLine<Lanes>& lines : packet.groups) {
    const Lanes speed = speed_of(lines);
    if (!all(speed > 0.0)) return false;
    const Lanes slope = lines.direction[across.axis] / speed;
    const Lanes way = (first_ - place_of(lines)) * slope;
    const Lanes place = lines.origin[across.axis];
    const Lanes error = slack * (size_of(place) + size_of(way));
    least = min(least, place + way - error);
    most = max(most, place + way + error);
    least_slope = min(least_slope, slope);
    most_slope = max(most_slope, slope);
  }
  across.least = least_of(least);
  across.most = most_of(most);
  across.least_slope = least_of(least_slope);
  across.most_slope = most_of(most_slope);
  constexpr double steepest = 2;
  constexpr double widest = 0.25;
  return across.most - across.least < infinity && across.least_slope > -steepest &&
         across.most_slope < steepest && across.most_slope - across.least_slope < widest;
}

void Shaft::set_limits(const RayPacket& packet) {
  Lanes last = lanes_of(-infinity);
  for (std::size_t group = 0; group < RayPacket::group_count; ++group) {
    const Lanes place = place_of(packet.groups[group]);
    const Lanes way = packet.limits[group] * speed_of(packet.groups[group]);
    const Lanes end = place + way;
    last = max(last, end + slack * (size_of(place) + size_of(end)));
  }
  end_ = most_of(last) - first_;
}

std::uint32_t Shaft::meets(const BoxLanes& boxes, Lanes& begin) const {
  const Lanes& near = sign_ > 0 ? boxes.lower[main_] : -boxes.upper[main_];
  const Lanes& far = sign_ > 0 ? boxes.upper[main_] : -boxes.lower[main_];
  const Lanes to = far - first_;
  begin = max(near - first_, Lanes{});
  LaneMask met = (to >= start_) & (begin <= end_);
  for (const Across& u : across_) {
    // Where in the box the bound is farthest out.
    const Lanes& low_at = u.least_slope < 0 ? to : begin;
    const Lanes& high_at = u.most_slope > 0 ? to : begin;
    met &= boxes.upper[u.axis] >= u.least + low_at * u.least_slope;
    met &= boxes.lower[u.axis] <= u.most + high_at * u.most_slope;
  }
  return mask_of(met);
}

}  // namespace crt::core
