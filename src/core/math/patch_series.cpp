#include "core/math/patch_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace crt::core {

namespace {

constexpr std::size_t degree = PatchSeries::degree;
/// Bounds on errors are themselves rounded a few times.
constexpr double bound_slack = 1 + 0x1p-40;
/// No term of a sum or a product has more roundings than this, relative to the sum of sizes.
constexpr double sum_rounding = 0x1p-51;
constexpr double product_rounding = 0x1p-48;
constexpr double smallest = std::numeric_limits<double>::min();

/// Returns a bound on an error, rounded upwards, which is infinite where it is not a number.
double bound_of(double error) {
  const double bound = error * bound_slack + smallest;
  return bound <= Interval::largest ? bound : std::numeric_limits<double>::infinity();
}

/// Returns the sums of the sizes of terms, by degree.
std::array<double, degree + 1> sizes_by_degree(const PatchSeries& a) {
  std::array<double, degree + 1> sizes{};
  std::size_t place = 0;
  for (std::size_t d = 0; d <= degree; ++d) {
    for (std::size_t j = 0; j <= d; ++j) sizes[d] += std::abs(a.terms[place++]);
  }
  return sizes;
}

/// Returns the place of the first term of a degree.
constexpr std::size_t first_of(std::size_t d) {
  return d * (d + 1) / 2;
}

/// Returns the highest degree of which there are terms.
std::size_t top_degree(const std::array<double, degree + 1>& sizes) {
  std::size_t top = degree;
  while (top > 0 && sizes[top] == 0) --top;
  return top;
}

double sum_of(const std::array<double, degree + 1>& sizes) {
  double sum = 0;
  for (const double size : sizes) sum += size;
  return sum;
}

double seventh_power(double x) {
  const double square = x * x;
  return square * square * square * x * bound_slack;
}

/// Returns a polynomial of e = a / a0 - 1, where a0 is the constant term, by its factors from e on.
/// `beyond` bounds what the function has more, for |e| <= size.
template <class Beyond>
PatchSeries of_small(const PatchSeries& a, const std::array<double, degree + 1>& factors,
                     double scale, const Beyond& beyond) {
  PatchSeries e = a * (Interval::of(1) / Interval::of(a.terms[0])) - Interval::of(1);
  const double size = std::abs(e.terms[0]) + e.spread();
  constexpr double largest = 0.75;
  if (!(a.terms[0] != 0) || !(size < largest))
    return {.error = std::numeric_limits<double>::infinity()};
  PatchSeries sum = PatchSeries::of(Interval::of(factors[degree]));
  for (std::size_t i = degree; i-- > 0;) sum = sum * e + Interval::of(factors[i]);
  sum.error = (sum.error + beyond(size)) * bound_slack;
  return sum * around(scale, scale);
}

}  // namespace

PatchSeries PatchSeries::of(const Interval& constant) {
  PatchSeries result;
  const double middle = constant.middle();
  result.terms[0] = middle;
  result.error = rounded_up(std::max(constant.hi - middle, middle - constant.lo));
  if (constant.is_point()) result.error = 0;
  return result;
}

PatchSeries PatchSeries::linear(double constant, double s_slope, double t_slope) {
  PatchSeries result;
  result.terms[0] = constant;
  result.terms[place(1, 0)] = s_slope;
  result.terms[place(0, 1)] = t_slope;
  return result;
}

double PatchSeries::spread() const {
  double sum = 0;
  for (std::size_t i = 1; i < term_count; ++i) sum += std::abs(terms[i]);
  return (sum + error) * bound_slack;
}

PatchSeries operator+(const PatchSeries& a, const PatchSeries& b) {
  PatchSeries result;
  double size = 0;
  for (std::size_t i = 0; i < PatchSeries::term_count; ++i) {
    result.terms[i] = a.terms[i] + b.terms[i];
    size += std::abs(result.terms[i]);
  }
  result.error = (a.error + b.error + sum_rounding * size) * bound_slack;
  return result;
}

PatchSeries operator-(const PatchSeries& a) {
  PatchSeries result = a;
  for (double& term : result.terms) term = -term;
  return result;
}

PatchSeries operator-(const PatchSeries& a, const PatchSeries& b) {
  return a + -b;
}

