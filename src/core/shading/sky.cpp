#include "core/shading/sky.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>

#include "core/math/direction_and_length.hpp"
#include "core/math/power.hpp"
#include "core/math/quick_angle.hpp"

namespace crt::core {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double degrees = 180 / pi;

/// A colour of 1 is this luminance, in kcd/m^2: that of a white level surface under a sun in the
/// zenith at turbidity 3, which gets 92 klx of the sun and 40 klx of the sky.
constexpr double unit = 42;

/// Directions count as at least this high, so that all is finite. The formula is flat down there.
constexpr double least_height = 1e-3;

/// Returns the linear sRGB of a luminance with a chromaticity (IEC 61966-2-1). Colours beyond what
/// can be mixed are clamped at 0.
VectorLanes linear_srgb(const Lanes& luminance, const Lanes& x, const Lanes& y) {
  constexpr double least = 1e-3;
  const Lanes per_y = luminance / max(y, lanes_of(least));
  const Lanes x_stimulus = x * per_y;
  const Lanes z_stimulus = (1.0 - x - y) * per_y;
  const Lanes none{};
  return {max(none, 3.2406 * x_stimulus - 1.5372 * luminance - 0.4986 * z_stimulus),
          max(none, -0.9689 * x_stimulus + 1.8758 * luminance + 0.0415 * z_stimulus),
          max(none, 0.0557 * x_stimulus - 0.2040 * luminance + 1.0570 * z_stimulus)};
}

/// Returns the paper's polynomial for a chromaticity in the zenith. Rows are of T^2, T and 1, with
/// the coefficients of the third power of the sun's angle first.
double zenith_chromaticity(const std::array<std::array<double, 4>, 3>& rows, double turbidity,
                           double angle) {
  double sum = 0;
  for (const auto& row : rows) {
    const double of_angle = ((row[0] * angle + row[1]) * angle + row[2]) * angle + row[3];
    sum = sum * turbidity + of_angle;
  }
  return sum;
}

/// Returns what the sun gives a surface that faces it, in klx of each channel, seen at an angle
/// from the zenith of up to pi / 2.
///
/// The sun is 128 klx above the air, and has the colour of a black body of 5778 K. Of what the
/// paper's appendix A.1 takes of it, Rayleigh's scattering, Angstrom's aerosol and ozone (0.35 cm)
/// count, each at one wavelength for a channel. The air's mass is that of Kasten 1965.
Rgb sunlight_below_air(double turbidity, double angle) {
  constexpr std::array<double, 3> above_air = {128 * 1.113, 128 * 0.975, 128 * 0.914};
  constexpr std::array<double, 3> wavelengths = {0.610, 0.550, 0.465};  // micrometres
  constexpr std::array<double, 3> ozone = {0.120, 0.085, 0.008};        // per cm
  const double mass =
      1 / (elementary::cos(angle) + 0.15 * elementary::pow(93.885 - angle * degrees, -1.253));
  const double aerosol = 0.04608 * turbidity - 0.04586;
  Rgb result;
  for (int i = 0; i < 3; ++i) {
    const auto channel = static_cast<std::size_t>(i);
    const double wavelength = wavelengths[channel];
    const double depth = 0.008735 * elementary::pow(wavelength, -4.08) +
                         aerosol * elementary::pow(wavelength, -1.3) + 0.35 * ozone[channel];
    result[i] = above_air[channel] * elementary::exp(-depth * mass);
  }
  return result;
}

/// Returns how much light of the dome is left when the sun is below the horizon, where the paper
/// ends. Twilight gets darker by about a factor of ten every 2.5 degrees.
double twilight(double altitude) {
  constexpr double per_degree = 0.4;
  return elementary::pow(10, per_degree * degrees * std::min(0.0, altitude));
}

}  // namespace

Sky::Sky(const SkyBackground& background)
    : to_sun_(direction_and_length(background.sun).direction), scale_(background.scale / unit) {
  const double turbidity = background.turbidity;
  const double altitude = elementary::asin(std::clamp(to_sun_.y, -1.0, 1.0));
  const double angle = std::clamp(pi / 2 - altitude, 0.0, pi / 2);
  const double share = std::clamp(0.5 + altitude / sun_angle, 0.0, 1.0);  // of the disc that is up
  sun_light_ = share * scale_ / pi * sunlight_below_air(turbidity, angle);
  const double sine = elementary::sin(sun_angle / 2);
  sun_disc_ = sun_light_ / (sine * sine);
  rim_ = 2 * elementary::sin(sun_angle / 4);

  const double chi = (4.0 / 9 - turbidity / 120) * (pi - 2 * angle);
  const double luminance =
      (4.0453 * turbidity - 4.9710) * elementary::tan(chi) - 0.2155 * turbidity + 2.4192;
  const auto coefficients = [turbidity](const std::array<std::array<double, 2>, 5>& lines) {
    std::array<double, 5> result;
    for (std::size_t i = 0; i < lines.size(); ++i)
      result[i] = lines[i][0] * turbidity + lines[i][1];
    return result;
  };
  luminance_ = part(coefficients({{{0.1787, -1.4630},
                                   {-0.3554, 0.4275},
                                   {-0.0227, 5.3251},
                                   {0.1206, -2.5771},
                                   {-0.0670, 0.3703}}}),
                    luminance * scale_ * twilight(altitude), angle);
  x_ = part(coefficients({{{-0.0193, -0.2592},
                           {-0.0665, 0.0008},
                           {-0.0004, 0.2125},
                           {-0.0641, -0.8989},
                           {-0.0033, 0.0452}}}),
            zenith_chromaticity({{{0.00166, -0.00375, 0.00209, 0},
                                  {-0.02903, 0.06377, -0.03202, 0.00394},
                                  {0.11693, -0.21196, 0.06052, 0.25886}}},
                                turbidity, angle),
            angle);
  y_ = part(coefficients({{{-0.0167, -0.2608},
                           {-0.0950, 0.0092},
                           {-0.0079, 0.2102},
                           {-0.0441, -1.6537},
                           {-0.0109, 0.0529}}}),
            zenith_chromaticity({{{0.00275, -0.00610, 0.00317, 0},
                                  {-0.04214, 0.08970, -0.04153, 0.00516},
                                  {0.15346, -0.26756, 0.06670, 0.26688}}},
                                turbidity, angle),
            angle);
  const double falling = std::max(0.0, to_sun_.y);
  ground_ = rgb(background.ground) * (dome_on_level() + falling * sun_light_);
}

