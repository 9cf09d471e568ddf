// Some primitives have no oracle here.
#pragma once

#include <concepts>
#include <stdexcept>

#include "crt/primitives.hpp"

namespace crt::test {

/// Holds for primitives that have no oracle: a field has no equations but its own, and a custom
/// shape is what a program says. The promises about them are others.
/// tests/geometry/implicit_test.cpp and custom_test.cpp compare them with other primitives.
template <class P>
concept WithoutOracle = std::same_as<P, Implicit> || std::same_as<P, Custom>;

/// Is called for primitives that have no oracle, which none of these tests makes.
[[noreturn]] inline void has_no_oracle() {
  throw std::logic_error("this primitive has no oracle");
}

}  // namespace crt::test
