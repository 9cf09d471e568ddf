#include "core/section/contour_joints.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/section/circle_fit.hpp"
#include "crt/elementary.hpp"

namespace crt::core {

namespace {

/// Pieces are short as a share of those beside them up to this.
constexpr double short_share = 0.05;

/// Returns how far a point is from the line through the ends of a piece.
double distance_from_chord(const ContourPiece& piece, const PlanePoint& point) {
  const double x = piece.to.x - piece.from.x;
  const double y = piece.to.y - piece.from.y;
  const double turn = x * (point.y - piece.from.y) - y * (point.x - piece.from.x);
  return std::abs(turn) / distance_between(piece.from, piece.to);
}

/// Returns how far a point is from the whole line or circle of a piece.
double distance_from_whole(const ContourPiece& piece, const PlanePoint& point) {
  return piece.is_arc() ? std::abs(distance_between(point, piece.center()) - piece.radius())
                        : distance_from_chord(piece, point);
}

/// Returns where the whole lines or circles of two pieces may touch.
std::vector<PlanePoint> touching_points(const ContourPiece& a, const ContourPiece& b) {
  if (!a.is_arc() && !b.is_arc()) return {};
  if (a.is_arc() && b.is_arc()) {
    const PlanePoint center = a.center();
    const PlanePoint other = b.center();
    const double share = a.radius() / distance_between(center, other);
    const double x = share * (other.x - center.x);
    const double y = share * (other.y - center.y);
    return {{center.x + x, center.y + y}, {center.x - x, center.y - y}};
  }
  const ContourPiece& line = a.is_arc() ? b : a;
  const PlanePoint center = (a.is_arc() ? a : b).center();
  const double x = line.to.x - line.from.x;
  const double y = line.to.y - line.from.y;
  const double share =
      ((center.x - line.from.x) * x + (center.y - line.from.y) * y) / (x * x + y * y);
  return {{line.from.x + share * x, line.from.y + share * y}};
}

/// Returns the bulge of a small part of a piece's whole line or circle, over a chord.
double small_bulge(const ContourPiece& piece, double chord) {
  if (!piece.is_arc()) return 0;
  const double radius = piece.radius();
  const double half = std::min(0.5 * chord, radius);
  return half / (radius + std::sqrt(radius * radius - half * half));
}

/// Moves the ends of a piece, which stays on its line or circle.
void move_ends(ContourPiece& piece, const PlanePoint& from, const PlanePoint& to) {
  if (piece.is_arc()) {
    const PlanePoint center = piece.center();
    const auto turn = [&](const PlanePoint& a, const PlanePoint& b) {
      const double ax = a.x - center.x;
      const double ay = a.y - center.y;
      const double bx = b.x - center.x;
      const double by = b.y - center.y;
      return elementary::atan2(ax * by - ay * bx, ax * bx + ay * by);
    };
    // The ends move by little, so what the angle grows by is not half a turn.
    const double angle = piece.angle() + turn(from, piece.from) + turn(piece.to, to);
    piece.bulge = elementary::sin(0.25 * angle) / elementary::cos(0.25 * angle);
  }
  piece.from = from;
  piece.to = to;
}

/// Returns where two pieces touch, near to two points.
std::optional<PlanePoint> touching_point(const ContourPiece& a, const ContourPiece& b,
                                         const ContourPiece& near, double reach, double exact) {
  for (const PlanePoint& p : touching_points(a, b)) {
    if (distance_from_whole(a, p) <= exact && distance_from_whole(b, p) <= exact &&
        distance_between(p, near.from) <= reach && distance_between(p, near.to) <= reach)
      return p;
  }
  return {};
}

}  // namespace

std::optional<TangentJoint> joint_between(const ContourPiece& before, const ContourPiece& gap,
                                          const ContourPiece& after, double exact) {
  const double chord = gap.chord();
  if (!(chord > 0) || chord > short_share * std::min(before.chord(), after.chord())) return {};
  const std::optional<PlanePoint> place = touching_point(before, after, gap, chord, exact);
  if (!place) return {};
  const double first = distance_between(gap.from, *place);
  const double last = distance_between(*place, gap.to);
  TangentJoint joint{.place = *place,
                     .first_bulge = std::copysign(small_bulge(before, first), before.bulge),
                     .last_bulge = std::copysign(small_bulge(after, last), after.bulge)};
  joint.off = distance_from_chord(gap, *place) + chord * std::abs(gap.bulge) +
              first * std::abs(joint.first_bulge) + last * std::abs(joint.last_bulge) + 2 * exact;
  return joint;
}

double tidy_joints(std::vector<FittedPiece>& pieces, double exact, double tolerance) {
  double moved = 0;
  if (pieces.size() < 2) return moved;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    FittedPiece& last = pieces[(i + pieces.size() - 1) % pieces.size()];
    FittedPiece& next = pieces[i];
    if (!last.is_sure || !next.is_sure || next.begins_at_corner) continue;
    const PlanePoint& end = next.piece.from;
    const double reach = short_share * std::min(last.piece.chord(), next.piece.chord());
    const auto place = touching_point(last.piece, next.piece, {end, end, 0}, reach, 4 * exact);
    if (!place) continue;
    // Between the end and the joint, the one piece stands for the other. The chord of either is
    // within its sagitta, and so within that of the other.
    const double length = distance_between(end, *place);
    const double off =
        length * (small_bulge(last.piece, length) + small_bulge(next.piece, length)) + 8 * exact;
    if (!(off <= tolerance)) continue;
    moved = std::max(moved, off);
    move_ends(last.piece, last.piece.from, *place);
    move_ends(next.piece, *place, next.piece.to);
  }
  return moved;
}

}  // namespace crt::core
