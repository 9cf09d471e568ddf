// A patch series is a polynomial of two numbers s and t, each from -1 to 1, with a bound on what a
// function may differ from it anywhere there: a Taylor model.
//
// What a product has beyond the degree, and every rounding, is added to the bound.
// Source: Makino, Berz, Taylor models and other validated functional inclusion methods, 2003.
// Tests: tests/math/patch_series_test.cpp
#pragma once

#include <array>
#include <cstddef>

#include "core/math/interval.hpp"

namespace crt::core {

struct PatchSeries {
  static constexpr std::size_t degree = 6;
  static constexpr std::size_t term_count = (degree + 1) * (degree + 2) / 2;
  /// Returns the place of the term of s^i t^j.
  static constexpr std::size_t place(std::size_t i, std::size_t j) {
    return (i + j) * (i + j + 1) / 2 + j;
  }

  std::array<double, term_count> terms{};
  double error = 0;  ///< infinite where nothing is known

  static PatchSeries of(const Interval& constant);
  /// Returns constant + s s_slope + t t_slope.
  static PatchSeries linear(double constant, double s_slope, double t_slope);

  /// Returns a bound on how far it is from its constant term.
  double spread() const;
};

PatchSeries operator+(const PatchSeries& a, const PatchSeries& b);
PatchSeries operator-(const PatchSeries& a, const PatchSeries& b);
PatchSeries operator-(const PatchSeries& a);
PatchSeries operator*(const PatchSeries& a, const PatchSeries& b);
PatchSeries operator+(const PatchSeries& a, const Interval& b);
PatchSeries operator-(const PatchSeries& a, const Interval& b);
PatchSeries operator*(const PatchSeries& a, const Interval& b);
PatchSeries square(const PatchSeries& a);
/// These know nothing where a comes near 0.
PatchSeries root(const PatchSeries& a);
PatchSeries inverse(const PatchSeries& a);
PatchSeries positive_part(const PatchSeries& a);

Interval range_of(const PatchSeries& a);
/// Returns what it is in the part of the patch from s - size to s + size, and so with t, as a
/// patch.
PatchSeries part_of(const PatchSeries& a, double s, double t, double size);
/// Returns the polynomial's value, rounded.
double value_at(const PatchSeries& a, double s, double t);
/// Returns a bound on how much it changes from the middle of a quarter of the patch to anywhere in
/// it, but for the error.
double change_in_quarter(const PatchSeries& a);

}  // namespace crt::core