PatchSeries operator*(const PatchSeries& a, const PatchSeries& b) {
  const auto sizes_a = sizes_by_degree(a);
  const auto sizes_b = sizes_by_degree(b);
  const std::size_t top_a = top_degree(sizes_a);
  const std::size_t top_b = top_degree(sizes_b);
  PatchSeries result;
  for (std::size_t d = 0; d <= top_a; ++d) {
    for (std::size_t e = 0; e <= std::min(top_b, degree - d); ++e) {
      double* const out = &result.terms[first_of(d + e)];
      for (std::size_t i = 0; i <= d; ++i) {
        const double factor = a.terms[first_of(d) + i];
        for (std::size_t j = 0; j <= e; ++j) out[i + j] += factor * b.terms[first_of(e) + j];
      }
    }
  }
  double beyond = 0;
  for (std::size_t d = degree + 1 - std::min(top_b, degree); d <= top_a; ++d) {
    for (std::size_t e = degree + 1 - d; e <= top_b; ++e) beyond += sizes_a[d] * sizes_b[e];
  }
  const double size_a = sum_of(sizes_a);
  const double size_b = sum_of(sizes_b);
  double error = beyond + product_rounding * (size_a * size_b);
  if (a.error != 0) error += a.error * (size_b + b.error);
  if (b.error != 0) error += b.error * size_a;
  result.error = bound_of(error);
  return result;
}

PatchSeries operator+(const PatchSeries& a, const Interval& b) {
  PatchSeries result = a;
  const PatchSeries constant = PatchSeries::of(b);
  result.terms[0] += constant.terms[0];
  result.error =
      (a.error + constant.error + sum_rounding * std::abs(result.terms[0])) * bound_slack;
  return result;
}

PatchSeries operator-(const PatchSeries& a, const Interval& b) {
  return a + -b;
}

PatchSeries operator*(const PatchSeries& a, const Interval& b) {
  const PatchSeries factor = PatchSeries::of(b);
  PatchSeries result;
  double size = 0;
  for (std::size_t i = 0; i < PatchSeries::term_count; ++i) {
    result.terms[i] = a.terms[i] * factor.terms[0];
    size += std::abs(a.terms[i]);
  }
  double error = sum_rounding * (size * std::abs(factor.terms[0])) + factor.error * size;
  if (a.error != 0) error += a.error * (std::abs(factor.terms[0]) + factor.error);
  result.error = bound_of(error);
  return result;
}

PatchSeries square(const PatchSeries& a) {
  return a * a;
}

PatchSeries root(const PatchSeries& a) {
  // What the series of sqrt(1 + e) has beyond e^6 is at most 33/2048 |e|^7 / (1 - |e|)^(13/2).
  const auto beyond = [](double size) { return 33.0 / 2048 * seventh_power(size / (1 - size)); };
  if (!(a.terms[0] > 0)) return {.error = std::numeric_limits<double>::infinity()};
  return of_small(a, {1, 1.0 / 2, -1.0 / 8, 1.0 / 16, -5.0 / 128, 7.0 / 256, -21.0 / 1024},
                  std::sqrt(a.terms[0]), beyond);
}

PatchSeries inverse(const PatchSeries& a) {
  const auto beyond = [](double size) { return seventh_power(size) / (1 - size); };
  return of_small(a, {1, -1, 1, -1, 1, -1, 1}, 1 / a.terms[0], beyond);
}

PatchSeries positive_part(const PatchSeries& a) {
  const Interval range = range_of(a);
  if (range.lo >= 0) return a;
  return PatchSeries::of({0, std::max(range.hi, 0.0)});
}

Interval range_of(const PatchSeries& a) {
  const double spread = a.spread();
  return Interval{sum_down(a.terms[0] - spread), sum_up(a.terms[0] + spread)};
}

PatchSeries part_of(const PatchSeries& a, double s, double t, double size) {
  PatchSeries result = a;
  const auto sizes = sizes_by_degree(a);
  const std::size_t top = top_degree(sizes);
  // Shifting takes multiples of higher terms to lower ones (Horner), along s and then along t.
  const auto shift = [&](double by, const auto& place) {
    for (std::size_t row = 0; row < top; ++row) {
      for (std::size_t first = 0; first + row < top; ++first) {
        for (std::size_t i = top - row; i-- > first;)
          result.terms[place(i, row)] += by * result.terms[place(i + 1, row)];
      }
    }
  };
  shift(s, [](std::size_t i, std::size_t j) { return PatchSeries::place(i, j); });
  shift(t, [](std::size_t j, std::size_t i) { return PatchSeries::place(i, j); });
  double power = 1;
  for (std::size_t d = 0, place = 0; d <= top; ++d, power *= size) {
    for (std::size_t j = 0; j <= d; ++j, ++place) result.terms[place] *= power;
  }
  result.error = (a.error + product_rounding * sum_of(sizes)) * bound_slack;
  return result;
}

double value_at(const PatchSeries& a, double s, double t) {
  double sum = 0;
  for (std::size_t i = degree + 1; i-- > 0;) {
    double row = 0;
    for (std::size_t j = degree + 1 - i; j-- > 0;)
      row = row * t + a.terms[PatchSeries::place(i, j)];
    sum = sum * s + row;
  }
  return sum;
}

double change_in_quarter(const PatchSeries& a) {
  const auto sizes = sizes_by_degree(a);
  double sum = 0;
  for (std::size_t d = 1; d <= degree; ++d) sum += static_cast<double>(d) * sizes[d];
  return 0.5 * sum * bound_slack;
}

}  // namespace crt::core
