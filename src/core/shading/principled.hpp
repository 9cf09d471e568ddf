// Principled surfaces: what they scatter, for one point or for as many side by side as there are
// lanes. One formula serves both.
//
// A surface is a mixture of a metal, of a dielectric with a diffuse body, and of one that lets
// light through. A coat lies on it, and sheen on that. Metals and dielectrics mirror by microfacets
// (microfacets.hpp), each layer gets what those above leave to it, and what single microfacets lose
// is scattered evenly (layer_shares.hpp). So a white surface sends back all light.
//
// Light is measured as radiance divided by the square of the refractive index, as the rest of the
// renderer does: what a surface lets through into a viewer's eye does not depend on the index
// there.
//
// Notation: directions are unit length and lead away from the surface. n . to_viewer > 0. A
// direction to a light on the side of the viewer is mirrored, and another is let through.
//
// Tests: tests/shading/principled_test.cpp, principled_samples_test.cpp
#pragma once

#include <array>

#include "core/math/vector_lanes.hpp"
#include "core/shading/layer_shares.hpp"

namespace crt::core {

inline constexpr double coat_index = 1.5;  ///< refractive index of a coat

/// Returns the width of the distribution of microfacets, alpha. What is less rough than a
/// thousandth is smooth: a mirror or clear glass.
template <class Real>
Real width_of(const Real& roughness) {
  constexpr double smooth = 1e-3;
  return select(roughness < smooth, Real{}, roughness * roughness);
}

/// Says whether light goes straight through a boundary: the index behind it is that before it.
template <class Real>
auto is_straight(const Real& relative_index) {
  constexpr double indistinguishable = 1e-6;
  return abs(Real(relative_index - 1.0)) < indistinguishable;
}

/// A PrincipledSurface has points of as many surfaces as a Real has lanes. The shares are in [0,
/// 1].
template <class Real>
struct PrincipledSurface {
  Vec3Of<Real> color;
  Real metallic{};
  Real roughness{};
  Real relative_index{};  ///< of what is behind the surface, by that of what is before it
  Real transmission{};
  /// These three are 0 for a viewer who is inside.
  Real coat{};
  Real coat_roughness{};
  Real sheen{};
  /// These are the tables of both sides. A lane without has no surface, and scatters nothing.
  std::array<const SharesTable*, lanes_in<Real>> before{};
  std::array<const SharesTable*, lanes_in<Real>> behind{};
};

/// Scattering is what a surface does with light from a direction.
template <class Real>
struct Scattering {
  /// This is the share of the light's radiance that goes to the viewer, per solid angle, times the
  /// cosine.
  Vec3Of<Real> value;
  Vec3Of<Real>
      body;        ///< the part of it that the diffuse body sends back, which sample() leaves out
  Real density{};  ///< of sample(), by solid angle
};

/// Returns what surfaces scatter of light from directions, but for perfect mirrors and clear glass.
template <class Real>
Scattering<Real> evaluate(const PrincipledSurface<Real>& surface, const Vec3Of<Real>& to_viewer,
                          const Vec3Of<Real>& normal, const Vec3Of<Real>& to_light);

/// A ScatteredRay is one that continues a path backwards.
template <class Real>
struct ScatteredRay {
  Vec3Of<Real> direction;
  Vec3Of<Real> weight;  ///< what the light from there is multiplied by, 0 if the path ends
  /// This is the density by solid angle that evaluate() tells, and 0 of what is_delta.
  Real density{};
  MaskOf<Real> is_delta{};        ///< of a perfect mirror or clear glass: no other direction counts
  MaskOf<Real> is_transmitted{};  ///< goes on behind the surface
};

/// Picks a direction that light may come from other than by the diffuse body, by three numbers in
/// [0, 1).
template <class Real>
ScatteredRay<Real> sample(const PrincipledSurface<Real>& surface, const Vec3Of<Real>& to_viewer,
                          const Vec3Of<Real>& normal, const std::array<Real, 3>& numbers);

}  // namespace crt::core
