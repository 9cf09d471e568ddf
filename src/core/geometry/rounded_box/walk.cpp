#include "core/geometry/rounded_box/walk.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/rounded_box/rounded_box.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

/// Steps end here at the latest, far beyond what is near the box.
constexpr double farthest_step = 0x1p60;

double squared(const Vec3& v) {
  return glm::dot(v, v);
}

/// Returns a direction without its components along the axes whose side is 0.
Vec3 across(const Sides& sides, const Vec3& direction) {
  return {sides[0] == 0 ? 0 : direction.x, sides[1] == 0 ? 0 : direction.y,
          sides[2] == 0 ? 0 : direction.z};
}

int count_beside(const Sides& sides) {
  return std::abs(sides[0]) + std::abs(sides[1]) + std::abs(sides[2]);
}

/// Returns whether a point is inside, if these are its sides.
bool is_inside(const RoundedBoxLayout& box, const Sides& sides, const Vec3& p) {
  // With the depth e below the plane of a flat face, r^2 - |q|^2 is e (2 r - e) less the squares of
  // the other components of q. So it has the sign of e on a flat face and along its seams, whatever
  // rounding has made of the inner box. The plane is that of the least depth.
  double depth = infinity;
  double others = 0;
  double nearest = 0;  // (the component along the axis of that depth)
  for (int axis = 0; axis < 3; ++axis) {
    const int side = sides[static_cast<std::size_t>(axis)];
    if (side == 0) continue;
    const double q = box.beyond(sides, axis, p[axis]);
    const double e = side < 0 ? p[axis] - box.lower[axis] : box.upper[axis] - p[axis];
    others += (e < depth ? nearest * nearest : q * q);
    if (e < depth) {
      depth = e;
      nearest = q;
    }
  }
  // What rounding takes for the inner box itself is inside, also if it has lost the radius.
  if (nearest == 0 && others == 0) return true;
  return depth > 0 && (others == 0 || others < depth * (2 * box.radius - depth));
}

/// Returns whether the distance from the inner box does not fall, as a line goes on from a point.
bool grows(const RoundedBoxLayout& box, const Sides& sides, const Vec3& p, const Vec3& direction) {
  return glm::dot(box.beyond(sides, p), across(sides, direction)) >= 0;
}

/// WalkSteps has the steps of a line in their order.
class WalkSteps {
 public:
  WalkSteps(const RoundedBoxLayout& box, const NearLine& line) {
    for (int axis = 0; axis < 3; ++axis) {
      int& side = first_[static_cast<std::size_t>(axis)];
      const double p = line.point[axis];
      const double d = line.direction[axis];
      const double lower = box.inner_lower[axis];
      const double upper = box.inner_upper[axis];
      if (d == 0) {
        side = p < lower ? -1 : (p > upper ? 1 : 0);
        continue;
      }
      side = d > 0 ? -1 : 1;
      add({(d > 0 ? lower : upper) - p, d, axis, 0});
      add({(d > 0 ? upper : lower) - p, d, axis, -side});
    }
  }

  /// Calls visit(step, is_last) for each step that is longer than 0, until that returns true.
  template <class Visit>
  void visit(double begin, const Visit& visit) const {
    WalkStep step{.sides = first_, .from = begin};
    for (std::size_t i = 0; i < count_; ++i) {
      step.to = ends_[i].x;
      if (step.to > step.from) {
        if (visit(step, false)) return;
        step.from = step.to;
      }
      step.sides[static_cast<std::size_t>(ends_[i].axis)] = ends_[i].after;
    }
    step.to = farthest_step;
    visit(step, true);
  }

 private:
  struct End {
    double x = 0;
    int axis = 0;
    int after = 0;  ///< the side after it

    End() = default;
    End(double distance, double speed, int along, int side)
        : x(std::clamp(distance / speed, -farthest_step, farthest_step)),
          axis(along),
          after(side) {}
  };

  void add(const End& end) {
    std::size_t place = count_++;
    for (; place > 0 && end.x < ends_[place - 1].x; --place) ends_[place] = ends_[place - 1];
    ends_[place] = end;
  }

  Sides first_{};
  std::array<End, 6> ends_{};
  std::size_t count_ = 0;
};

