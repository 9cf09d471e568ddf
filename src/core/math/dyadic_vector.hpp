// Vectors of exact numbers are added and multiplied without rounding.
#pragma once

#include <array>

#include "core/math/dyadic.hpp"
#include "crt/vec.hpp"

namespace crt::core {

using DyadicVector = std::array<Dyadic, 3>;

inline DyadicVector exactly(const Vec3& v) {
  return {v.x, v.y, v.z};
}

inline DyadicVector operator+(const DyadicVector& a, const DyadicVector& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

inline DyadicVector operator-(const DyadicVector& a, const DyadicVector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline DyadicVector operator*(const Dyadic& s, const DyadicVector& v) {
  return {s * v[0], s * v[1], s * v[2]};
}

inline Dyadic dot(const DyadicVector& a, const DyadicVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline DyadicVector cross(const DyadicVector& a, const DyadicVector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace crt::core