Lanes Sky::Part::operator()(const Lanes& per_height, const Lanes& angle,
                            const Lanes& cosine) const {
  const auto& [a, b, c, d, e] = coefficients;
  const Lanes of_height = 1.0 + a * exponential2<Lanes>(b * per_height);
  const Lanes of_angle = 1.0 + c * exponential2<Lanes>(d * angle) + e * cosine * cosine;
  return zenith * (of_height * of_angle);
}

Sky::Part Sky::part(const std::array<double, 5>& coefficients, double zenith, double sun_angle) {
  Part result{.zenith = 1, .coefficients = coefficients};
  result.coefficients[1] *= std::numbers::log2e;
  result.coefficients[3] *= std::numbers::log2e;
  const Lanes there =
      result(lanes_of(1), lanes_of(sun_angle), lanes_of(elementary::cos(sun_angle)));
  result.zenith = zenith / there[0];
  return result;
}

VectorLanes Sky::dome(const VectorLanes& directions) const {
  const VectorLanes sun = lanes_of(to_sun_);
  const VectorLanes across = directions - sun;
  const VectorLanes along = directions + sun;
  const Lanes angle = 2.0 * quick_atan2<Lanes>(sqrt(dot(across, across)), sqrt(dot(along, along)));
  const Lanes cosine = dot(directions, sun);
  const Lanes per_height = 1.0 / max(directions.y, lanes_of(least_height));
  return linear_srgb(luminance_(per_height, angle, cosine), x_(per_height, angle, cosine),
                     y_(per_height, angle, cosine));
}

VectorLanes Sky::light(const VectorLanes& directions) const {
  return select(directions.y > 0.0, dome(directions), lanes_of(ground_));
}

VectorLanes Sky::sun(const VectorLanes& directions) const {
  const VectorLanes across = directions - lanes_of(to_sun_);
  const LaneMask in_disc = dot(across, across) < rim_ * rim_ && directions.y > 0.0;
  return select(in_disc, lanes_of(sun_disc_), VectorLanes{});
}

ParallelLight Sky::sunlight() const {
  return {.from = to_sun_,
          .pointing = {0, 0, 0},
          .color = {sun_light_.x, sun_light_.y, sun_light_.z},
          .angle = sun_angle};
}

std::pair<Vec3, Vec3> Sky::level_axes() const {
  const double level = std::sqrt(to_sun_.x * to_sun_.x + to_sun_.z * to_sun_.z);
  const Vec3 along = level > 0 ? Vec3(to_sun_.x / level, 0, to_sun_.z / level) : Vec3(1, 0, 0);
  return {along, {-along.z, 0, along.x}};
}

Rgb Sky::dome_on_level() const {
  // It is the mean over the disc below the dome, which is halved by the plane of the sun. Rings of
  // equal area (Archimedes) are cut into equal pieces.
  constexpr int rings = 64;
  constexpr int pieces = 64;
  const auto [along, across] = level_axes();
  VectorLanes sum;
  for (int ring = 0; ring < rings; ++ring) {
    const double squared_radius = (ring + 0.5) / rings;
    const double radius = std::sqrt(squared_radius);
    const Vec3 up(0, std::sqrt(1 - squared_radius), 0);
    for (int piece = 0; piece < pieces; piece += static_cast<int>(lane_count)) {
      VectorLanes directions;
      for (std::size_t lane = 0; lane < lane_count; ++lane) {
        const double turn = pi * (piece + static_cast<double>(lane) + 0.5) / pieces;
        directions.set(
            lane, up + radius * (elementary::cos(turn) * along + elementary::sin(turn) * across));
      }
      sum = sum + dome(directions);
    }
  }
  const Rgb whole = sum.lane(0) + sum.lane(1) + sum.lane(2) + sum.lane(3);
  return whole / static_cast<double>(rings * pieces);
}

double Sky::brightest() const {
  // The dome is brightest somewhere above or below the sun, and changes slowly there.
  constexpr std::size_t places = 1024;
  const auto [along, across] = level_axes();
  VectorLanes most = lanes_of(ground_);
  for (std::size_t place = 0; place < places; place += lane_count) {
    VectorLanes directions;
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const double angle = pi / 2 * static_cast<double>(place + lane) / (places - 1);
      directions.set(lane, elementary::cos(angle) * along + elementary::sin(angle) * Vec3(0, 1, 0));
    }
    most = max(most, dome(directions));
  }
  double result = 0;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    result = std::max(result, largest_component(most.lane(lane)));
  return result + largest_component(sun_disc_);
}

}  // namespace crt::core
