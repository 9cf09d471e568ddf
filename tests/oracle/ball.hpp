// This is ball arithmetic on short sums of doubles. The oracle tries it before MPFR, as it is some
// hundred times faster.
//
// A ball holds the true value for certain: it is within `radius` of the sum of the parts. Every
// operation computes by error-free transformations and adds what it drops to the radius, as it
// happens: no estimate of rounding is believed. Where nothing is dropped the radius stays 0, so
// small whole numbers remain exact. Numbers that are not finite have a radius that is not, and are
// never certain.
//
// Sources: Shewchuk, Adaptive precision floating-point arithmetic, 1997 (sums of doubles without
// error); Johansson, Arb, 2017 (midpoint and radius).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace crt::test {

/// Is thrown for the sign of a number that may be 0, or more or less.
struct Undecided {};

template <std::size_t parts>
class Ball {
 public:
  /// Returns the precision in bits.
  static constexpr int precision() { return 53 * static_cast<int>(parts); }

  Ball() = default;
  Ball(double value) : radius_(value - value) {
    part_[0] = value;
  }  // NOLINT(google-explicit-constructor): exact
  template <std::size_t fewer>
  requires(fewer < parts) explicit Ball(const Ball<fewer>& other) : radius_(other.radius()) {
    for (std::size_t i = 0; i < fewer; ++i) part_[i] = other.part(i);
  }
  /// Returns the sum of the terms, each with the given error, and `radius` more.
  static Ball sum_of(const double* terms, std::size_t count, double radius) {
    Sum sum;
    for (std::size_t i = 0; i < count; ++i) sum.add(terms[i]);
    return sum.ball(radius);
  }

  friend Ball operator+(const Ball& a, const Ball& b) {
    if constexpr (parts == 2) {
      const Two high = two_sum(a.part_[0], b.part_[0]);
      const Two low = two_sum(a.part_[1], b.part_[1]);
      const Two middle = two_sum(high.error, low.value);
      const Two top = two_sum(high.value, middle.value);
      const Two bottom = two_sum(low.error, middle.error);
      const Two rest = two_sum(top.error, bottom.value);
      return normal(top.value, rest.value,
                    a.radius_ + b.radius_ + (std::abs(rest.error) + std::abs(bottom.error)));
    } else {
      Sum sum;
      for (std::size_t i = 0; i < parts; ++i) {
        sum.add(a.part_[i]);
        sum.add(b.part_[i]);
      }
      return sum.ball(a.radius_ + b.radius_);
    }
  }
  friend Ball operator-(const Ball& a) {
    Ball result = a;
    for (double& part : result.part_) part = -part;
    return result;
  }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
  friend Ball operator*(const Ball& a, const Ball& b) {
    const double size_a = a.size();
    const double size_b = b.size();
    double radius = size_a * b.radius_ + size_b * a.radius_ + a.radius_ * b.radius_;
    if (size_a == 0 || size_b == 0) return normal(0, 0, radius);
    // Below this the errors of products may be lost themselves.
    constexpr double smallest_product = 0x1p-850;
    constexpr double lost = 0x1p-1000;
    if (!(size_a * size_b >= smallest_product) || radius > 0) radius += lost;
    if constexpr (parts == 2) {
      const Two high = two_product(a.part_[0], b.part_[0]);
      if (a.part_[1] == 0 && b.part_[1] == 0) return normal(high.value, high.error, radius);
      const Two first = two_product(a.part_[0], b.part_[1]);
      const Two second = two_product(a.part_[1], b.part_[0]);
      const Two cross = two_sum(first.value, second.value);
      const Two low = two_sum(high.error, cross.value);
      const double dropped = std::abs(first.error) + std::abs(second.error) +
                             std::abs(cross.error) + std::abs(low.error) +
                             std::abs(a.part_[1] * b.part_[1]);
      return normal(high.value, low.value, radius + dropped + lost);
    } else {
      Sum sum;
      for (std::size_t order = 0; order < parts; ++order) {
        for (std::size_t i = 0; i <= order; ++i) {
          const Two product = two_product(a.part_[i], b.part_[order - i]);
          sum.add(product.value);
          sum.add(product.error);
          if (order > 0 && product.value != 0) radius += lost;
        }
      }
      for (std::size_t i = 1; i < parts; ++i) {
        for (std::size_t j = parts - i; j < parts; ++j) radius += std::abs(a.part_[i] * b.part_[j]);
      }
      return sum.ball(radius);
    }
  }
  /// Divides. b must not hold 0.
  friend Ball operator/(const Ball& a, const Ball& b) {
    if (b.certain_sign() == 0) throw Undecided{};
    // Long division: |a / b - q| = |a - b q| / |b|.
    Ball quotient;
    Ball rest = a;
    for (std::size_t step = 0; step < parts + 1; ++step) {
      const Ball digit(rest.part_[0] / b.part_[0]);
      quotient = quotient + digit;
      rest = rest - b * digit;
    }
    quotient.radius_ = inflated(quotient.radius_ + (rest.size() + rest.radius_) / b.least_size());
    return quotient;
  }
  friend Ball square(const Ball& a) { return a * a; }
  /// Returns the root of what is known not to be negative.
  friend Ball sqrt(const Ball& a) {
    if (a.is_zero()) return a;
    if (a.certain_sign() <= 0) throw Undecided{};
    // |sqrt(a) - s| = |a - s^2| / (sqrt(a) + s), Newton's iteration.
    Ball root(std::sqrt(a.part_[0]));
    Ball rest = a - root * root;
    for (std::size_t step = 1; step < 2 * parts; step *= 2) {
      root = (root + rest.middle() / Ball(2 * root.part_[0])).middle();
      rest = a - root * root;
    }
    root.radius_ = inflated((rest.size() + rest.radius_) / root.least_size());
    return root;
  }
  friend Ball magnitude(const Ball& a) {
    if (a.part_[0] >= 0) return a;
    return -a;
  }

