// Tests make fields at random, and evaluate them in another way than the library does.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "core/geometry/implicit/field_node.hpp"
#include "core/geometry/implicit/profile_distance.hpp"
#include "geometry/oracle.hpp"

namespace crt::test {

/// Evaluates a node in doubles. Where it has no value, that is NaN.
inline double plain_value(const core::FieldNode& node, const Vec3& p) {
  using enum core::FieldOperation;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const double a = node.a ? plain_value(*node.a, p) : 0;
  const double b = node.b ? plain_value(*node.b, p) : 0;
  if (std::isnan(a) || std::isnan(b)) return none;
  switch (node.operation) {
    case constant:
      return node.number;
    case x:
      return p.x;
    case y:
      return p.y;
    case z:
      return p.z;
    case negate:
      return -a;
    case add:
      return a + b;
    case subtract:
      return a - b;
    case multiply:
      return a * b;
    case divide:
      return b == 0 ? none : a / b;
    case square:
      return a * a;
    case whole_power:
    case power:
      return std::pow(a, node.number);
    case square_root:
      return std::sqrt(a);
    case absolute:
      return std::abs(a);
    case minimum:
      return std::min(a, b);
    case maximum:
      return std::max(a, b);
    case sine:
      return std::sin(a);
    case cosine:
      return std::cos(a);
    case tangent:
      return std::tan(a);
    case arc_sine:
      return std::asin(a);
    case arc_cosine:
      return std::acos(a);
    case arc_tangent:
      return std::atan(a);
    case arc_tangent_of_two:
      return a == 0 && b == 0 ? none : std::atan2(a, b);
    case exponential:
      return std::exp(a);
    case logarithm:
      return a > 0 ? std::log(a) : none;
    case floor:
      return std::floor(a);
    case ceiling:
      return std::ceil(a);
    case round:
      return std::round(a);
    case profile_distance: {
      const std::array<core::Interval, 2> at = {core::Interval::of(a), core::Interval::of(b)};
      return node.profile->evaluate(at, at).middle.middle();
    }
  }
  return none;
}

/// Returns a field of a few random operations. It may have poles, steps and places without a value
/// if `may_be_wild`.
inline Field random_field_of(Random& random, int depth, bool may_be_wild) {
  if (depth == 0 || random.one_in(8)) {
    const std::array<Field, 3> coordinates = {Field::x(), Field::y(), Field::z()};
    if (random.one_in(3)) return random.uniform(-2, 2);
    return coordinates[random.bits() % 3];
  }
  const auto part = [&] { return random_field_of(random, depth - 1, may_be_wild); };
  const Field a = part();
  switch (random.bits() % (may_be_wild ? 22 : 11)) {
    case 0:
    case 1:
      return a + part();
    case 2:
      return a - part();
    case 3:
    case 4:
      return a * part();
    case 5:
      return sin(2 * a);
    case 6:
      return cos(a);
    case 7:
      return pow(a, static_cast<double>(2 + random.bits() % 4));
    case 8:
      return atan(a);
    case 9:
      return max(a, part());
    case 10:
      return abs(a);
    case 11:
      return a / part();
    case 12:
      return sqrt(a);
    case 13:
      return log(a);
    case 14:
      return exp(a);
    case 15:
      return tan(a);
    case 16:
      return asin(a);
    case 17:
      return atan2(a, part());
    case 18:
      return random.one_in(2) ? floor(a) : round(3 * a);
    case 19:
      return pow(a, random.uniform(0.1, 3));
    case 20:
      return pow(a, part());
    default:
      return sin(1000 * a);
  }
}

}  // namespace crt::test
