// Both tiers find the crossings of a ray with an implicit solid here.
#include <limits>

#include "core/geometry/implicit/field_search.hpp"
#include "core/geometry/implicit/implicit.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

/// A FieldSpan is the part of a ray within the box, as a line of its own: t = shift + x / scale.
class FieldSpan {
 public:
  FieldSpan(const FieldRay& field_ray, const Crossing& enter, const Crossing& leave);

  double to_x(double t) const { return (t - shift_) * scale_; }
  /// Returns t to about 100 bits.
  DoubleDouble to_t(double x) const { return two_sum(shift_, x * inverse_scale_); }
  double to_t_length(double x) const { return x * inverse_scale_; }

  std::array<Interval, 3> place{};
  std::array<Interval, 3> direction{};
  double from;  ///< where the line enters the box
  double to;
  bool begins_within;  ///< where it enters need not be known

  FieldSearchLimits limits(const FieldProgram& program, const FieldRay& field_ray,
                           const Crossing& enter) const;

 private:
  double scale_;
  double inverse_scale_;
  double shift_;
};

FieldSpan::FieldSpan(const FieldRay& field_ray, const Crossing& enter, const Crossing& leave) {
  const ObjectRay& ray = field_ray.ray;
  const bool on_field = ray.start.face == 0;
  scale_ = power_of_two_below(largest_component(ray.direction));
  inverse_scale_ = inverse_of_power(scale_);
  begins_within = ray.begin > enter.t || (on_field && ray.begin >= 0);
  shift_ = on_field ? 0 : enter.t + 0.5 * (leave.t - enter.t);
  from = to_x(enter.t);
  to = std::max(from, to_x(leave.t));
  const Vec3 point = ray.from_center(Vec3(0), shift_);
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    // These are the roundings of from_center(). Its last sums have far smaller ones.
    const double low_parts =
        0x1p-103 * (std::abs(ray.origin[axis]) + std::abs(shift_ * ray.direction[axis]));
    const double off = 2 * unit_roundoff * std::abs(point[axis]) + low_parts +
                       field_ray.origin_error + std::abs(shift_) * field_ray.direction_error;
    place[i] = Interval::of(point[axis]) + Interval{-off, off};
    const double error = inverse_scale_ * field_ray.direction_error;
    direction[i] = Interval::of(inverse_scale_ * ray.direction[axis]);
    if (error != 0 || ray.direction_low[axis] != 0) {
      direction[i] = direction[i] + Interval::of(inverse_scale_ * ray.direction_low[axis]) +
                     Interval{-error, error};
    }
  }
}

FieldSearchLimits FieldSpan::limits(const FieldProgram& program, const FieldRay& field_ray,
                                    const Crossing& enter) const {
  const ObjectRay& ray = field_ray.ray;
  const double reach = std::max(-from, to);
  double size = reach;
  for (const Interval& component : place) size = std::max(size, component.magnitude());
  constexpr std::size_t max_evaluations = 1024;
  constexpr std::size_t most_steps = std::size_t{1} << 20;
  constexpr std::uint32_t more_of_exact = 8;
  const std::size_t evaluations = std::min(max_evaluations, most_steps / program.steps().size());
  // This is more than the rounding of both ends of a root's interval as t.
  constexpr double margin = 0x1p-48;
  const double same_place = margin * (std::abs(shift_) * scale_ + reach);
  return {.max_evaluations =
              static_cast<std::uint32_t>(evaluations) * (field_ray.is_exact ? more_of_exact : 1),
          .shortest = 0x1p-52 * size,
          .first = to_x(ray.begin),
          .enough_after = to_x(ray.first_wanted_after) + same_place,
          .is_enough_inside = !begins_within && ray.is_first_wanted(enter),
          .same_place = same_place};
}

/// Appends crossings, each where the one before or after it lets it be.
class FieldCrossings {
 public:
  explicit FieldCrossings(CrossingList& out) : out_(out), before_(out.size()) {}

