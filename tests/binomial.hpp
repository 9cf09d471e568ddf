// A count of successes bounds the share that they have in the long run.
#pragma once

#include <cmath>
#include <cstdint>

namespace crt::test {

/// Returns the lower end of the two-sided 95 % interval for the share of successes. Source: Clopper
/// and Pearson, The use of confidence or fiducial limits illustrated in the case of the binomial,
/// Biometrika 26(4), 1934.
inline double clopper_pearson_low(std::int64_t successes, std::int64_t trials) {
  if (successes == 0) return 0;
  const auto factorial = [](std::int64_t n) { return std::lgamma(static_cast<double>(n) + 1); };
  const auto at_least = [&](double share) {
    double sum = 0;
    for (std::int64_t k = successes; k <= trials; ++k) {
      sum += std::exp(factorial(trials) - factorial(k) - factorial(trials - k) +
                      static_cast<double>(k) * std::log(share) +
                      static_cast<double>(trials - k) * std::log1p(-share));
    }
    return sum;
  };
  constexpr double beyond = 0.025;  // on this side
  double low = 0;
  double high = 1;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (at_least(middle) < beyond ? low : high) = middle;
  }
  return low;
}

}  // namespace crt::test
