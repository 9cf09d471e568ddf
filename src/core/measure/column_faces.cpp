#include "core/measure/column_faces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace crt::core {

namespace {

using SeriesJet = JetOf<PatchSeries>;

/// A function that changes no more, for its steepest slope, does not change.
constexpr double straight = 0x1p-44;

/// Returns how much a face's function may change from the middle to an end along an axis, but for
/// what it does across.
double change_along(const CellFace& face, int axis) {
  return std::abs(face.slope[axis]) + face.error;
}

/// Returns whether a face's function changes so little along an axis that it is a wall. A joint may
/// be bent across the axis: that matters little, since the faces that it joins meet there.
bool is_wall(const CellFace& face, const Vec3& half, int axis) {
  const double change =
      face.is_surface ? change_along(face, axis) : face.slopes[at(axis)].magnitude() * half[axis];
  return change <= straight * largest_component(face.slope);
}

/// Returns a table of where a face is surface of the solid.
std::uint32_t surface_of(const CellLook& look, std::size_t face) {
  std::uint32_t surface = 0;
  const std::uint32_t bit = 1U << face;
  if (!look.faces[face].is_surface) return surface;
  for (std::uint32_t m = 0; m < 1U << look.faces.size(); ++m)
    if (look.is_inside(m | bit) != look.is_inside(m & ~bit)) surface |= 1U << m;
  return surface;
}

/// A HeightSearch finds the height of a face.
class HeightSearch {
 public:
  HeightSearch(const CellSolid& solid, const CellFace& face, const ColumnFrame& frame)
      : solid_(solid), face_(face), frame_(frame) {}

  /// Returns the height to a tolerance, if it can be, or nothing if it is not known to be one.
  std::optional<PatchSeries> find(double tolerance) {
    if (!find_middle()) return {};
    const int c = frame_.c;
    const auto half = [&](int axis) {
      return 0.5 * (frame_.box.upper[axis] - frame_.box.lower[axis]);
    };
    height_ = PatchSeries::linear(middle_, -slopes_[frame_.a] / slopes_[c] * half(frame_.a),
                                  -slopes_[frame_.b] / slopes_[c] * half(frame_.b));
    // Each step finds the terms of one degree more, until they are enough.
    for (std::size_t degree = 1;; ++degree) {
      const PatchSeries off = solid_.value(face_, frame_.places_of(height_));
      const double error = rounded_up(range_of(off).magnitude() / std::abs(slopes_[c]));
      // The least slope is about that in the middle, but only it proves anything.
      if (error <= 0.5 * tolerance || degree == PatchSeries::degree) return proved(off);
      for (std::size_t i = 0; i <= PatchSeries::place(0, degree + 1); ++i)
        height_.terms[i] -= off.terms[i] / slopes_[c];
    }
  }

 private:
  /// Finds the height in the middle by Newton's iteration, and the slopes of the function there.
  bool find_middle() {
    const int c = frame_.c;
    middle_ = frame_.frame.middle[c];
    std::array<Interval, 3> place = known_point(frame_.frame.middle);
    for (int step = 0; step < 4; ++step) {
      place[at(c)] = Interval::of(middle_);
      const Jet jet = solid_.value(face_, jets_of(place));
      for (int axis = 0; axis < 3; ++axis) slopes_[axis] = jet.slope[at(axis)].middle();
      if (slopes_[c] == 0) return false;
      const double step_by = (jet.value.middle()) / slopes_[c];
      if (!std::isfinite(step_by)) return false;
      // Of a face that is far beyond an end no more has to be known.
      middle_ = std::clamp(middle_ - step_by, frame_.box.lower[c] - 2 * frame_.frame.half[c],
                           frame_.box.upper[c] + 2 * frame_.frame.half[c]);
      if (std::abs(step_by) <= 0x1p-40 * frame_.frame.half[c]) break;
    }
    return true;
  }

  /// Returns the height with its error. `off` is what the function is there. By the mean value
  /// theorem the face is no farther away than that over the least slope, which is taken where the
  /// height may be, and where the face crosses the cell.
  std::optional<PatchSeries> proved(const PatchSeries& off) const {
    const int c = frame_.c;
    Interval range = range_of(height_);
    const double margin =
        0.125 * range.width() + 0x1p-40 * (range.magnitude() + frame_.frame.half[c]);
    range = {range.lo - margin, range.hi + margin};
    if (!(range.hi >= frame_.box.lower[c] && range.lo <= frame_.box.upper[c])) return {};
    std::array<Interval, 3> around = intervals_of(frame_.box);
    around[at(c)] = range;
    const Interval slope = solid_.value(face_, jets_of(around)).slope[at(c)];
    const bool grows = face_.slopes[at(c)].lo > 0;
    if (slope.contains(0) || (slope.lo > 0) != grows) return {};
    const double least = std::min(std::abs(slope.lo), std::abs(slope.hi));
    PatchSeries result = height_;
    result.error = rounded_up(rounded_up(range_of(off).magnitude()) / least);
    if (!(result.error <= margin)) return {};
    return result;
  }

