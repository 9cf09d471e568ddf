// Input rays are those that users pass to queries. They are converted to rays that can be traced.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "core/math/vector_lanes.hpp"
#include "core/prepare/prepared_data.hpp"
#include "core/ray/ray_packet.hpp"
#include "crt/query.hpp"

namespace crt::core {

/// Returns whether rays are valid by a quick test. It is false also for valid rays with too large
/// sums.
template <class Real>
MaskOf<Real> are_plainly_valid(const Vec3Of<Real>& origin, const Vec3Of<Real>& direction,
                               const Real& t_min, const Real& t_max) {
  const auto sum_of = [](const auto& v) { return abs(v.x) + abs(v.y) + abs(v.z); };
  const Real extent = sum_of(direction);
  const auto finite = sum_of(origin) + extent <= std::numeric_limits<double>::max();
  return extent > 0.0 && finite && (t_min <= t_max || t_min > t_max);
}

inline bool is_plainly_valid(const Ray& ray) {
  return are_plainly_valid<double>(ray.origin, ray.direction, ray.t_min, ray.t_max);
}

/// A UserRays has input rays side by side.
struct UserRays {
  VectorLanes origin;
  VectorLanes direction;
  Lanes t_min;
  Lanes t_max;

  explicit UserRays(std::span<const Ray, lane_count> rays) {
    static_assert(std::is_standard_layout_v<Ray> && sizeof(Ray) == 2 * sizeof(Lanes));
    const auto half = [&](std::size_t begin) {
      const auto row = [&](std::size_t lane) {
        std::array<double, lane_count> numbers;
        std::memcpy(&numbers, reinterpret_cast<const std::byte*>(&rays[lane]) + begin,
                    sizeof numbers);
        return lanes_at<Lanes>(numbers.data());
      };
      return transposed({row(0), row(1), row(2), row(3)});
    };
    const auto first = half(0);
    const auto second = half(sizeof(Lanes));
    origin = {first[0], first[1], first[2]};
    direction = {first[3], second[0], second[1]};
    t_min = second[2];
    t_max = second[3];
  }

  LaneMask plainly_valid() const {
    return are_plainly_valid<Lanes>(origin, direction, t_min, t_max);
  }
};

/// A PowerOfTwo is a factor. It multiplies exactly wherever the result is a normal number.
class PowerOfTwo {
 public:
  PowerOfTwo() = default;
  explicit PowerOfTwo(int exponent) : factor_(0), exponent_(exponent) {
    constexpr int bias = 1023;
    constexpr int fraction_bits = 52;
    if (std::abs(exponent) < bias) {
      factor_ = std::bit_cast<double>(static_cast<std::uint64_t>(bias + exponent) << fraction_bits);
    }
  }

  /// Returns the number if it is a normal one, else 0.
  double factor() const { return factor_; }

  double operator*(double value) const {
    return factor_ != 0 ? factor_ * value : std::scalbn(value, exponent_);
  }
  Vec3 operator*(const Vec3& v) const {
    return factor_ != 0 ? factor_ * v : Vec3(*this * v.x, *this * v.y, *this * v.z);
  }

 private:
  double factor_ = 1;  ///< 0 where no normal number holds it, and the exponent does
  int exponent_ = 0;
};

/// Returns the exponent of a number's highest digit; x > 0.
inline int exponent_of(double x) {
  constexpr int bias = 1023;
  constexpr int fraction_bits = 52;
  const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> fraction_bits);
  return biased > 0 ? biased - bias : std::ilogb(x);
}

/// Returns which rays have no number between t_min and t_max. Where t is scaled there are finer
/// numbers, but none that could be reported.
template <class Real>
MaskOf<Real> are_without_t(const Real& t_min, const Real& t_max) {
  return t_max - t_min == std::numeric_limits<double>::denorm_min();
}

/// Beyond this t, along a direction near length 1, a point may have no finite coordinates, and
/// there is no hit. There is none beyond the largest t either.
inline constexpr double farthest = 0x1p1022;

/// Converts an input ray to one that can be traced. Its direction is brought near length 1 by a
/// power of two, which makes any length safe and changes no digit of t. See users_t().
inline void follow(const Ray& users, const InputTolerance& tolerance, WorldRay& ray) {
  constexpr double largest = std::numeric_limits<double>::max();
  const int exponent = exponent_of(largest_component(users.direction));
  const PowerOfTwo shorten(-exponent);
  const PowerOfTwo lengthen(exponent);
  ray.origin = users.origin;
  ray.direction = shorten * users.direction;
  ray.t_min = std::max(lengthen * std::max(users.t_min, -largest), -farthest);
  ray.t_max = std::min(lengthen * std::min(users.t_max, largest), farthest);
  if (are_without_t(users.t_min, users.t_max)) ray.t_max = ray.t_min;
  ray.start.t_error = tolerance.error_at(plain_ray(ray), ray.t_min);
  ray.end_error = tolerance.error_at(plain_ray(ray), ray.t_max);
  ray.max_size_error = tolerance.max_size_error;
  ray.is_input = tolerance.rounding > 0;
}

/// Converts valid input rays side by side. Returns false if one is too long or short for that. The
/// factors that shorten them are put into `to_users_t`.
inline bool follow(const UserRays& users, const InputTolerance& tolerance, std::size_t group,
                   RayBatch& rays, Lanes& to_users_t) {
  constexpr double largest = std::numeric_limits<double>::max();
  constexpr double longest = 0x1p1022;
  const Lanes extent = largest_component(users.direction);
  const Lanes lengthen = power_of_two_below(extent);
  if (!all((extent >= 1 / longest) & (lengthen <= longest))) return false;
  if (any(are_without_t(users.t_min, users.t_max))) return false;
  to_users_t = inverse_of_power(lengthen);
  rays.lines[group] = {users.origin, to_users_t * users.direction};
  rays.t_min[group] = max(lengthen * max(users.t_min, lanes_of(-largest)), lanes_of(-farthest));
  rays.t_max[group] = min(lengthen * min(users.t_max, lanes_of(largest)), lanes_of(farthest));
  rays.start_errors[group] = tolerance.error_at(rays.lines[group], rays.t_min[group]);
  rays.end_errors[group] = tolerance.error_at(rays.lines[group], rays.t_max[group]);
  return true;
}

/// Returns whether a t still has all its digits.
template <class Real>
MaskOf<Real> has_all_digits(const Real& users_t) {
  return abs(users_t) >= std::numeric_limits<double>::min();
}

/// Returns the input ray's t of a crossing at t + t_low of the traced ray. Next to 0, where numbers
/// have fewer digits, it is rounded once more. But it is rounded neither onto t_min nor onto t_max,
/// between which it is.
inline double users_t(const Ray& users, double t, double t_low) {
  const int exponent = exponent_of(largest_component(users.direction));
  double result = PowerOfTwo(-exponent) * t;
  if (has_all_digits(result)) return result;
  constexpr double step = std::numeric_limits<double>::denorm_min();
  // Halfway between two numbers t_low decides which is nearer.
  const PowerOfTwo lengthen(exponent);
  const double rest = t - lengthen * result;
  if (2 * std::abs(rest) == lengthen * step && rest * t_low > 0)
    result += std::copysign(step, rest);
  return std::clamp(result, std::nextafter(users.t_min, infinity),
                    std::nextafter(users.t_max, -infinity));
}

}  // namespace crt::core
