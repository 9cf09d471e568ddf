// Parts that tests of measures ask for, and what intervals are to hold.
#pragma once

#include "support.hpp"

namespace crt::test {

inline bool holds(const crt_interval& interval, double truth) {
  return interval.lower <= truth && truth <= interval.upper;
}

/// Makes half of a torus about the y axis: what is in front of x = 0.
inline EntityHandle half_torus() {
  const Numbers center = {0, 0, 0};
  const Numbers axis = {0, 1, 0};
  const EntityHandle whole = made<EntityHandle>(
      [&](crt_entity** out) { return crt_torus_create(center.data(), axis.data(), 2, 0.5, out); });
  const EntityHandle back = box({-5, -5, -5}, {0, 5, 5});
  return difference(whole.get(), back.get());
}

}  // namespace crt::test
