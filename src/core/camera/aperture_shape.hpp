// Each aperture shape is a function from the unit square to the points of the lens opening. All but
// the gaussian keep areas: equal parts of the square go to equal parts of the shape.
#pragma once

#include "core/math/plane_point.hpp"
#include "crt/camera.hpp"

namespace crt::core {

/// A LensPoint is a point of the lens in units of its radius, x to the picture's right and y to its
/// top.
using LensPoint = PlanePoint;
using LensPointLanes = PlanePointLanes;

// Each function takes two numbers in [0, 1).

/// Returns point_of_disc(). Neighbours stay neighbours, so stratified numbers give a stratified
/// lens.
LensPoint circle_point(double u, double v);

/// Returns a point of the whole square [-1, 1]^2.
LensPoint uniform_point(double u, double v);

/// Returns a point of a normal distribution of standard deviation 1/2 in x and in y, cut off at
/// distance 2.
LensPoint gaussian_point(double u, double v);

/// This and the next three have regular polygons with their corners on the unit circle, one of them
/// at the top.
LensPoint triangle_point(double u, double v);
LensPoint pentagon_point(double u, double v);
LensPoint hexagon_point(double u, double v);
LensPoint octagon_point(double u, double v);

/// Returns a point of the square with its corners on the unit circle and its sides aligned with the
/// picture.
LensPoint square_point(double u, double v);

/// Returns a point of the horizontal line from -1 to 1. The second number has no effect.
LensPoint line_point(double u, double v);

/// Returns a point of the given shape.
LensPoint aperture_point(ApertureShape shape, double u, double v);

/// Returns a point for each pair of numbers side by side.
LensPointLanes aperture_points(ApertureShape shape, const Lanes& u, const Lanes& v);

}  // namespace crt::core
