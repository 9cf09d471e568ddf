#include "core/geometry/plane_piece.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>

namespace crt::core {

namespace {

/// A Conic is a |p|^2 + g p + e, which is 0 on a circle or line.
struct Conic {
  double a = 0;
  Vec2 g{0, 0};
  double e = 0;

  double at(const Vec2& p) const { return a * dot(p, p) + dot(g, p) + e; }
};

/// Returns the at most two points where a line, the zeros of `line`, meets a circle or line.
std::vector<Vec2> points_of_line(const Conic& line, const Conic& other, double tolerance) {
  const double size = glm::length(line.g);
  // On one circle, or nearly, pieces meet at their ends.
  constexpr double rounding = 0x1p-40;
  if (!(size > rounding)) return {};
  const Vec2 normal = line.g / size;
  const Vec2 nearest = -(line.e / size) * normal;
  const Vec2 way = quarter_turned(normal);
  const double slope = dot(2 * other.a * nearest + other.g, way);
  const double value = other.at(nearest);
  const double discriminant = slope * slope - 4 * other.a * value;
  // Where circles touch, rounding may part them, or make two points of one.
  constexpr double touching = 0x1p-44;
  if (!(discriminant >= -touching)) return {};
  if (discriminant <= touching && discriminant <= 4 * std::abs(other.a) * tolerance) {
    return {nearest - slope / (2 * other.a) * way};
  }
  const double root = std::sqrt(std::max(discriminant, 0.0));
  const double sum = slope < 0 ? slope - root : slope + root;
  std::vector<Vec2> points;
  for (const double t : {-2 * value / sum, -sum / (2 * other.a)}) {
    if (std::isfinite(t)) points.push_back(nearest + t * way);
  }
  return points;
}

}  // namespace

PlanePiece::PlanePiece(const Vec2& from, const Vec2& to, double bulge)
    : from_(from),
      to_(to),
      bulge_(bulge),
      half_(0.5 * glm::length(to - from)),
      middle_of_chord_(from + 0.5 * (to - from)),
      lower_(min(from, to)),
      upper_(max(from, to)) {
  if (half_ > 0) {
    along_ = (0.5 / half_) * (to - from);
  } else {
    bulge_ = 0;  // it is next to nothing
  }
  across_ = quarter_turned(along_);
  if (bulge_ == 0) return;
  // The arc is in a box over its chord. That reaches beyond it if it is more than half a circle.
  const double rise = half_ * std::abs(bulge);
  const double radius = 0.5 * half_ * (std::abs(bulge) + 1 / std::abs(bulge));
  const double side = std::abs(bulge) > 1 ? radius : half_;
  for (const double end : {-side, side}) {
    const Vec2 base = middle_of_chord_ + end * along_;
    for (const Vec2& corner : {base, base - std::copysign(rise, bulge) * across_}) {
      lower_ = min(lower_, corner);
      upper_ = max(upper_, corner);
    }
  }
}

double PlanePiece::beside(const Vec2& point) const {
  // See biarcs.hpp for the formula.
  const Vec2 offset = point - middle_of_chord_;
  const double squares = bulge_ * (dot(offset, offset) - half_ * half_) / half_;
  return (squares - (1 - bulge_ * bulge_) * dot(across_, offset)) / (1 + bulge_ * bulge_);
}

Vec2 PlanePiece::normal_at(const Vec2& point) const {
  const Vec2 offset = point - middle_of_chord_;
  return glm::normalize((2 * bulge_ / half_) * offset - (1 - bulge_ * bulge_) * across_);
}

bool PlanePiece::has(const Vec2& point, double tolerance) const {
  if (glm::length(point - from_) <= tolerance || glm::length(point - to_) <= tolerance) return true;
  if (!(std::abs(beside(point)) <= tolerance)) return false;
  if (bulge_ == 0) return std::abs(dot(along_, point - middle_of_chord_)) <= half_;
  // On the circle the arc is what is beyond the chord.
  const double beyond = bulge_ > 0 ? -height(point) : height(point);
  if (std::abs(bulge_) > 1) return beyond >= 0;
  return beyond >= -tolerance && std::abs(dot(along_, point - middle_of_chord_)) <= half_;
}

Vec2 PlanePiece::middle() const {
  return middle_of_chord_ - half_ * bulge_ * across_;
}

double PlanePiece::order_of(const Vec2& point) const {
  const double before = glm::length(point - from_);
  const double after = glm::length(point - to_);
  return before / (before + after);
}

/// Returns the angle at which a point of the piece is seen from its begin, from where the piece
/// goes at first. It is half of what the arc turns by until there.
double PlanePiece::angle_to(const Vec2& point) const {
  const Vec2 offset = point - from_;
  const double to_chord = elementary::atan2(cross(along_, offset), dot(along_, offset));
  return to_chord + 2 * elementary::atan(bulge_);
}

double PlanePiece::bulge_between(const Vec2& first, const Vec2& second) const {
  if (bulge_ == 0) return 0;
  const double begin = first == from_ ? 0 : angle_to(first);
  const double end = second == to_ ? 2 * elementary::atan(bulge_) : angle_to(second);
  return elementary::tan(0.5 * (end - begin));
}

bool PlanePiece::is_left_of_chord(const Vec2& point) const {
  const Vec2 along = to_ - from_;
  const double left = cross(along, point - from_);
  if (left != 0) return left > 0;
  return along.y != 0 ? along.y < 0 : along.x > 0;
}

int PlanePiece::winding_of_segment(const Vec2& point) const {
  if (bulge_ == 0 || is_left_of_chord(point) == (bulge_ > 0)) return 0;
  const int sign = bulge_ > 0 ? 1 : -1;
  return sign * beside(point) < 0 ? sign : 0;
}

int PlanePiece::winding_of_chord(const Vec2& point) const {
  const bool rises = to_.y > point.y;
  if (rises == (from_.y > point.y) || is_left_of_chord(point) != rises) return 0;
  return rises ? 1 : -1;
}

std::vector<Vec2> common_points(const PlanePiece& a, const PlanePiece& b, double tolerance) {
  std::vector<Vec2> points;
  const auto add = [&](const Vec2& point) {
    const bool is_known = std::any_of(points.begin(), points.end(), [&](const Vec2& known) {
      return glm::length(known - point) <= tolerance;
    });
    if (!is_known) points.push_back(point);
  };
  for (const auto& [one, other] : {std::pair(&a, &b), std::pair(&b, &a)}) {
    for (const Vec2& end : {one->from_, one->to_}) {
      if (other->has(end, tolerance)) add(end);
    }
  }
  const Vec2 origin = a.from_;
  const auto conic_of = [&](const PlanePiece& piece) {
    const double squared_bulge = piece.bulge_ * piece.bulge_;
    const double curvature = piece.bulge_ / (piece.half_ * (1 + squared_bulge));
    const double share = (1 - squared_bulge) / (1 + squared_bulge);
    const Vec2 m = piece.middle_of_chord_ - origin;
    return Conic{
        .a = curvature,
        .g = -2 * curvature * m - share * piece.across_,
        .e = curvature * (dot(m, m) - piece.half_ * piece.half_) + share * dot(piece.across_, m)};
  };
  const Conic of_a = conic_of(a);
  const Conic of_b = conic_of(b);
  const bool b_is_straighter = std::abs(of_b.a) < std::abs(of_a.a);
  const Conic& straighter = b_is_straighter ? of_b : of_a;
  const Conic& rounder = b_is_straighter ? of_a : of_b;
  // Both vanish where two circles meet, and so does this, which is a line.
  const double share = rounder.a == 0 ? 0 : straighter.a / rounder.a;
  const Conic line{.g = straighter.g - share * rounder.g, .e = straighter.e - share * rounder.e};
  for (Vec2 point : points_of_line(line, rounder, tolerance)) {
    point += origin;
    constexpr int refinements = 2;
    for (int i = 0; i < refinements; ++i) {
      const Vec2 across_a = a.normal_at(point);
      const Vec2 across_b = b.normal_at(point);
      const double sine = cross(across_a, across_b);
      constexpr double nearly_parallel = 0x1p-20;
      if (!(std::abs(sine) > nearly_parallel)) break;
      const double of_point_a = a.beside(point);
      const double of_point_b = b.beside(point);
      point -= quarter_turned(of_point_b * across_a - of_point_a * across_b) / sine;
    }
    if (a.has(point, tolerance) && b.has(point, tolerance)) add(point);
  }
  return points;
}

}  // namespace crt::core
