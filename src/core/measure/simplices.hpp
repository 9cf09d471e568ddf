// A cube is cut by planes into tetrahedra, and each plane's part in it into triangles. Moments of
// what is left follow from those of the simplices.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "crt/vec.hpp"

namespace crt::core {

/// A Simplex has the corners of a tetrahedron or of a triangle.
template <std::size_t corners>
using Simplex = std::array<Vec3, corners>;
using Tetrahedron = Simplex<4>;
using FlatTriangle = Simplex<3>;

/// A LinearFunction is value + slope . x.
struct LinearFunction {
  double value = 0;
  Vec3 slope{0, 0, 0};

  double at(const Vec3& x) const;
};

/// Returns the cube from -1 to 1 along each axis as tetrahedra.
std::span<const Tetrahedron> cube();

/// Appends the parts of a simplex where a function is below 0, and those where it is not.
void cut(const Tetrahedron& simplex, const LinearFunction& function,
         std::vector<Tetrahedron>& below, std::vector<Tetrahedron>& above);
void cut(const FlatTriangle& simplex, const LinearFunction& function,
         std::vector<FlatTriangle>& below, std::vector<FlatTriangle>& above);
/// Appends the part of the plane of a function that is in a tetrahedron.
void cut_plane(const Tetrahedron& simplex, const LinearFunction& function,
               std::vector<FlatTriangle>& plane);

/// Moments are the volume of a body, the integrals of x, y, z, and those of x x, y y, z z, x y,
/// y z, z x.
struct BodyMoments {
  double volume = 0;
  Vec3 first{0, 0, 0};
  std::array<double, 6> second{};

  void add(const Tetrahedron& body);
};

/// Returns a vector across a triangle, of twice its area's length.
Vec3 double_area(const FlatTriangle& triangle);

}  // namespace crt::core
