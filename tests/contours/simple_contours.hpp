// Contours that tests are made of.
#pragma once

#include "crt/primitives.hpp"

namespace crt::test {

inline Contour rectangle(double left, double low, double right, double high) {
  return {{left, low}, {right, low}, {right, high}, {left, high}};
}

inline Contour circle(double x, double y, double radius) {
  return {{x + radius, y, 1}, {x - radius, y, 1}};
}

}  // namespace crt::test
