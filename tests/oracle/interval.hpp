// This is interval arithmetic on MPFR, which every number of the oracle uses.
//
// An interval holds the true value for certain, as every operation rounds outwards. A number that
// fits the precision stays a point, so the sign of a dyadic expression is known exactly once the
// precision is large enough. Where a sign is open, `Undecided` is thrown and the caller tries again
// with more bits. It offers the same as Ball, so that all of the oracle is written once for both.
#pragma once

#include <mpfr.h>

#include <array>
#include <limits>
#include <utility>

#include "oracle/ball.hpp"

namespace crt::test {

/// Bits sets the precision of what this thread computes, in bits.
struct Bits {
  static constexpr mpfr_prec_t lowest = 256;
  static constexpr mpfr_prec_t highest = 4096;
  static constexpr mpfr_prec_t factor = 4;

  static inline thread_local mpfr_prec_t now = lowest;
};

class Interval {
 public:
  /// Makes no number at all, which can only be assigned to.
  Interval() noexcept : Interval(Empty{}) {}
  Interval(double value) {  // NOLINT(google-explicit-constructor): exact
    initialise(Bits::now);
    mpfr_set_d(lower_, value, MPFR_RNDN);
    mpfr_set_d(upper_, value, MPFR_RNDN);
  }
  Interval(const Interval& other) : Interval(Empty{}) {
    if (other.lower_->_mpfr_d == nullptr) return;
    initialise(mpfr_get_prec(other.lower_));
    mpfr_set(lower_, other.lower_, MPFR_RNDD);
    mpfr_set(upper_, other.upper_, MPFR_RNDU);
  }
  Interval(Interval&& other) noexcept : Interval(Empty{}) { swap(other); }
  Interval& operator=(Interval other) noexcept {
    swap(other);
    return *this;
  }
  ~Interval() {
    if (lower_->_mpfr_d == nullptr) return;
    mpfr_clear(lower_);
    mpfr_clear(upper_);
  }

  friend Interval operator+(const Interval& a, const Interval& b) {
    Interval result(Blank{});
    mpfr_add(result.lower_, a.lower_, b.lower_, MPFR_RNDD);
    mpfr_add(result.upper_, a.upper_, b.upper_, MPFR_RNDU);
    return result;
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    Interval result(Blank{});
    mpfr_sub(result.lower_, a.lower_, b.upper_, MPFR_RNDD);
    mpfr_sub(result.upper_, a.upper_, b.lower_, MPFR_RNDU);
    return result;
  }
  friend Interval operator-(const Interval& a) { return Interval(0.0) - a; }
  friend Interval operator*(const Interval& a, const Interval& b) {
    const int sign_a = a.certain_sign();
    const int sign_b = b.certain_sign();
    if (sign_a == 0 || sign_b == 0) return hull_of_products(a, b);
    Interval result(Blank{});
    mpfr_mul(result.lower_, sign_b > 0 ? a.lower_ : a.upper_, sign_a > 0 ? b.lower_ : b.upper_,
             MPFR_RNDD);
    mpfr_mul(result.upper_, sign_b > 0 ? a.upper_ : a.lower_, sign_a > 0 ? b.upper_ : b.lower_,
             MPFR_RNDU);
    return result;
  }
  /// Divides. b must not hold 0.
  friend Interval operator/(const Interval& a, const Interval& b) {
    if (b.certain_sign() == 0) throw Undecided{};
    const bool positive = b.certain_sign() > 0;
    const mpfr_t& low = positive ? a.lower_ : a.upper_;
    const mpfr_t& high = positive ? a.upper_ : a.lower_;
    Interval result(Blank{});
    mpfr_div(result.lower_, low, mpfr_sgn(low) >= 0 ? b.upper_ : b.lower_, MPFR_RNDD);
    mpfr_div(result.upper_, high, mpfr_sgn(high) >= 0 ? b.lower_ : b.upper_, MPFR_RNDU);
    return result;
  }
  friend Interval square(const Interval& a) {
    if (a.certain_sign() != 0) return a * a;
    Interval result = hull_of_products(a, a);
    if (mpfr_sgn(result.lower_) < 0) mpfr_set_zero(result.lower_, 1);
    return result;
  }
  /// Returns the root of what is known not to be negative.
  friend Interval sqrt(const Interval& a) {
    Interval result(Blank{});
    if (mpfr_sgn(a.lower_) > 0) {
      mpfr_sqrt(result.lower_, a.lower_, MPFR_RNDD);
    } else {
      mpfr_set_zero(result.lower_, 1);
    }
    mpfr_sqrt(result.upper_, mpfr_sgn(a.upper_) > 0 ? a.upper_ : result.lower_, MPFR_RNDU);
    return result;
  }
  friend Interval magnitude(const Interval& a) {
    if (mpfr_sgn(a.lower_) >= 0) return a;
    if (mpfr_sgn(a.upper_) <= 0) return -a;
    return sqrt(square(a));
  }

  /// Returns -1, 0 or 1. An interval around 0 that is more than 0 throws. With the highest
  /// precision it is 0.
  int sign() const {
    const int certain = certain_sign();
    if (certain != 0 || is_zero()) return certain;
    if (Bits::now < Bits::highest) throw Undecided{};
    return 0;
  }
  /// Returns the sign, or 0 where it is not known.
  int certain_sign() const { return mpfr_sgn(lower_) > 0 ? 1 : (mpfr_sgn(upper_) < 0 ? -1 : 0); }

