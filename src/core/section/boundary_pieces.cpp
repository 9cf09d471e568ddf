#include "core/section/boundary_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/section/arc_series.hpp"
#include "core/section/boundary_edges.hpp"
#include "core/section/circle_fit.hpp"
#include "core/section/face_root.hpp"

namespace crt::core {

namespace {

/// AxisPair has the coordinates of a point, by the number of the axis.
using AxisPair = std::array<double, 2>;

AxisPair coordinates(const PlanePoint& p) {
  return {p.x, p.y};
}
PlanePoint plane_point(const AxisPair& p) {
  return {p[0], p[1]};
}

}  // namespace

/// A Part goes from one point of the curve to another, in a box that holds it.
struct PieceProver::Part {
  PlanePoint from;
  PlanePoint to;
  PlanePoint lower;
  PlanePoint upper;
  std::array<Interval, 2> slopes{};  ///< in the box
  int depth = 0;
};

/// A Curve is that of one face in a cell: a graph over one axis, or over both.
class PieceProver::Curve {
 public:
  Curve(const BoundaryLooks& looks, const CellFace& face) : looks_(looks), face_(face) {
    axes_ = {grid().axis(0), grid().axis(1)};
  }

  /// Chooses the axis over which the curve is a graph in a part: of two, that along which the part
  /// is longer.
  void choose_axis(const Part& part) {
    const bool is_longer_along_first =
        std::abs(part.to.x - part.from.x) >= std::abs(part.to.y - part.from.y);
    over_ = is_longer_along_first ? 0 : 1;
    if (part.slopes[1 - over_].contains(0)) over_ = 1 - over_;
    other_ = 1 - over_;
  }

  /// Makes the box of a part smaller, as slopes in the larger one allow, and finds the slopes in
  /// it.
  void narrow(Part& part) const {
    const AxisPair from = coordinates(part.from);
    const AxisPair to = coordinates(part.to);
    AxisPair lower = coordinates(part.lower);
    AxisPair upper = coordinates(part.upper);
    const double rounding = 8 * grid().rounding();
    const auto keep = [&](std::size_t axis, double low, double high) {
      lower[axis] = std::max(lower[axis], low - rounding);
      upper[axis] = std::min(upper[axis], high + rounding);
    };
    keep(over_, std::min(from[over_], to[over_]), std::max(from[over_], to[over_]));
    const Interval rate = -part.slopes[over_] / part.slopes[other_];
    const Interval way = hull({0, 0}, Interval::of(to[over_] - from[over_]));
    const Interval from_begin = Interval::of(from[other_]) + rate * way;
    const Interval from_end = Interval::of(to[other_]) - rate * way;
    keep(other_, from_begin.lo, from_begin.hi);
    keep(other_, from_end.lo, from_end.hi);
    for (const AxisPair& end : {from, to}) {
      lower[other_] = std::min(lower[other_], end[other_]);
      upper[other_] = std::max(upper[other_], end[other_]);
    }
    narrow_by_signs(part, lower, upper);
    part.lower = plane_point(lower);
    part.upper = plane_point(upper);
    const std::array<Interval, 2> slopes = slopes_in(part.lower, part.upper);
    for (std::size_t i = 0; i < 2; ++i) {
      const Interval both{std::max(part.slopes[i].lo, slopes[i].lo),
                          std::min(part.slopes[i].hi, slopes[i].hi)};
      part.slopes[i] = both.lo <= both.hi ? both : slopes[i];
    }
  }

  /// Returns whether halves of a part differ by more than rounding.
  bool can_be_halved(const Part& part) const {
    return std::abs(coordinates(part.to)[over_] - coordinates(part.from)[over_]) >
           8 * grid().rounding();
  }
  /// Returns the curve's point in the middle along the axis.
  PlanePoint middle(const Part& part) const {
    const AxisPair from = coordinates(part.from);
    const AxisPair to = coordinates(part.to);
    AxisPair between{};
    between[over_] = 0.5 * from[over_] + 0.5 * to[over_];
    const FaceOnLine line{looks_.solid(), grid(), face_, other_, between[over_]};
    between[other_] =
        line.root_near(0.5 * from[other_] + 0.5 * to[other_], part.slopes[other_],
                       coordinates(part.lower)[other_], coordinates(part.upper)[other_]);
    return plane_point(between);
  }

  /// Returns how far a part and its chord are from each other at most.
  double off_chord(const Part& part) const {
    const double whole = diagonal(part.lower, part.upper);
    const Direction way(part);
    if (!(way.length > 0)) return whole;
    const double steep = least_across(way, part.slopes);
    if (!(steep > 0)) return whole;
    const Interval along =
        part.slopes[0] * Interval::of(way.x) + part.slopes[1] * Interval::of(way.y);
    double off = 0;
    for (const PlanePoint& end : {part.from, part.to}) {
      const Interval value = looks_.solid().value(face_, known_point(grid().in_space(end)));
      off = std::max(off, value.magnitude());
    }
    // From the nearer end the function changes over half of the chord at most.
    const double most = (off + 0.5 * way.length * along.magnitude()) / steep;
    return std::min(most * (1 + 0x1p-40), whole);
  }
  /// Returns how far a part and an arc are from each other at most.
  double off_arc(const Part& part, double bulge) const {
    const Direction way(part);
    // The arc is in a box that is larger by its sagitta.
    const double sagitta = 0.5 * way.length * std::abs(bulge) * (1 + 0x1p-40) + grid().rounding();
    const PlanePoint lower{part.lower.x - sagitta, part.lower.y - sagitta};
    const PlanePoint upper{part.upper.x + sagitta, part.upper.y + sagitta};
    const double whole = diagonal(lower, upper);
    const double steep = least_across(way, slopes_in(lower, upper));
    if (!(steep > 0)) return whole;
    const std::array<PatchSeries, 2> arc =
        arc_series({part.from, part.to, bulge}, grid().rounding());
    std::array<PatchSeries, 3> place;
    place[axes_[0]] = arc[0];
    place[axes_[1]] = arc[1];
    place[3 - axes_[0] - axes_[1]] = PatchSeries::of(Interval::of(grid().place()));
    const double most = range_of(looks_.solid().value(face_, place)).magnitude();
    return std::min(most / steep * (1 + 0x1p-40), whole);
  }