  void add(const Crossing& crossing) {
    // A span without a length is none.
    if (!crossing.entering && out_.size() > before_ && !(out_.back().t < crossing.t)) {
      out_.pop_back();
    } else {
      out_.push_back(crossing);
    }
  }

 private:
  CrossingList& out_;
  std::size_t before_;
};

void find_roots(const FieldRay& field_ray, const Crossing& enter, const Crossing& leave,
                const FieldSpan& span, FieldSearch& search) {
  const FaceStart& start = field_ray.ray.start;
  if (start.face == 0) {
    if (span.begins_within) {
      search.know(0, start.side == Side::outside);
    } else {
      search.search_to_root(span.from);
    }
    search.search_from_root(span.to, start.side);
  } else {
    // A ray that starts on the box starts where the field is inside.
    const bool on_box = start.face != invalid_index && start.on_face;
    const auto is_start = [&](const Crossing& end) {
      return on_box && end.t == 0 && end.face + first_box_face == start.face;
    };
    if (is_start(enter)) search.know(span.from, true);
    if (!search.has_enough()) search.search(span.from, span.to);
    if (is_start(leave) && !search.has_enough()) search.know(span.to, true);
  }
  search.finish(span.from, span.to);
}

}  // namespace

ObjectRay as_box_sees(const ObjectRay& ray) {
  ObjectRay result = ray;
  result.begin = -infinity;
  result.first_wanted_after = infinity;
  if (ray.start.face == 0) {
    result.start = {};
  } else if (ray.start.face != invalid_index) {
    result.start.face -= first_box_face;
  }
  return result;
}

bool replace_by_field_crossings(const FieldProgram& program, const FieldRay& field_ray,
                                std::size_t first, CrossingList& out) {
  const ObjectRay& ray = field_ray.ray;
  const bool on_field = ray.start.face == 0;
  const bool meets_box = out.size() > first;
  if (!meets_box && !on_field) return false;
  Crossing enter = meets_box ? out[first] : Crossing{};
  Crossing leave = meets_box ? out.back() : Crossing{};
  out.resize(first);
  if (on_field) {
    // The start is within the box, whatever rounding says.
    enter.t = std::min(enter.t, 0.0);
    leave.t = std::max(leave.t, 0.0);
  }
  if (leave.t < ray.begin) return false;

  FieldSpan span(field_ray, enter, leave);
  const FieldSearchLimits limits = span.limits(program, field_ray, enter);
  if (on_field && span.to < limits.shortest) {
    span.to = limits.shortest;
    leave.t = span.to_t(span.to).hi;
  }
  const FieldLine line(program, span.place, span.direction);
  FieldSearch search(line, limits);
  find_roots(field_ray, enter, leave, span, search);

  FieldCrossings crossings(out);
  const auto at_end = [&](Crossing end, double gap, bool entering) {
    end.error += span.to_t_length(gap);
    end.face += first_box_face;
    end.entering = entering;
    return end;
  };
  if (search.is_inside_first() && !span.begins_within) {
    crossings.add(at_end(enter, search.first_gap(), true));
  }
  for (std::size_t i = 0; i < search.count(); ++i) {
    const FieldRoot& root = search.root(i);
    const DoubleDouble t = span.to_t(root.x);
    Crossing crossing{.t = std::clamp(t.hi, enter.t, leave.t),
                      .error = span.to_t_length(root.error),
                      .face = 0,
                      .root = static_cast<std::uint8_t>(i),
                      .entering = root.is_entering};
    if (field_ray.is_exact) {
      if (crossing.t == t.hi) crossing.t_low = t.lo;
    } else {
      constexpr double last_rounding = 1 + 0x1p-40;
      crossing.error += rounding_of(crossing.t) * last_rounding;
    }
    crossings.add(crossing);
  }
  if (search.is_inside_last() && !search.has_enough()) {
    crossings.add(at_end(leave, search.last_gap(), false));
  }
  if (search.is_undecided()) ++out.undecided;
  return span.begins_within && search.is_inside_first();
}

}  // namespace crt::core
