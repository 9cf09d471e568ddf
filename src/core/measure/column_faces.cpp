#include "core/measure/column_faces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace crt::core {

namespace {

using SeriesJet = JetOf<PatchSeries>;

/// A function that changes less along the column than this, relative to across, is a wall.
constexpr double straight = 0x1p-44;

/// Finds the height of a face, or nothing if it is not known to be one.
std::optional<ColumnHeight> find_height(const CellSolid& solid, const CellLook& look,
                                        const ColumnFrame& frame, std::size_t number) {
  const CellFace& face = look.faces[number];
  double middle = frame.frame.middle[frame.c];
  Vec3 slopes{0, 0, 0};
  for (int step = 0; step < 4; ++step) {
    std::array<Interval, 3> place;
    for (int axis = 0; axis < 3; ++axis) place[at(axis)] = Interval::of(frame.frame.middle[axis]);
    place[at(frame.c)] = Interval::of(middle);
    const Jet jet = solid.value(face, jets_of(place));
    for (int axis = 0; axis < 3; ++axis)
      slopes[axis] = 0.5 * jet.slope[at(axis)].lo + 0.5 * jet.slope[at(axis)].hi;
    if (slopes[frame.c] == 0) return {};
    middle -= (0.5 * jet.value.lo + 0.5 * jet.value.hi) / slopes[frame.c];
    if (!std::isfinite(middle)) return {};
    // Of a face that is far beyond an end no more has to be known.
    middle = std::clamp(middle, frame.box.lower[frame.c] - 2 * frame.frame.half[frame.c],
                        frame.box.upper[frame.c] + 2 * frame.frame.half[frame.c]);
  }
  PatchSeries height =
      PatchSeries::linear(middle,
                          -slopes[frame.a] / slopes[frame.c] *
                              (0.5 * (frame.box.upper[frame.a] - frame.box.lower[frame.a])),
                          -slopes[frame.b] / slopes[frame.c] *
                              (0.5 * (frame.box.upper[frame.b] - frame.box.lower[frame.b])));
  // Each step finds the terms of one degree more.
  for (std::size_t step = 1; step < PatchSeries::degree; ++step) {
    const PatchSeries off = solid.value(face, frame.places_of(height));
    for (std::size_t i = 0; i <= PatchSeries::place(0, step + 1); ++i)
      height.terms[i] -= off.terms[i] / slopes[frame.c];
  }
  const double off = range_of(solid.value(face, frame.places_of(height))).magnitude();
  // By the mean value theorem the face is no farther away than this over the least slope. That is
  // taken where the height may be, and where the face crosses the cell.
  Interval range = range_of(height);
  const double margin = 0.125 * range.width() + 0x1p-40 * range.magnitude();
  range = {range.lo - margin, range.hi + margin};
  if (!(range.hi >= frame.box.lower[frame.c] && range.lo <= frame.box.upper[frame.c])) return {};
  std::array<Interval, 3> around = intervals_of(frame.box);
  around[at(frame.c)] = range;
  const Interval slope = solid.value(face, jets_of(around)).slope[at(frame.c)];
  const bool grows = face.slopes[at(frame.c)].lo > 0;
  if (slope.contains(0) || (slope.lo > 0) != grows) return {};
  const double least = std::min(std::abs(slope.lo), std::abs(slope.hi));
  height.error = rounded_up(rounded_up(off) / least);
  if (!(height.error <= margin)) return {};
  return ColumnHeight{number, grows, height};
}

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

bool ColumnFaces::find(const CellSolid& solid, const CellLook& look, const ColumnFrame& frame) {
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    const CellFace& face = look.faces[i];
    const double along = std::abs(face.slope[frame.c]) + face.error;
    const double across = std::max(std::abs(face.slope[frame.a]), std::abs(face.slope[frame.b]));
    if (along <= straight * across) {
      walls.push_back({i, {face.value, {face.slope[frame.a], face.slope[frame.b], 0}}, along});
      continue;
    }
    if (face.slopes[at(frame.c)].contains(0) || !solid.functions(face.leaf).has_series())
      return false;
    const std::optional<ColumnHeight> height = find_height(solid, look, frame, i);
    if (!height) return false;
    heights.push_back(*height);
  }
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
      const double length = largest_component(face.slope / half);
      const double slope = std::abs(face.slope[axis]) / half[axis];
      const bool is_wall =
          slope * half[axis] + face.error <= straight * largest_component(face.slope);
      if (is_wall) continue;
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

}  // namespace crt::core