  /// Says whether it is 0 for certain.
  bool is_zero() const { return mpfr_zero_p(lower_) != 0 && mpfr_zero_p(upper_) != 0; }

  bool surely_below(const Interval& other) const { return mpfr_less_p(upper_, other.lower_) != 0; }

  /// Returns a point within.
  Interval middle() const {
    Interval result(Blank{});
    mpfr_add(result.lower_, lower_, upper_, MPFR_RNDN);
    mpfr_div_2ui(result.lower_, result.lower_, 1, MPFR_RNDN);
    mpfr_set(result.upper_, result.lower_, MPFR_RNDN);
    return result;
  }
  /// Returns the smallest interval that holds both.
  friend Interval hull(const Interval& a, const Interval& b) {
    Interval result(Blank{});
    mpfr_min(result.lower_, a.lower_, b.lower_, MPFR_RNDD);
    mpfr_max(result.upper_, a.upper_, b.upper_, MPFR_RNDU);
    return result;
  }
  /// Orders intervals that are disjoint.
  friend bool is_less(const Interval& a, const Interval& b) {
    return mpfr_less_p(a.middle().lower_, b.middle().lower_) != 0;
  }
  /// Returns the precision in bits.
  static int precision() { return static_cast<int>(Bits::now); }
  /// Returns a double near the middle.
  double value() const { return mpfr_get_d(middle().lower_, MPFR_RNDN); }
  /// Returns a bound: no number of the interval is larger, in size.
  double largest_size() const {
    return std::max(-mpfr_get_d(lower_, MPFR_RNDD), mpfr_get_d(upper_, MPFR_RNDU));
  }
  /// Returns a ball that holds the interval.
  Ball<4> ball() const {
    std::array<double, 4> parts{};
    Interval rest = *this;
    for (double& part : parts) {
      part = rest.value();
      rest = rest - Interval(part);
    }
    return Ball<4>::sum_of(parts.data(), 4, rest.largest_size());
  }

 private:
  struct Blank {};
  struct Empty {};

  explicit Interval(Blank) { initialise(Bits::now); }
  explicit Interval(Empty) noexcept {
    lower_->_mpfr_d = nullptr;
    upper_->_mpfr_d = nullptr;
  }
  void initialise(mpfr_prec_t bits) {
    mpfr_init2(lower_, bits);
    mpfr_init2(upper_, bits);
  }
  void swap(Interval& other) noexcept {
    std::swap(lower_[0], other.lower_[0]);
    std::swap(upper_[0], other.upper_[0]);
  }
  static Interval hull_of_products(const Interval& a, const Interval& b) {
    Interval result(Blank{});
    Interval other(Blank{});
    mpfr_mul(result.lower_, a.lower_, b.upper_, MPFR_RNDD);
    mpfr_mul(other.lower_, a.upper_, b.lower_, MPFR_RNDD);
    mpfr_min(result.lower_, result.lower_, other.lower_, MPFR_RNDD);
    mpfr_mul(other.lower_, a.lower_, b.lower_, MPFR_RNDD);
    mpfr_min(result.lower_, result.lower_, other.lower_, MPFR_RNDD);
    mpfr_mul(other.lower_, a.upper_, b.upper_, MPFR_RNDD);
    mpfr_min(result.lower_, result.lower_, other.lower_, MPFR_RNDD);
    mpfr_mul(result.upper_, a.lower_, b.lower_, MPFR_RNDU);
    mpfr_mul(other.upper_, a.upper_, b.upper_, MPFR_RNDU);
    mpfr_max(result.upper_, result.upper_, other.upper_, MPFR_RNDU);
    mpfr_mul(other.upper_, a.lower_, b.upper_, MPFR_RNDU);
    mpfr_max(result.upper_, result.upper_, other.upper_, MPFR_RNDU);
    mpfr_mul(other.upper_, a.upper_, b.lower_, MPFR_RNDU);
    mpfr_max(result.upper_, result.upper_, other.upper_, MPFR_RNDU);
    return result;
  }

  mpfr_t lower_ = {};
  mpfr_t upper_ = {};
};

/// Lists the numbers that the oracle tries, the fastest first. Interval comes after them.
enum class FirstTry { two_doubles, three_doubles, mpfr };

/// Names the number that `compute`, a function of a value of a number type, works with.
template <class Number>
struct Using {
  using type = Number;
};

/// Runs `compute` with more and more bits until it is certain.
template <class Compute>
auto until_certain(const Compute& compute, FirstTry first = FirstTry::two_doubles) {
  try {
    if (first <= FirstTry::two_doubles) return compute(Using<Ball<2>>());
  } catch (const Undecided&) {
  }
  try {
    if (first <= FirstTry::three_doubles) return compute(Using<Ball<3>>());
  } catch (const Undecided&) {
  }
  struct Restore {
    ~Restore() { Bits::now = Bits::lowest; }
  } restore;
  Bits::now = Bits::lowest;
  while (true) {
    try {
      return compute(Using<Interval>());
    } catch (const Undecided&) {
      if (Bits::now >= Bits::highest) throw;
      Bits::now *= Bits::factor;
    }
  }
}

/// Says whether this is the last try, so that no more bits can be had.
inline bool is_last_try() {
  return Bits::now >= Bits::highest;
}

}  // namespace crt::test