  const CellSolid& solid_;
  const CellFace& face_;
  const ColumnFrame& frame_;
  double middle_ = 0;
  Vec3 slopes_{0, 0, 0};
  PatchSeries height_;
};

}  // namespace

PatchSeries ColumnFrame::across(int axis) const {
  const double half = 0.5 * box.upper[axis] - 0.5 * box.lower[axis];
  PatchSeries x = axis == a ? PatchSeries::linear(frame.middle[axis], half, 0)
                            : PatchSeries::linear(frame.middle[axis], 0, half);
  x.error = 0x1p-52 * (std::abs(box.lower[axis]) + std::abs(box.upper[axis]));
  return x;
}
std::array<PatchSeries, 3> ColumnFrame::places_of(const PatchSeries& height) const {
  std::array<PatchSeries, 3> place;
  place[at(a)] = across(a);
  place[at(b)] = across(b);
  place[at(c)] = height;
  return place;
}

bool ColumnFaces::find(const CellSolid& solid, const CellLook& look, const ColumnFrame& frame,
                       double tolerance) {
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    const CellFace& face = look.faces[i];
    if (is_wall(face, frame.frame.half, frame.c)) {
      walls.push_back({i,
                       {face.value, {face.slope[frame.a], face.slope[frame.b], 0}},
                       change_along(face, frame.c),
                       surface_of(look, i)});
      continue;
    }
    if (face.slopes[at(frame.c)].contains(0) || !solid.functions(face.leaf).has_series())
      return false;
    const std::optional<PatchSeries> height = HeightSearch(solid, face, frame).find(tolerance);
    if (!height) return false;
    heights.push_back({i, face.slopes[at(frame.c)].lo > 0, *height});
  }
  const auto is_bent = [](const ColumnWall& wall) {
    return wall.error > straight * largest_component(wall.function.slope);
  };
  if (walls.size() > 1 && std::ranges::any_of(walls, is_bent)) return false;
  return !heights.empty();
}

PatchSeries slant_of(const CellSolid& solid, const CellLook& look, const ColumnFrame& frame,
                     const ColumnHeight& height) {
  const std::array<PatchSeries, 3> on = frame.places_of(height.place);
  const PatchSeries none;
  const PatchSeries one = PatchSeries::of(Interval::of(1));
  const std::array<SeriesJet, 3> jets = {SeriesJet{on[0], {one, none, none}},
                                         SeriesJet{on[1], {none, one, none}},
                                         SeriesJet{on[2], {none, none, one}}};
  const auto slope = solid.value(look.faces[height.face], jets).slope;
  const PatchSeries length = root(square(slope[0]) + square(slope[1]) + square(slope[2]));
  return length * inverse(height.grows ? slope[at(frame.c)] : -slope[at(frame.c)]);
}

int column_axis_of(const CellLook& look, const Vec3& half) {
  int best = -1;
  double steepest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double least = infinity;
    bool has_height = false;
    for (const CellFace& face : look.faces) {
      if (is_wall(face, half, axis)) continue;
      const double length = largest_component(face.slope / half);
      const double slope = std::abs(face.slope[axis]) / half[axis];
      has_height = true;
      if (face.slopes[at(axis)].contains(0)) least = 0;
      least = std::min(least, slope / length);
    }
    if (has_height && least > steepest) {
      steepest = least;
      best = axis;
    }
  }
  return best;
}

bool order_matters(const CellLook& look, std::uint32_t table, const ColumnHeight& one,
                   const ColumnHeight& other) {
  const std::uint32_t a = 1U << one.face;
  const std::uint32_t b = 1U << other.face;
  for (std::uint32_t m = 0; m < 1U << look.faces.size(); ++m) {
    if ((m & (a | b)) != 0) continue;
    const auto differ = [&](std::uint32_t x, std::uint32_t y) {
      return (table >> (m | x) & 1U) != (table >> (m | y) & 1U);
    };
    if ((differ(0, a) || differ(b, a | b)) && (differ(0, b) || differ(a, a | b))) return true;
  }
  return false;
}

bool only_exchanges(const CellLook& look, const ColumnWall& wall, const ColumnHeight& one,
                    const ColumnHeight& other) {
  const std::uint32_t bit = 1U << wall.face;
  const std::uint32_t both = 1U << one.face | 1U << other.face;
  // Below a height its function is negative if it grows.
  const std::uint32_t below =
      (one.grows ? 1U << one.face : 0) | (other.grows ? 1U << other.face : 0);
  for (std::uint32_t m = 0; m < 1U << look.faces.size(); ++m) {
    if (look.is_inside(m) == look.is_inside(m ^ bit)) continue;
    const std::uint32_t not_below = (m ^ below) & both;
    if (not_below == 0 || not_below == both) return false;
    const std::uint32_t rest = m & ~both;
    if (look.is_inside(rest | below) == look.is_inside(rest | (both ^ below))) return false;
  }
  return true;
}

}  // namespace crt::core
