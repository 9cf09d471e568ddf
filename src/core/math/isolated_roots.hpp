// All real roots of a polynomial are isolated, mostly without a search.
#pragma once

#include <vector>

#include "core/math/dyadic_polynomial.hpp"

namespace crt::core {

/// IsolatedRoots are all real roots of a polynomial, in ascending order.
struct IsolatedRoots {
  /// A Bracket has one root between its ends, which are no roots.
  struct Bracket {
    Dyadic low;
    Dyadic high;
  };

  DyadicPolynomial polynomial;    ///< has these roots, and changes its sign at each of them
  std::vector<Bracket> brackets;  ///< no two have a point in common but for their ends
};

/// Returns the polynomial of h that has the value of another one at x + h.
DyadicPolynomial about(const DyadicPolynomial& polynomial, const Dyadic& x);

/// Isolates the roots of a polynomial, which must not be 0. What root_separators() says of its
/// limits holds here, too.
IsolatedRoots isolated_roots(const DyadicPolynomial& polynomial);

}  // namespace crt::core
