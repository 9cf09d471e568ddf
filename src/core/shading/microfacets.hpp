// Rough surfaces consist of mirrors too small to be seen, the microfacets. Their normals follow the
// GGX distribution, and one formula serves a direction or lanes.
//
// Sources: Walter, Marschner, Li, Torrance, Microfacet models for refraction through rough
// surfaces, EGSR 2007 (the distribution, transmission). Heitz, Understanding the masking-shadowing
// function in microfacet-based BRDFs, JCGT 3(2), 2014 (heights that correlate). Heitz, Sampling the
// GGX distribution of visible normals, JCGT 7(4), 2018.
//
// Notation: directions are in a frame whose z is the normal. o goes to the viewer, i to the light,
// and h is the normal of a microfacet. alpha is the width of the distribution.
#pragma once

#include <numbers>

#include "core/geometry/angles.hpp"
#include "core/math/vector_lanes.hpp"

namespace crt::core {

/// A NormalFrame has unit vectors that make a frame with a normal.
template <class Real>
struct NormalFrame {
  Vec3Of<Real> x;
  Vec3Of<Real> y;
  Vec3Of<Real> z;

  /// Makes the frame of a unit normal without a branch. Source: Duff and others, Building an
  /// orthonormal basis, revisited, JCGT 6(1), 2017.
  explicit NormalFrame(const Vec3Of<Real>& normal) : z(normal) {
    const Real sign = select(normal.z < 0.0, broadcast<Real>(-1), broadcast<Real>(1));
    const Real a = -1.0 / (sign + normal.z);
    const Real b = normal.x * normal.y * a;
    x = {1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    y = {b, sign + normal.y * normal.y * a, -normal.y};
  }

  Vec3Of<Real> to_frame(const Vec3Of<Real>& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3Of<Real> to_world(const Vec3Of<Real>& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Returns the square of the distance from the normal.
template <class Vector>
auto squared_offset(const Vector& v) {
  return v.x * v.x + v.y * v.y;
}

/// Returns v at unit length. v is neither 0 nor near to what doubles can hold.
template <class Real>
Vec3Of<Real> of_unit_length(const Vec3Of<Real>& v) {
  return Real(1.0 / sqrt(dot(v, v))) * v;
}

/// Microfacets are those of surfaces with these widths.
template <class Real>
struct Microfacets {
  Real alpha{};

  /// Returns the density of normals: D(h).
  Real density(const Vec3Of<Real>& h) const {
    const Real square = alpha * alpha;
    const Real spread = squared_offset(h) + square * h.z * h.z;
    return square / (std::numbers::pi * spread * spread);
  }

  /// Returns |w.z| sqrt(1 + alpha^2 tan^2) of a direction w, from which all shares that microfacets
  /// hide of each other follow. It has no quotient that grazing directions make infinite.
  Real reach(const Vec3Of<Real>& w) const {
    return sqrt(Real(w.z * w.z + alpha * alpha * squared_offset(w)));
  }

  /// Returns the share of microfacets that a direction sees, G1.
  Real seen(const Vec3Of<Real>& w) const {
    constexpr double least = 1e-300;  // of a direction along a smooth surface
    const Real height = abs(w.z);
    return 2.0 * height / max(broadcast<Real>(least), Real(height + reach(w)));
  }

  /// Returns G2 / (4 o.z i.z), for directions on one side.
  Real visibility(const Vec3Of<Real>& o, const Vec3Of<Real>& i) const {
    return 0.5 / (i.z * reach(o) + o.z * reach(i));
  }

  /// Returns G2 / G1(o): what is left of light that a microfacet visible from o mirrors to i.
  Real mirrored_share(const Vec3Of<Real>& o, const Vec3Of<Real>& i) const {
    const Real reach_of_o = reach(o);
    return i.z * (o.z + reach_of_o) / (i.z * reach_of_o + o.z * reach(i));
  }

  /// Returns the density of normals that are visible from o, by solid angle of h.
  Real visible_density(const Vec3Of<Real>& o, const Vec3Of<Real>& h) const {
    return 2.0 * density(h) * dot(o, h) / (o.z + reach(o));
  }

  /// Returns a normal that is visible from o, for a point of the unit disc. Equal areas of the disc
  /// are equally likely.
  Vec3Of<Real> visible_normal(const Vec3Of<Real>& o, const PlanePointOf<Real>& in_disc) const {
    const Vec3Of<Real> stretched = of_unit_length<Real>({alpha * o.x, alpha * o.y, o.z});
    const Real squared = squared_offset(stretched);
    const auto is_upright = squared <= 0.0;
    const Real inverse = 1.0 / sqrt(select(is_upright, broadcast<Real>(1), squared));
    const Vec3Of<Real> across = {select(is_upright, broadcast<Real>(1), -stretched.y * inverse),
                                 stretched.x * inverse, Real{}};
    const Vec3Of<Real> along = cross(stretched, across);
    const Real& a = in_disc.x;
    const Real widest = sqrt(max(Real{}, Real(1.0 - a * a)));
    const Real lower = 0.5 * (1.0 + stretched.z);
    const Real b = (1.0 - lower) * widest + lower * in_disc.y;
    const Real c = sqrt(max(Real{}, Real(1.0 - a * a - b * b)));
    const Vec3Of<Real> h = a * across + b * along + c * stretched;
    // The disc's rim may be rounded below the horizon.
    return of_unit_length<Real>({alpha * h.x, alpha * h.y, max(broadcast<Real>(1e-100), h.z)});
  }
};

/// Returns Schlick's approximation of a metal's Fresnel reflectance: its colour straight on, and 1
/// at grazing angles. Source: Schlick, An inexpensive BRDF model for physically-based rendering,
/// Computer Graphics Forum 13(3), 1994.
template <class Real>
Vec3Of<Real> metal_reflectance(const Vec3Of<Real>& color, const Real& cosine) {
  const Real rest = max(Real{}, Real(1.0 - cosine));
  const Real square = rest * rest;
  const Real grazing = square * square * rest;
  return (1.0 - grazing) * color + grazing * broadcast<Real>(Vec3(1));
}

/// Returns what fibres of cloth send from i to o, per cosine: the cube of the sine as density of
/// normals, and a smooth term for what fibres hide. Sources: Estevez, Kulla, Production friendly
/// microfacet sheen BRDF, SIGGRAPH 2017 (the density, of roughness 1/3). Neubelt, Pettineo,
/// Crafting a next-gen material pipeline for The Order: 1886, SIGGRAPH 2013 (the term).
template <class Real>
Real fibres(const Vec3Of<Real>& o, const Vec3Of<Real>& i) {
  const Vec3Of<Real> h = of_unit_length<Real>(o + i);
  const Real squared_sine = squared_offset(h);
  constexpr double peak = 2.5 / std::numbers::pi;
  const Real density = peak * squared_sine * sqrt(squared_sine);
  return density / (4.0 * (o.z + i.z - o.z * i.z));
}

}  // namespace crt::core
