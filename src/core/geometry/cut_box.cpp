#include "core/geometry/cut_box.hpp"

#include <algorithm>
#include <bit>

namespace crt::core {

namespace {

/// Returns the cells where f of a cut is below 0, or those where it is above.
Cells side_of_cut(std::size_t cut, bool is_below, Cells all) {
  const Cells below = (cut == 0 ? 0b1010U : 0b1100U) & all;
  return is_below ? below : all & ~below;
}

Vec3 middle_of_box(const PointOf<Interval>& box) {
  const auto middle = [&](std::size_t i) { return 0.5 * box[i].lo + 0.5 * box[i].hi; };
  return {middle(0), middle(1), middle(2)};
}

}  // namespace

CutBox::CutBox(const PointOf<Interval>& box) : box_(box), middle_(middle_of_box(box)) {
  offset_ = relative_to(box_, middle_);
}

std::array<CutBox::Sample, 4> CutBox::find_samples() const {
  constexpr std::array<double, 3> shares = {0.5, 0.02, 0.98};
  const auto count = [&](std::size_t axis) { return box_[axis].is_point() ? 1U : shares.size(); };
  std::array<Sample, 4> samples;
  const auto place = [&](std::size_t axis, std::size_t i) {
    const Interval& range = box_[axis];
    return std::clamp(range.lo + shares[i] * (range.hi - range.lo), range.lo, range.hi);
  };
  for (std::size_t i = 0; i < count(0); ++i) {
    for (std::size_t j = 0; j < count(1); ++j) {
      for (std::size_t k = 0; k < count(2); ++k) {
        const Vec3 point(place(0, i), place(1, j), place(2, k));
        const PointOf<Interval> offset = relative_to(known_point(point), middle_);
        unsigned cell = 0;
        double distance = infinity;
        for (std::size_t cut = 0; cut < count_; ++cut) {
          const Interval value = cuts_[cut].value(offset);
          if (value.hi < 0) cell |= 1U << cut;
          distance = std::min(distance, std::max(value.lo, -value.hi));
        }
        if (distance > samples[cell].distance) samples[cell] = {point, distance};
        if (count_ == 0) return samples;
      }
    }
  }
  return samples;
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
