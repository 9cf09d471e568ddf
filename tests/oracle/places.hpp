// These functions find where a membership that depends on the signs of polynomials changes along a
// line.
#pragma once

#include <span>
#include <vector>

#include "oracle/roots.hpp"

namespace crt::test {

/// A Place is where one or several polynomials change their signs: roots that are one place by
/// proof.
template <class Number>
struct Place {
  struct Flip {
    Number x;
    std::size_t polynomial = 0;
    int after = 0;
  };
  Number x;
  std::span<const Flip> flips;
};

/// Says whether two polynomials have the same roots, as they are equal but for a factor. That is
/// known at once where faces coincide, and where lines meet the edge of two planes.
template <class Number>
bool are_proportional(const Polynomial<Number>& a, const Polynomial<Number>& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i + 1 < a.size(); ++i) {
    if (!(a[i] * b.back() - b[i] * a.back()).is_zero()) return false;
  }
  return true;
}

/// Says whether a polynomial has a root where the quotient a / b has it: q b^degree, by Horner's
/// rule.
template <class Number>
bool is_root(const Polynomial<Number>& q, const Number& a, const Number& b) {
  Number value = q.back();
  Number power = b;
  for (std::size_t i = q.size() - 1; i-- > 0; power = power * b) value = value * a + q[i] * power;
  return value.is_zero();
}

/// Says whether two polynomials are known to have a root in common. It is false where that is not
/// known.
template <class Number>
bool share_root(const Polynomial<Number>& p, const Polynomial<Number>& q) {
  if (are_proportional(p, q)) return true;
  if (p.size() == 2) return is_root(q, -p[0], p[1]);
  if (q.size() == 2) return is_root(p, -q[0], q[1]);
  if (p.size() != 3 || q.size() != 3 || p[2].is_zero() || q[2].is_zero()) return false;
  // This is the resultant of two quadratics.
  const Number outer = p[2] * q[0] - p[0] * q[2];
  return (square(outer) - (p[2] * q[1] - p[1] * q[2]) * (p[1] * q[0] - p[0] * q[1])).is_zero();
}

/// Holds all places along a line in order.
template <class Number>
class Places {
 public:
  using Flip = typename Place<Number>::Flip;

  explicit Places(std::span<const Polynomial<Number>> polynomials) : polynomials_(polynomials) {
    flips_.reserve(2 * polynomials.size());
    for (std::size_t i = 0; i < polynomials.size(); ++i) {
      auto changes = sign_changes(polynomials[i]);
      signs_before_.push_back(changes.before);
      for (auto& change : changes.at) flips_.push_back({std::move(change.x), i, change.after});
    }
    std::sort(flips_.begin(), flips_.end(),
              [](const Flip& a, const Flip& b) { return is_less(a.x, b.x); });
    for (std::size_t begin = 0; begin < flips_.size();) begin = join(begin);
  }
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  /// Returns the signs at t = -infinity.
  const std::vector<int>& signs_before() const { return signs_before_; }
  const std::vector<Place<Number>>& places() const { return places_; }

 private:
  /// Adds the place that begins with this flip, and returns where the next begins.
  std::size_t join(std::size_t begin) {
    Number x = flips_[begin].x;
    std::size_t end = begin + 1;
    for (; end < flips_.size() && !x.surely_below(flips_[end].x); ++end) {
      const bool same =
          share_root(polynomials_[flips_[begin].polynomial], polynomials_[flips_[end].polynomial]);
      if (!same && !is_last_try()) throw Undecided{};
      x = hull(x, flips_[end].x);
    }
    places_.push_back({std::move(x), std::span<const Flip>(flips_).subspan(begin, end - begin)});
    return end;
  }

  std::span<const Polynomial<Number>> polynomials_;
  std::vector<Flip> flips_;
  std::vector<int> signs_before_;
  std::vector<Place<Number>> places_;
};

/// Calls changed(place, now inside) where inside(signs) changes. Returns whether it is true at t =
/// -infinity.
template <class Number, class Inside, class Changed>
bool follow(const Places<Number>& places, const Inside& inside, const Changed& changed) {
  std::vector<int> signs = places.signs_before();
  const bool before = inside(signs);
  bool now = before;
  for (const Place<Number>& place : places.places()) {
    for (const auto& flip : place.flips) signs[flip.polynomial] = flip.after;
    if (inside(signs) == now) continue;
    now = !now;
    changed(place, now);
  }
  return before;
}

}  // namespace crt::test