/// Returns whether a line that is outside at both ends of a step is inside between.
bool dips(const RoundedBoxLayout& box, const NearLine& line, const WalkStep& step) {
  if (count_beside(step.sides) < 2) return false;
  const Vec3 d = across(step.sides, line.direction);
  const double x = -glm::dot(box.beyond(step.sides, line.point), d) / squared(d);
  return x > step.from && x < step.to && is_inside(box, step.sides, line.at(x));
}

}  // namespace

std::uint32_t face_at(const Sides& sides) {
  const auto is_upper = [&](std::size_t axis) { return sides[axis] > 0 ? 1u : 0u; };
  const int count = count_beside(sides);
  if (count == 3) return 18 + is_upper(0) + 2 * is_upper(1) + 4 * is_upper(2);
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    if (count == 1 && sides[axis] != 0) return 2 * axis + is_upper(axis);
    if (count == 2 && sides[axis] == 0) {
      const std::uint32_t first = axis == 0 ? 1 : 0;
      const std::uint32_t second = axis == 2 ? 1 : 2;
      return 6 + 4 * axis + is_upper(first) + 2 * is_upper(second);
    }
  }
  return invalid_index;
}

Sides sides_of(std::uint32_t face) {
  const auto side = [](std::uint32_t is_upper) { return is_upper % 2 == 1 ? 1 : -1; };
  if (face >= 18) return {side(face - 18), side((face - 18) / 2), side((face - 18) / 4)};
  Sides sides{};
  if (face < flat_faces_of_box) {
    sides[face / 2] = side(face);
    return sides;
  }
  const std::uint32_t axis = (face - 6) / 4;
  sides[axis == 0 ? 1 : 0] = side(face - 6);
  sides[axis == 2 ? 1 : 2] = side((face - 6) / 2);
  return sides;
}

RoundedBoxLayout::RoundedBoxLayout(const RoundedBox& box) {
  const Vec3 low = glm::min(box.corner_a, box.corner_b);
  const Vec3 high = glm::max(box.corner_a, box.corner_b);
  center = 0.5 * low + 0.5 * high;
  unit = power_of_two_below(0.5 * largest_component(high - low));
  lower = (low - center) / unit;
  upper = (high - center) / unit;
  radius = radius_of(box) / unit;
  inner_upper = upper - Vec3(radius);
  inner_lower = glm::min(lower + Vec3(radius), inner_upper);
  size = glm::length(glm::max(-inner_lower, inner_upper)) + radius;
}

RoundedBoxLayout RoundedBoxLayout::grown(double by) const {
  RoundedBoxLayout result = *this;
  result.lower -= by;
  result.upper += by;
  result.radius += by;
  result.size += by;
  return result;
}

Walk walk_through(const RoundedBoxLayout& box, const NearLine& line) {
  Walk walk;
  // Most lines that miss it pass the ball that holds it.
  constexpr double slack = 1 + 0x1p-20;
  if (squared(line.point) > slack * box.size * box.size + squared(line.closest() * line.direction))
    return walk;
  bool inside = false;
  WalkSteps(box, line).visit(-farthest_step, [&](const WalkStep& step, bool is_last) {
    const Vec3 end = line.at(step.to);
    const bool is_inside_after = !is_last && is_inside(box, step.sides, end);
    if (is_inside_after) {
      if (!inside) walk.enter = step;
      inside = true;
      return false;
    }
    const bool leaves = count_beside(step.sides) > 0 && grows(box, step.sides, end, line.direction);
    if (inside && leaves) {
      walk.leave = step;
      walk.found = true;
      return true;
    }
    // If the line comes nearer yet, rounding had it inside too early.
    inside = false;
    if (dips(box, line, step)) {
      walk = {.found = true, .enter = step, .leave = step};
      return true;
    }
    // From where the distance grows it does so for good.
    return leaves;
  });
  return walk;
}

WayOut way_out(const RoundedBoxLayout& box, const NearLine& line) {
  WayOut way;
  double squared_radius = 0;
  bool has_begun = false;
  WalkSteps(box, line).visit(-farthest_step, [&](const WalkStep& step, bool is_last) {
    if (!(step.to > 0)) return false;
    way.leave = step;
    way.leave.from = std::max(step.from, 0.0);
    way.is_first = !has_begun;
    has_begun = true;
    const Vec3 d = across(step.sides, line.direction);
    if (way.is_first) {
      const Vec3 q = box.beyond(step.sides, line.point);
      squared_radius = squared(q);
      if (squared_radius > 0) {
        // The square of the distance changes by x (x d^2 + 2 q d).
        const double half_rate = glm::dot(q, d);
        return half_rate > 0 || step.to * squared(d) + 2 * half_rate > 0;
      }
      squared_radius = box.radius * box.radius;
    }
    // Within rounding of it the line has not left, as it may yet go along the surface.
    constexpr double slack = 1 + 0x1p-48;
    return is_last || squared(box.beyond(step.sides, line.at(step.to))) > slack * squared_radius;
  });
  return way;
}

