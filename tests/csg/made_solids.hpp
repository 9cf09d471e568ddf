// Tests of solids that are made of others share these.
#pragma once

#include <doctest/doctest.h>

#include <string>

#include "crt/entity.hpp"
#include "crt/error.hpp"
#include "crt/measure.hpp"

namespace crt::test {

/// Returns what is said of a solid that can't be made, or nothing.
template <class Solid>
std::string fault_of(const Solid& solid) {
  try {
    static_cast<void>(Entity(solid));
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

/// Checks a volume to 1e-6 against the truth, which is known to rounding.
inline void check_volume(const Entity& entity, double truth) {
  const Interval found = volume(entity, {.relative_width = 1e-6});
  CHECK(found.lower <= truth * (1 + 1e-12));
  CHECK(found.upper >= truth * (1 - 1e-12));
  CHECK(found.width() <= 1e-6 * truth);
}

}  // namespace crt::test
