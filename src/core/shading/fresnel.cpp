#include "core/shading/fresnel.hpp"

namespace crt::core {

namespace {

/// An Incidence is the angle of incidence.
template <class Real>
struct Incidence {
  Real cosine;
  Real squared_sine;
};

/// Returns the square of the cosine behind the boundary, below 0 under total internal reflection,
/// by Snell's law: c2^2 = 1 - (n1/n2)^2 s1^2. For indices that are close to each other it is
/// written so that nothing cancels at grazing incidence.
template <class Real>
Real squared_cosine_behind(const Incidence<Real>& incidence, const Real& n1, const Real& n2) {
  constexpr double far_apart = 1.5;
  const Real ratio = n1 / n2;
  const Real scaled = ratio * incidence.cosine;
  return select(ratio > far_apart, 1.0 - ratio * ratio * incidence.squared_sine,
                (n2 - n1) * (n2 + n1) / (n2 * n2) + scaled * scaled);
}

/// Returns the reflected share of light by Born and Wolf, Principles of Optics, 1.5.2. Both
/// amplitudes are rewritten so that indices close to each other do not cancel. With N = n1 c1 + n2
/// c2 they are
///  r_s = (n1^2 - n2^2) / N^2,   r_p = r_s (c1 c2 - s1 s2) / (c1 c2 + s1 s2).
template <class Real>
Real reflectance(const Incidence<Real>& incidence, const Real& c2, const Real& n1, const Real& n2) {
  const Real c1 = incidence.cosine;
  const Real sum = n1 * c1 + n2 * c2;
  const Real across = (n1 - n2) * (n1 + n2) / (sum * sum);
  const Real sines = n1 / n2 * incidence.squared_sine;
  const Real cosines = c1 * c2;
  const Real ratio = (cosines - sines) / (cosines + sines);
  const Real share = 0.5 * across * across * (1.0 + ratio * ratio);
  return select(share < 1.0, share, broadcast<Real>(1));
}

Vec3 direction_of(const Vec3& v) {
  return direction_and_length(v).direction;
}
VectorLanes direction_of(const VectorLanes& v) {
  VectorLanes directions;
  Lanes lengths;
  directions_and_lengths(v, directions, lengths);
  return directions;
}

}  // namespace

template <class Real>
Real fresnel_reflectance(const Real& cosine, const Real& n1, const Real& n2) {
  const Incidence<Real> incidence{cosine, (1.0 - cosine) * (1.0 + cosine)};
  const Real squared = squared_cosine_behind(incidence, n1, n2);
  const auto is_total = squared <= 0.0;
  const Real cosine_behind = sqrt(select(is_total, Real{}, squared));
  const Real share =
      select(is_total, broadcast<Real>(1), reflectance(incidence, cosine_behind, n1, n2));
  return select(n1 == n2, Real{}, share);
}

template <class Real>
Refraction<Real> refract(const Vec3Of<Real>& direction, const Vec3Of<Real>& normal, const Real& n1,
                         const Real& n2) {
  const Real against = -dot(direction, normal);
  const Real cosine =
      select(against > 1.0, broadcast<Real>(1), select(against < 0.0, Real{}, against));
  const Vec3Of<Real> along_boundary = direction + cosine * normal;
  const Incidence<Real> incidence{cosine, dot(along_boundary, along_boundary)};
  const Real squared = squared_cosine_behind(incidence, n1, n2);
  const auto is_total = squared <= 0.0;
  const Real cosine_behind = sqrt(select(is_total, Real{}, squared));
  const Vec3Of<Real> behind = n1 / n2 * along_boundary - cosine_behind * normal;

  const auto is_no_boundary = n1 == n2;
  const Real share =
      select(is_total, broadcast<Real>(1), reflectance(incidence, cosine_behind, n1, n2));
  const Vec3Of<Real> refracted = select(is_total, Vec3Of<Real>{}, direction_of(behind));
  return {.reflectance = select(is_no_boundary, Real{}, share),
          .direction = select(is_no_boundary, direction, refracted)};
}

template double fresnel_reflectance(const double&, const double&, const double&);
template Lanes fresnel_reflectance(const Lanes&, const Lanes&, const Lanes&);
template Refraction<double> refract(const Vec3&, const Vec3&, const double&, const double&);
template Refraction<Lanes> refract(const VectorLanes&, const VectorLanes&, const Lanes&,
                                   const Lanes&);

}  // namespace crt::core
