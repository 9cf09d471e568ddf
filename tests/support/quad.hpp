// Quad is quadruple precision, in which tests compute by themselves what must come out.
#pragma once

#include <limits>

namespace crt::test {

#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = long double;  // as on AArch64
static_assert(std::numeric_limits<Quad>::digits == 113);
#endif

}  // namespace crt::test
