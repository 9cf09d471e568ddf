#include "core/shading/fresnel.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/unit_vector.hpp"

namespace crt::core {

namespace {

/// The square of the cosine behind the boundary, below 0 under total internal reflection. Snell's
/// law is 1 - c2^2 = (n1/n2)^2 (1 - c1^2); written so that nothing cancels at grazing incidence.
double squared_cosine_behind(double cosine, double n1, double n2) {
  const double scaled = n1 / n2 * cosine;
  return (n2 - n1) * (n2 + n1) / (n2 * n2) + scaled * scaled;
}

/// Born and Wolf, Principles of Optics, 1.5.2, with both amplitudes rewritten so that indices close
/// to each other do not cancel: with N = n1 c1 + n2 c2,
///   r_s = (n1^2 - n2^2) / N^2,   r_p = r_s (c1 c2 - s1 s2) / (c1 c2 + s1 s2).
double reflectance(double c1, double c2, double n1, double n2) {
  const double sum = n1 * c1 + n2 * c2;
  const double across = (n1 - n2) * (n1 + n2) / (sum * sum);
  const double sines = n1 / n2 * (1 - c1) * (1 + c1);
  const double cosines = c1 * c2;
  const double ratio = (cosines - sines) / (cosines + sines);
  return std::min(1.0, 0.5 * across * across * (1 + ratio * ratio));
}

}  // namespace

double fresnel_reflectance(double cosine, double n1, double n2) {
  if (n1 == n2) return 0;
  const double squared = squared_cosine_behind(cosine, n1, n2);
  if (squared <= 0) return 1;
  return reflectance(cosine, std::sqrt(squared), n1, n2);
}

Refraction refract(const Vec3& direction, const Vec3& normal, double n1, double n2) {
  if (n1 == n2) return {0, direction};
  const double cosine = std::clamp(-glm::dot(direction, normal), 0.0, 1.0);
  const double squared = squared_cosine_behind(cosine, n1, n2);
  if (squared <= 0) return {1, Vec3(0)};
  const double cosine_behind = std::sqrt(squared);
  const Vec3 along_boundary = direction + cosine * normal;
  const Vec3 behind = n1 / n2 * along_boundary - cosine_behind * normal;
  return {reflectance(cosine, cosine_behind, n1, n2), direction_and_length(behind).direction};
}

}  // namespace crt::core