namespace {

/// A RoundEquation is a x^2 + 2 b x + c = 0, and where in a step it is solved for.
struct RoundEquation {
  double a = 0;
  double b = 0;
  double c = 0;
  double half = 0;  ///< the root of the discriminant
  double from = 0;  ///< the step's ends, in the line's x
  double to = 0;

  double within(double x) const { return x >= from ? std::min(x, to) : from; }
  double root(bool entering) const {
    if (!(half > 0)) return -b / a;
    if (entering) return b >= 0 ? -(b + half) / a : c / (half - b);
    return b < 0 ? (half - b) / a : -c / (b + half);
  }
};

/// Moves a line to where it is nearest to an edge or a corner, as far as the step goes, and returns
/// the equation there. All its numbers are about as large as the radius.
RoundEquation equation_of(const RoundedBoxLayout& box, const ObjectRay& ray, const WalkStep& step,
                          NearLine& line) {
  const Vec3 d = across(step.sides, line.direction);
  const double most = 2 * box.size / std::sqrt(line.squared_length);
  const double closest = line.closest();
  RoundEquation equation{.a = squared(d),
                         .from = std::max(step.from, std::min(closest, 0.0) - most),
                         .to = std::min(step.to, std::max(closest, 0.0) + most)};
  const double middle =
      equation.within(-glm::dot(box.beyond(step.sides, line.point), d) / equation.a);
  line.move_to(ray, box.center, line.to_precise_t(middle));
  equation.from -= middle;
  equation.to -= middle;
  const Vec3 q = box.beyond(step.sides, line.point);
  const double distance = glm::length(q);
  equation.b = glm::dot(q, d);
  equation.c = (distance + box.radius) * (distance - box.radius);
  const double discriminant =
      difference_of_products(equation.b, equation.b, equation.a, equation.c);
  equation.half = std::sqrt(std::max(discriminant, 0.0));
  return equation;
}

/// Returns the error of a root if the line grazes there, next to a seam. It may truly cross the
/// face beyond, which is less curved, by the rate at which the distance changes at the seam.
double error_beyond_seam(const RoundedBoxLayout& box, const NearLine& line,
                         const RoundEquation& equation, double x, double t, bool entering) {
  const auto& [a, b, c, half, from, to] = equation;
  const double grazing = std::sqrt(2 * standard_error_across(2 * box.size) * a / box.radius);
  if (!(half < grazing * box.radius)) return 0;
  const double seam = entering ? to : from;
  const double rate = (a * seam + b) / box.radius * (entering ? -1 : 1);
  if (!(rate > -grazing)) return 0;
  const double least_rate = std::max(rate - 0.125 * grazing, 0.0);
  return line.to_t_length(std::abs(seam - x)) +
         error_next_to(box, line, line.at(seam), t, least_rate, 0);
}

}  // namespace

Crossing round_crossing(const RoundedBoxLayout& box, const ObjectRay& ray, const NearLine& line,
                        const WalkStep& step, bool entering) {
  NearLine near = line;
  const RoundEquation equation = equation_of(box, ray, step, near);
  const double x = equation.within(equation.root(entering));
  const double t = near.to_t(x);
  const double error =
      error_next_to(box, near, near.at(x), t, equation.half / box.radius, std::sqrt(equation.a));
  return {.t = t,
          .error = std::max(error, error_beyond_seam(box, near, equation, x, t, entering)),
          .face = face_at(step.sides),
          .root = static_cast<std::uint8_t>(entering ? 0 : 1),
          .entering = entering};
}

double error_next_to(const RoundedBoxLayout& box, const NearLine& line, const Vec3& point, double t,
                     double approach, double turning) {
  const double reach = box.size + glm::length(point);
  const double curved = box.radius + standard_error_across(reach);
  const double speed = std::sqrt(line.squared_length);
  const double graze = speed / turning * grazing_error(line, reach, curved);
  return standard_error(line, t, reach, approach, std::min(reach / speed, graze));
}

}  // namespace crt::core
