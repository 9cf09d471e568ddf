// One or two surfaces cut a box into cells. A solid that has no other surface in the box is full or
// empty in each of them. So what it is there follows from a few points (face_functions.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/geometry/face_functions.hpp"

namespace crt::core {

/// A Cut is a function of the offset o from the middle of a box,
///    f(o) = curving |o|^2 + slope . o + at_middle,
/// which is 0 on the cut. The slope is about 1.
struct Cut {
  Interval curving{0, 0};
  PointOf<Interval> slope{};
  Interval at_middle{0, 0};
  std::uint32_t face = 0;     ///< has a function that is below 0 where f is
  std::uint32_t flipped = 0;  ///< has one that is below 0 where f is above

  Interval value(const PointOf<Interval>& offset) const {
    return curving * squared_length(offset) + component_along(offset, slope) + at_middle;
  }
};

/// Cells have a bit for each cell of a box: 1 << (the cuts whose f is below 0).
using Cells = unsigned;

class CutBox {
 public:
  explicit CutBox(const PointOf<Interval>& box);

  const PointOf<Interval>& box() const { return box_; }
  const Vec3& middle() const { return middle_; }

  static constexpr std::size_t most_cuts = 2;
  /// Adds a cut, of which there must be fewer than most_cuts.
  void add(const Cut& cut) { cuts_[count_++] = cut; }

  /// Says what a solid is that is full or empty in each cell. The cuts are flat. is_inside(point)
  /// returns whether a point is in the solid, if that is plain.
  template <class IsInside>
  void look(const IsInside& is_inside, NearFaces& near) const {
    const std::array<Sample, 4> samples = find_samples();
    Cells known = 0;
    Cells full = 0;
    for (unsigned cell = 0; cell < cell_count(); ++cell) {
      if (!(samples[cell].distance > 0)) continue;
      const std::optional<bool> inside = is_inside(samples[cell].point);
      if (!inside) return near.say(NearFaces::Kind::unknown);
      known |= 1U << cell;
      if (*inside) full |= 1U << cell;
    }
    if (known != all_cells() && (known | empty_cells()) != all_cells())
      return near.say(NearFaces::Kind::unknown);
    say(known, full, near);
  }
  /// Says so of a solid that is full on one side of each cut, of whatever form, and empty on the
  /// other.
  template <class IsInside>
  void look_by_turns(const IsInside& is_inside, NearFaces& near) const {
    const std::array<Sample, 4> samples = find_samples();
    for (unsigned cell = 0; cell < cell_count(); ++cell) {
      if (!(samples[cell].distance > 0)) continue;
      const std::optional<bool> inside = is_inside(samples[cell].point);
      if (!inside) continue;
      return say(all_cells() & ~empty_cells(), full_by_turns(cell, *inside), near);
    }
    near.say(NearFaces::Kind::unknown);
  }

 private:
  /// A Sample is a point of a cell, and about how far it is from the cuts. Cells without one have 0
  /// there.
  struct Sample {
    Vec3 point{0, 0, 0};
    double distance = 0;
  };
  unsigned cell_count() const { return 1U << count_; }
  Cells all_cells() const { return (1U << cell_count()) - 1; }
  /// Returns for each cell the point, of some of the box, that is farthest from the cuts.
  std::array<Sample, 4> find_samples() const;
  /// Returns whether a point is in the box, and in a cell.
  bool is_surely_in(const Vec3& point, unsigned cell) const;
  /// Returns cells that surely have no point.
  Cells empty_cells() const;
  Cells full_by_turns(unsigned cell, bool is_full) const;
  /// Says which function of the faces is full in the cells that have points.
  void say(Cells with_points, Cells full, NearFaces& near) const;

  PointOf<Interval> box_;
  Vec3 middle_;
  PointOf<Interval> offset_;  ///< of all points from the middle
  std::array<Cut, most_cuts> cuts_;
  std::size_t count_ = 0;
};

}  // namespace crt::core
