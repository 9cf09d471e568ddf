// A jet is a number that depends on a place in space, with its slopes along x, y and z. Arithmetic
// with jets applies the rules of derivatives.
//
// Of a Number that is an Interval, the value holds what the number may be anywhere in a box, and
// the slopes hold all derivatives there. Source: Griewank, Walther, Evaluating derivatives, 2008,
// chapter 3 (forward mode). Tests: tests/math/jet_test.cpp
#pragma once

#include <array>
#include <cstddef>

#include "core/math/interval.hpp"

namespace crt::core {

template <class Number>
struct JetOf {
  Number value;
  std::array<Number, 3> slope;
};
using Jet = JetOf<Interval>;

namespace jet_detail {

template <class Number, class Function>
std::array<Number, 3> each(const Function& slope) {
  return {slope(0), slope(1), slope(2)};
}

}  // namespace jet_detail

template <class N>
JetOf<N> operator+(const JetOf<N>& a, const JetOf<N>& b) {
  return {a.value + b.value,
          jet_detail::each<N>([&](std::size_t i) { return a.slope[i] + b.slope[i]; })};
}
template <class N>
JetOf<N> operator-(const JetOf<N>& a, const JetOf<N>& b) {
  return {a.value - b.value,
          jet_detail::each<N>([&](std::size_t i) { return a.slope[i] - b.slope[i]; })};
}
template <class N>
JetOf<N> operator-(const JetOf<N>& a) {
  return {-a.value, jet_detail::each<N>([&](std::size_t i) { return -a.slope[i]; })};
}
template <class N>
JetOf<N> operator*(const JetOf<N>& a, const JetOf<N>& b) {
  return {a.value * b.value, jet_detail::each<N>([&](std::size_t i) {
            return a.value * b.slope[i] + b.value * a.slope[i];
          })};
}

// A constant is an interval that holds it.

template <class N>
JetOf<N> operator+(const JetOf<N>& a, const Interval& b) {
  return {a.value + b, a.slope};
}
template <class N>
JetOf<N> operator-(const JetOf<N>& a, const Interval& b) {
  return {a.value - b, a.slope};
}
template <class N>
JetOf<N> operator*(const JetOf<N>& a, const Interval& b) {
  return {a.value * b, jet_detail::each<N>([&](std::size_t i) { return a.slope[i] * b; })};
}

template <class N>
JetOf<N> square(const JetOf<N>& a) {
  const N rate = a.value * Interval::of(2);
  return {square(a.value), jet_detail::each<N>([&](std::size_t i) { return rate * a.slope[i]; })};
}

/// Returns the root of what is nowhere below 0, whatever rounding says.
inline Interval root(const Interval& a) {
  return square_root({a.lo > 0 ? a.lo : 0, a.hi > 0 ? a.hi : 0});
}
/// Returns 1 / a, or everything if a may be 0.
inline Interval inverse(const Interval& a) {
  return a.contains(0) ? Interval::everything() : Interval::of(1) / a;
}
template <class N>
JetOf<N> root(const JetOf<N>& a) {
  const N value = root(a.value);
  const N rate = inverse(value * Interval::of(2));
  return {value, jet_detail::each<N>([&](std::size_t i) { return rate * a.slope[i]; })};
}

/// Returns a where it is above 0, and else 0.
inline Interval positive_part(const Interval& a) {
  return {a.lo > 0 ? a.lo : 0, a.hi > 0 ? a.hi : 0};
}
template <class N>
JetOf<N> positive_part(const JetOf<N>& a) {
  const auto [lo, hi] = range_of(a.value);
  if (lo >= 0) return a;
  const N none = a.value * Interval{};
  if (hi <= 0) return {none, {none, none, none}};
  // The slopes are those of a, or 0, or anything between.
  return {positive_part(a.value), jet_detail::each<N>([&](std::size_t i) {
            return a.slope[i] * Interval{0, 1};
          })};
}

/// Returns all that a number may be.
inline Interval range_of(const Interval& a) {
  return a;
}

}  // namespace crt::core
