// The function of a quadric's face, for questions about boxes (face_functions.hpp): f of form.hpp.
#pragma once

#include "core/geometry/face_functions.hpp"
#include "core/geometry/quadric/form.hpp"

namespace crt::core {

struct QuadricFunction {
  QuadricForm form;

  static constexpr std::uint32_t face_count() { return 1; }
  static constexpr int max_crossings(std::uint32_t) { return 2; }
  template <class Number>
  Number value(std::uint32_t /*face*/, const PointOf<Number>& point) const {
    const PointOf<Number> p = scaled(point, inverse_of_power(form.unit));
    const auto times = [](const Number& a, double b) { return a * Interval::of(b); };
    Number sum = times(p[0], form.linear.x) + times(p[1], form.linear.y) +
                 times(p[2], form.linear.z) + Interval::of(form.constant);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& row = form.rows[i];
      sum = sum + times(square(p[i]), row[static_cast<int>(i)] / 2);
      for (std::size_t j = i + 1; j < 3; ++j)
        sum = sum + times(p[i] * p[j], row[static_cast<int>(j)]);
    }
    return sum;
  }
};

}  // namespace crt::core
