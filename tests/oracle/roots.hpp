// The real roots of a polynomial, each enclosed for certain.
#pragma once

#include <vector>

#include "oracle/interval.hpp"

namespace crt::test {

/// Coefficients, the constant one first.
using Polynomial = std::vector<Interval>;

Interval evaluate(const Polynomial& p, const Interval& x);
Polynomial derivative(const Polynomial& p);

/// Every real root at which the polynomial changes its sign, and maybe some where it does not (double
/// roots), in no particular order. Degrees up to 2 by formula; above, roots are isolated by those of the
/// derivative and enclosed by a change of sign. Throws Undecided if the precision does not do; with the
/// highest, extrema that nothing tells from 0 are double roots, which are left out.
std::vector<Interval> roots(const Polynomial& p);

}  // namespace crt::test