  int sign() const {
    const int certain = certain_sign();
    if (certain == 0 && !is_zero()) throw Undecided{};
    return certain;
  }
  /// Returns the sign, or 0 where it is not known.
  int certain_sign() const {
    if (!(least_size() > 0)) return 0;
    return part_[0] > 0 ? 1 : -1;
  }
  /// Says whether it is 0 for certain.
  bool is_zero() const { return part_[0] == 0 && radius_ == 0 && size() == 0; }
  bool surely_below(const Ball& other) const { return (other - *this).certain_sign() > 0; }
  /// Orders balls that are disjoint.
  friend bool is_less(const Ball& a, const Ball& b) {
    for (std::size_t i = 0; i < parts; ++i) {
      if (a.part_[i] != b.part_[i]) return a.part_[i] < b.part_[i];
    }
    return false;
  }
  Ball middle() const {
    Ball result = *this;
    result.radius_ = radius_ - radius_;
    return result;
  }
  /// Returns the ball with `more` on each side.
  Ball widened(double more) const {
    Ball result = *this;
    result.radius_ = inflated(radius_ + more);
    return result;
  }
  /// Returns a ball that holds both.
  friend Ball hull(const Ball& a, const Ball& b) {
    const Ball offset = b - a;
    return a.widened(offset.size() + offset.radius_ + b.radius_);
  }
  double value() const { return part_[0]; }
  double radius() const { return radius_; }
  double part(std::size_t i) const { return part_[i]; }
  /// Returns a bound: no number of the ball is larger, in size.
  double largest_size() const { return inflated(size() + radius_); }

 private:
  struct Two {
    double value;
    double error;
  };
  static Two two_sum(double a, double b) {
    const double sum = a + b;
    const double b_part = sum - a;
    return {sum, (a - (sum - b_part)) + (b - b_part)};
  }
  static Two two_product(double a, double b) {
    const double product = a * b;
    return {product, std::fma(a, b, -product)};
  }
  /// Covers the roundings of a radius that is a sum of some products.
  static double inflated(double radius) { return radius * (1 + 0x1p-40); }
  static Ball normal(double high, double low, double radius) {
    const double sum = high + low;
    Ball result;
    result.part_[0] = sum;
    result.part_[1] = two_sum(high, low).error;
    result.radius_ = inflated(radius) + (sum - sum);
    return result;
  }

  /// A Sum adds doubles without error, but for what runs off its end.
  struct Sum {
    void add(double term) {
      for (double& part : part_) {
        const Two sum = two_sum(part, term);
        part = sum.value;
        term = sum.error;
        if (term == 0) return;
      }
      dropped_ += std::abs(term);
    }
    Ball ball(double radius) {
      // It goes from the small end up. Two passes leave each part below the last place of the one
      // before.
      for (int pass = 0; pass < 2; ++pass) {
        for (std::size_t i = part_.size() - 1; i > 0; --i) {
          const Two sum = two_sum(part_[i - 1], part_[i]);
          part_[i - 1] = sum.value;
          part_[i] = sum.error;
        }
        // Zeros that cancellation left go to the end.
        std::fill(std::remove(part_.begin(), part_.end(), 0.0), part_.end(), 0.0);
      }
      Ball result;
      std::copy_n(part_.begin(), parts, result.part_.begin());
      for (std::size_t i = parts; i < part_.size(); ++i) dropped_ += std::abs(part_[i]);
      result.radius_ = inflated(radius + dropped_) + (part_[0] - part_[0]);
      return result;
    }

   private:
    std::array<double, parts + 2> part_{};
    double dropped_ = 0;
  };

  double size() const {
    double result = std::abs(part_[0]);
    for (std::size_t i = 1; i < parts; ++i) result += std::abs(part_[i]);
    return result * (1 + 0x1p-50);
  }
  /// Returns a bound: every number of the ball is at least so large, or it is negative.
  double least_size() const {
    double rest = radius_;
    for (std::size_t i = 1; i < parts; ++i) rest += std::abs(part_[i]);
    return std::abs(part_[0]) * (1 - 0x1p-50) - rest * (1 + 0x1p-40);
  }

  std::array<double, parts> part_{};
  double radius_ = 0;
};

}  // namespace crt::test
