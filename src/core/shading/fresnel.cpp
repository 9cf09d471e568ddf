#include "core/shading/fresnel.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/direction_and_length.hpp"

namespace crt::core {

namespace {

/// The angle of incidence.
struct Incidence {
  double cosine = 1;
  double squared_sine = 0;
};

/// The square of the cosine behind the boundary, below 0 under total internal reflection, by Snell's
/// law: c2^2 = 1 - (n1/n2)^2 s1^2. For indices that are not far apart it is written so that nothing
/// cancels at grazing incidence.
double squared_cosine_behind(const Incidence& incidence, double n1, double n2) {
  constexpr double far_apart = 1.5;
  const double ratio = n1 / n2;
  if (ratio > far_apart) return 1 - ratio * ratio * incidence.squared_sine;
  const double scaled = ratio * incidence.cosine;
  return (n2 - n1) * (n2 + n1) / (n2 * n2) + scaled * scaled;
}

/// Born and Wolf, Principles of Optics, 1.5.2, with both amplitudes rewritten so that indices close
/// to each other do not cancel: with N = n1 c1 + n2 c2,
///   r_s = (n1^2 - n2^2) / N^2,   r_p = r_s (c1 c2 - s1 s2) / (c1 c2 + s1 s2).
double reflectance(const Incidence& incidence, double c2, double n1, double n2) {
  const double c1 = incidence.cosine;
  const double sum = n1 * c1 + n2 * c2;
  const double across = (n1 - n2) * (n1 + n2) / (sum * sum);
  const double sines = n1 / n2 * incidence.squared_sine;
  const double cosines = c1 * c2;
  const double ratio = (cosines - sines) / (cosines + sines);
  return std::min(1.0, 0.5 * across * across * (1 + ratio * ratio));
}

}  // namespace

double fresnel_reflectance(double cosine, double n1, double n2) {
  if (n1 == n2) return 0;
  const Incidence incidence{cosine, (1 - cosine) * (1 + cosine)};
  const double squared = squared_cosine_behind(incidence, n1, n2);
  if (squared <= 0) return 1;
  return reflectance(incidence, std::sqrt(squared), n1, n2);
}

Refraction refract(const Vec3& direction, const Vec3& normal, double n1, double n2) {
  if (n1 == n2) return {0, direction};
  const double cosine = std::clamp(-glm::dot(direction, normal), 0.0, 1.0);
  const Vec3 along_boundary = direction + cosine * normal;
  const Incidence incidence{cosine, glm::dot(along_boundary, along_boundary)};
  const double squared = squared_cosine_behind(incidence, n1, n2);
  if (squared <= 0) return {1, Vec3(0)};
  const double cosine_behind = std::sqrt(squared);
  const Vec3 behind = n1 / n2 * along_boundary - cosine_behind * normal;
  return {reflectance(incidence, cosine_behind, n1, n2), direction_and_length(behind).direction};
}

}  // namespace crt::core
