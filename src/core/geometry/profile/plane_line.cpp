#include "core/geometry/profile/plane_line.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// Returns the side of a point that is on a line, when the line is moved to its right or left.
constexpr ShiftMask on_line = 1;

/// These are far more roundings than any of the filters in doubles has.
constexpr double filter_rounding = 0x1p6 * unit_roundoff;
/// Below this size a product could underflow.
constexpr double least_size = 0x1p-450;

}  // namespace

PlaneLine::PlaneLine(const ObjectRay& near, const ExactRay* ray, double origin_error,
                     double direction_error)
    : near_(near), ray_(ray) {
  const double speed = size_in_plane(near.direction);
  const double error = direction_error + size_in_plane(near.direction_low);
  origin_error_ = origin_error + size_in_plane(near.origin_low);
  if (speed == 0 && error == 0) {
    is_point_ = true;
  } else if (!(speed > error)) {
    const DyadicVector& direction = exact().direction;
    is_point_ = direction[0].sign() == 0 && direction[1].sign() == 0;
  }
  scale_ = inverse_of_power(power_of_two_below(speed));
  constexpr double least = 0x1p-1070;  // what scaling may lose of a component
  direction_ = scale_ * Vec3(near.direction.x, near.direction.y, 0);
  direction_error_ = scale_ * error + least;
}

const ExactLine& PlaneLine::exact() {
  if (!exact_) exact_ = ray_ != nullptr ? ray_->exact() : exact_line(near_);
  return *exact_;
}

int PlaneLine::exact_side(const Vec3& corner) {
  const ExactLine& line = exact();
  return cross_in_plane(line.direction, line.weight * exactly(corner) - line.origin).sign();
}

CornerSide PlaneLine::side_of(const Vec3& corner) {
  const Vec3 offset = corner - near_.origin;
  CornerSide side{.value = cross_in_plane(direction_, offset)};
  const double size = size_in_plane(offset);
  side.error = size * (filter_rounding + 2 * direction_error_) + 4 * origin_error_;
  if (size > least_size && std::abs(side.value) > side.error) {
    side.left = side.value > 0 ? both_shifts : 0U;
  } else {
    side.left = mask_of_sign(exact_side(corner), on_line);
  }
  return side;
}

PlaneLine::ChordOfLine PlaneLine::rough_chord(const Profile::Arc& arc) const {
  const Vec3 offset = arc.center - near_.origin;
  const double speed = std::sqrt(direction_.x * direction_.x + direction_.y * direction_.y);
  const double distance = std::abs(cross_in_plane(direction_, offset)) / speed;
  const double along = (direction_.x * offset.x + direction_.y * offset.y) / speed;
  const double size = size_in_plane(offset) + arc.radius;
  constexpr double rounding = 0x1p-44;
  const double error = size * (rounding + 8 * direction_error_) + 8 * origin_error_;
  const double inner = std::max(arc.radius - distance, 0.0);
  return {.middle = along / speed,
          .half = std::sqrt(inner * (arc.radius + distance)) / speed,
          .error = (error + 2 * std::sqrt(error) * std::sqrt(error + arc.radius)) / speed};
}

ExactQuadratic PlaneLine::equation(const Profile::Arc& arc) {
  const ExactLine& line = exact();
  const DyadicVector offset = line.origin - line.weight * exactly(arc.center);
  const auto product = [](const DyadicVector& a, const DyadicVector& b) {
    return a[0] * b[0] + a[1] * b[1];
  };
  return {product(line.direction, line.direction), product(line.direction, offset),
          product(offset, offset) - square(line.weight * Dyadic(arc.radius))};
}

ArcCut PlaneLine::cut(const Profile::Arc& arc, const Profile::Piece& chord, const CornerSide& from,
                      const CornerSide& to) {
  const ShiftMask across = from.left ^ to.left;
  const Vec3 offset = arc.center - near_.origin;
  const double speed = std::sqrt(direction_.x * direction_.x + direction_.y * direction_.y);
  const double distance = cross_in_plane(direction_, offset);
  const double reach = speed * arc.radius;
  const double error =
      (size_in_plane(offset) + arc.radius) * (filter_rounding + 4 * direction_error_) +
      8 * origin_error_;
  if (!(arc.radius > least_size)) return exact_cut(arc, chord, from, to);
  if (std::abs(distance) > reach + error) return {.chord = across};
  // The line passes the corners so far away that it meets the chord's line plainly within the
  // circle, or plainly not.
  const double nearer = std::min(std::abs(from.value), std::abs(to.value));
  const double farther = std::max(std::abs(from.value), std::abs(to.value));
  const bool is_clear = nearer > 2 * arc.margin * farther + std::max(from.error, to.error);
  if (!is_clear) return exact_cut(arc, chord, from, to);
  if (across != 0) {
    if (goes_right(from, to) == arc.is_right) return {.leave = both_shifts};
    return {.enter = both_shifts};
  }
  if (!(std::abs(distance) < reach - error)) return exact_cut(arc, chord, from, to);
  // All that is within the circle is on one side of the chord, as is its middle.
  const Vec3 to_middle =
      arc.center - chord.from + distance / (speed * speed) * Vec3(direction_.y, -direction_.x, 0);
  const Vec3 along = chord.to - chord.from;
  const double left = cross_in_plane(along, to_middle);
  const double left_error =
      size_in_plane(along) *
      (4 * error +
       filter_rounding * (size_in_plane(to_middle) + size_in_plane(arc.center - chord.from)));
  if (!(std::abs(left) > left_error)) return exact_cut(arc, chord, from, to);
  if ((left < 0) != arc.is_right) return {};
  return {.enter = both_shifts, .leave = both_shifts};
}

ArcCut PlaneLine::exact_cut(const Profile::Arc& arc, const Profile::Piece& chord,
                            const CornerSide& from, const CornerSide& to) {
  const ShiftMask across = from.left ^ to.left;
  const ExactQuadratic circle = equation(arc);
  if (circle.discriminant().sign() <= 0) return {.chord = across};
  const ExactLine& line = exact();
  const DyadicVector along = exactly(chord.to) - exactly(chord.from);
  // Where the line meets that of the chord t is numerator / rate.
  Dyadic numerator = cross_in_plane(along, line.origin - line.weight * exactly(chord.from));
  Dyadic rate = cross_in_plane(line.direction, along);
  if (rate.sign() == 0) {
    const bool is_same_way =
        (line.direction[0] * along[0] + line.direction[1] * along[1]).sign() > 0;
    const ShiftMask left =
        mask_of_sign(numerator.sign(), is_same_way ? complement(on_line) : on_line);
    const ShiftMask within = arc.is_right ? complement(left) : left;
    return {.enter = within, .leave = within};
  }
  const bool goes_to_arc = (rate.sign() > 0) == arc.is_right;
  if (rate.sign() < 0) {
    numerator = -numerator;
    rate = -rate;
  }
  const Dyadic from_middle = circle.a * numerator + circle.b * rate;
  const Dyadic value = numerator * (from_middle + circle.b * rate) + circle.c * square(rate);
  const ShiftMask inside = mask_of_sign(-value.sign(), across);
  const ShiftMask before = from_middle.sign() < 0 ? complement(inside) : 0U;
  const ShiftMask after = from_middle.sign() > 0 ? complement(inside) : 0U;
  ArcCut cut{.chord = (inside ^ across)};
  cut.enter = goes_to_arc ? before : (after | inside);
  cut.leave = goes_to_arc ? (before | inside) : after;
  return cut;
}

}  // namespace crt::core
