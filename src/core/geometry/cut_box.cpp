#include "core/geometry/cut_box.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

namespace crt::core {

namespace {

/// Returns the cells where f of a cut is below 0, or those where it is above.
Cells side_of_cut(std::size_t cut, bool is_below, Cells all) {
  const Cells below = (cut == 0 ? 0b1010U : 0b1100U) & all;
  return is_below ? below : all & ~below;
}

/// A RoughCut is a cut in rounded arithmetic.
struct RoughCut {
  double curving = 0;
  Vec3 slope{0, 0, 0};
  double at_middle = 0;

  RoughCut() = default;
  explicit RoughCut(const Cut& cut)
      : curving(cut.curving.middle()),
        slope(middle_of(cut.slope)),
        at_middle(cut.at_middle.middle()) {}
  double value(const Vec3& offset) const {
    return curving * glm::dot(offset, offset) + glm::dot(slope, offset) + at_middle;
  }
};

}  // namespace

CutBox::CutBox(const PointOf<Interval>& box) : box_(box), middle_(middle_of(box)) {
  offset_ = relative_to(box_, middle_);
}

std::array<CutBox::Sample, 4> CutBox::find_samples() const {
  // Points of round numbers would often be level with corners, which takes exact arithmetic.
  constexpr std::array<double, 3> shares = {0.4871, 0.0213, 0.9829};
  std::array<RoughCut, most_cuts> rough;
  for (std::size_t cut = 0; cut < count_; ++cut) rough[cut] = RoughCut(cuts_[cut]);
  std::array<Sample, 4> samples;
  const auto try_at = [&](const Vec3& offset) {
    unsigned cell = 0;
    double distance = infinity;
    for (std::size_t cut = 0; cut < count_; ++cut) {
      const double value = rough[cut].value(offset);
      if (value < 0) cell |= 1U << cut;
      distance = std::min(distance, std::abs(value));
    }
    if (distance > samples[cell].distance) samples[cell] = {middle_ + offset, distance};
  };
  const Vec3 size(box_[0].width(), box_[1].width(), box_[2].width());
  const auto count = [&](int axis) { return count_ == 0 || size[axis] == 0 ? 1U : shares.size(); };
  const Vec3 lower(offset_[0].lo, offset_[1].lo, offset_[2].lo);
  for (std::size_t i = 0; i < count(0); ++i) {
    for (std::size_t j = 0; j < count(1); ++j) {
      for (std::size_t k = 0; k < count(2); ++k)
        try_at(lower + size * Vec3(shares[i], shares[j], shares[k]));
    }
  }
  // From cell to opposite cell a line crosses both cuts, and between them one that may be thin.
  for (const unsigned cell : {0U, 1U}) {
    const Sample from = samples[cell];
    const Sample to = samples[cell ^ 3];
    if (count_ < most_cuts || !(from.distance > 0 && to.distance > 0)) continue;
    const Vec3 begin = from.point - middle_;
    const Vec3 way = to.point - from.point;
    double share = 0;
    for (const RoughCut& cut : rough) {
      const double value = cut.value(begin);
      share += 0.5 * value / (value - cut.value(begin + way));
    }
    try_at(begin + share * way);
  }
  for (unsigned cell = 0; cell < cell_count(); ++cell) {
    if (samples[cell].distance > 0 && !is_surely_in(samples[cell].point, cell))
      samples[cell].distance = 0;
  }
  return samples;
}

bool CutBox::is_surely_in(const Vec3& point, unsigned cell) const {
  const PointOf<Interval> place = known_point(point);
  for (std::size_t i = 0; i < 3; ++i) {
    if (place[i].lo < box_[i].lo || place[i].hi > box_[i].hi) return false;
  }
  const PointOf<Interval> offset = relative_to(place, middle_);
  for (std::size_t cut = 0; cut < count_; ++cut) {
    const Interval value = cuts_[cut].value(offset);
    if ((cell >> cut & 1) != 0 ? value.hi >= 0 : value.lo <= 0) return false;
  }
  return true;
}

Cells CutBox::empty_cells() const {
  Cells empty = 0;
  if (count_ < most_cuts) return empty;
  for (unsigned cell = 0; cell < cell_count(); ++cell) {
    Cut sum;
    for (std::size_t i = 0; i < count_; ++i) {
      const Cut& cut = cuts_[i];
      const Interval sign = Interval::of((cell >> i & 1) != 0 ? 1 : -1);
      sum.curving = sum.curving + sign * cut.curving;
      sum.at_middle = sum.at_middle + sign * cut.at_middle;
      for (std::size_t axis = 0; axis < 3; ++axis)
        sum.slope[axis] = sum.slope[axis] + sign * cut.slope[axis];
    }
    if (sum.value(offset_).lo >= 0) empty |= 1U << cell;
  }
  return empty;
}

Cells CutBox::full_by_turns(unsigned cell, bool is_full) const {
  Cells full = 0;
  for (unsigned other = 0; other < cell_count(); ++other) {
    const bool is_across = std::popcount(cell ^ other) % 2 != 0;
    if (is_full != is_across) full |= 1U << other;
  }
  return full;
}

void CutBox::say(Cells with_points, Cells full, NearFaces& near) const {
  using enum NearFaces::Kind;
  const Cells all = all_cells();
  const auto is_full_in = [&](Cells cells) { return ((cells ^ full) & with_points) == 0; };
  const auto side = [&](std::size_t cut, bool is_below) { return side_of_cut(cut, is_below, all); };
  const auto face = [&](std::size_t cut, bool is_below) {
    return is_below ? cuts_[cut].face : cuts_[cut].flipped;
  };
  if (is_full_in(0)) return near.say(outside);
  if (is_full_in(all)) return near.say(inside);
  for (std::size_t cut = 0; cut < count_; ++cut) {
    for (const bool below : {true, false}) {
      if (is_full_in(side(cut, below))) return near.say(where_all_negative, {face(cut, below)});
    }
  }
  if (count_ == most_cuts) {
    for (const bool first : {true, false}) {
      for (const bool second : {true, false}) {
        const Cells a = side(0, first);
        const Cells b = side(1, second);
        if (is_full_in(a & b))
          return near.say(where_all_negative, {face(0, first), face(1, second)});
        if (is_full_in(a | b))
          return near.say(where_any_negative, {face(0, first), face(1, second)});
      }
    }
  }
  near.say(unknown);
}

}  // namespace crt::core