 private:
  struct Direction {
    double length;
    double x;
    double y;

    explicit Direction(const Part& part)
        : length(distance_between(part.from, part.to)),
          x((part.to.x - part.from.x) / length),
          y((part.to.y - part.from.y) / length) {}
  };

  /// Where slopes allow for much more than the part's length, lines beside it along the axis may
  /// surely not be crossed: the function has the sign there that it has beyond the curve.
  void narrow_by_signs(const Part& part, AxisPair& lower, AxisPair& upper) const {
    const double length = distance_between(part.from, part.to);
    if (upper[other_] - lower[other_] <= 4 * length) return;
    const AxisPair from = coordinates(part.from);
    const AxisPair to = coordinates(part.to);
    const bool grows = part.slopes[other_].lo > 0;
    const auto is_beyond = [&](double place, bool is_positive) {
      AxisPair begin = lower;
      AxisPair end = upper;
      begin[other_] = end[other_] = place;
      const Interval value = looks_.solid().value(
          face_, intervals_of(grid().box(plane_point(begin), plane_point(end))));
      return is_positive ? value.lo > 0 : value.hi < 0;
    };
    const double low = std::min(from[other_], to[other_]) - length;
    const double high = std::max(from[other_], to[other_]) + length;
    if (low > lower[other_] && is_beyond(low, !grows)) lower[other_] = low;
    if (high < upper[other_] && is_beyond(high, grows)) upper[other_] = high;
  }

  const BoundaryGrid& grid() const { return looks_.grid(); }
  static double diagonal(const PlanePoint& lower, const PlanePoint& upper) {
    return distance_between(lower, upper) * (1 + 0x1p-40);
  }
  std::array<Interval, 2> slopes_in(const PlanePoint& lower, const PlanePoint& upper) const {
    const Jet jet = looks_.solid().value(face_, jets_of(intervals_of(grid().box(lower, upper))));
    return {jet.slope[axes_[0]], jet.slope[axes_[1]]};
  }
  /// Returns how much the function changes across a direction at least, or 0.
  static double least_across(const Direction& way, const std::array<Interval, 2>& slopes) {
    const Interval across = slopes[1] * Interval::of(way.x) - slopes[0] * Interval::of(way.y);
    return across.contains(0) ? 0 : std::min(std::abs(across.lo), std::abs(across.hi));
  }

  const BoundaryLooks& looks_;
  const CellFace& face_;
  std::array<std::size_t, 2> axes_{};
  std::size_t over_ = 0;
  std::size_t other_ = 1;
};

void PieceProver::prove(const BoundaryCell& cell, const BoundaryPiece& piece,
                        std::vector<BoundaryPoint>& points) const {
  if (piece.face == BoundaryCell::unknown_face) {
    points.push_back(
        {.place = piece.from, .surface = no_surface, .deviation = looks_.diagonal(cell)});
    return;
  }
  const BoundaryGrid& grid = looks_.grid();
  const CellFace& face = cell.look.faces[piece.face];
  Curve curve(looks_, face);
  const bool has_series = looks_.solid().functions(face.leaf).has_series();
  std::vector<Part> open = {{.from = piece.from,
                             .to = piece.to,
                             .lower = grid.at(cell.lower),
                             .upper = grid.at(cell.upper),
                             .slopes = {face.slopes[grid.axis(0)], face.slopes[grid.axis(1)]}}};
  while (!open.empty()) {
    Part part = open.back();
    open.pop_back();
    curve.choose_axis(part);
    curve.narrow(part);
    BoundaryPoint point{
        .place = part.from, .surface = face.surface, .deviation = curve.off_chord(part)};
    const bool is_last = part.depth == most_halvings_ || !curve.can_be_halved(part);
    // What is straight is so to far less than what is wanted.
    const double straight = std::min(deviation_, 0x1p-20 * distance_between(part.from, part.to));
    if (is_last || point.deviation <= std::max(straight, 8 * grid.rounding())) {
      points.push_back(point);
      continue;
    }
    const PlanePoint middle = curve.middle(part);
    if (has_series) {
      const double bulge = bulge_through(part.from, middle, part.to);
      if (std::abs(bulge) <= most_bulge_of_series) {
        const double off = curve.off_arc(part, bulge);
        if (off <= deviation_) {
          point.bulge = bulge;
          point.deviation = off;
          points.push_back(point);
          continue;
        }
      }
    } else if (point.deviation <= deviation_) {
      points.push_back(point);
      continue;
    }
    ++part.depth;
    Part second = part;
    part.to = second.from = middle;
    open.push_back(second);
    open.push_back(part);
  }
}

}  // namespace crt::core
