// Computations use colours of three channels of linear light.
#pragma once

#include <algorithm>

#include "core/math/vector_lanes.hpp"
#include "crt/color.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// Rgb is red, green, blue. The vector's operators act on each channel.
using Rgb = Vec3;

inline Rgb rgb(const Color& color) {
  return {color.r, color.g, color.b};
}

inline bool is_black(const Rgb& light) {
  return light.x == 0 && light.y == 0 && light.z == 0;
}
inline LaneMask is_black(const VectorLanes& light) {
  return (light.x == 0.0) & (light.y == 0.0) & (light.z == 0.0);
}

inline double brightest_channel(const Color& color) {
  return std::max({color.r, color.g, color.b});
}

/// Shares of light are kept below this bound. The bound times all that lights and surfaces may add
/// is finite, however many surfaces brighten what they let through.
inline constexpr double largest_share = 0x1p100;

/// Returns a share of light, kept within its bound.
inline Rgb bounded_share(const Rgb& share) {
  return {std::min(share.x, largest_share), std::min(share.y, largest_share),
          std::min(share.z, largest_share)};
}
inline VectorLanes bounded_share(const VectorLanes& share) {
  const Lanes bound = lanes_of(largest_share);
  return {min(share.x, bound), min(share.y, bound), min(share.z, bound)};
}

/// Returns how bright a colour looks, by the weights of Rec. ITU-R BT.709, item 3.2.
inline double luminance(const Color& color) {
  return 0.2126 * color.r + 0.7152 * color.g + 0.0722 * color.b;
}

inline Lanes luminances(const VectorLanes& color) {
  return 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
}

/// Interpolates from a (share 0) to b (share 1), in every channel and alpha.
inline Color mix(const Color& a, const Color& b, double share) {
  return {a.r + share * (b.r - a.r), a.g + share * (b.g - a.g), a.b + share * (b.b - a.b),
          a.a + share * (b.a - a.a)};
}

/// ColorLanes are as many colours as there are lanes.
struct ColorLanes {
  VectorLanes color;
  Lanes alpha{};

  void set(std::size_t lane, const Color& one) {
    color.set(lane, rgb(one));
    alpha[lane] = one.a;
  }
  Color lane(std::size_t index) const {
    return {color.x[index], color.y[index], color.z[index], alpha[index]};
  }
};

inline ColorLanes lanes_of(const Color& color) {
  return {lanes_of(rgb(color)), lanes_of(color.a)};
}

/// Interpolates from a (share 0) to b (share 1), in every channel and alpha.
inline ColorLanes mix(const ColorLanes& a, const ColorLanes& b, const Lanes& share) {
  return {a.color + share * (b.color - a.color), a.alpha + share * (b.alpha - a.alpha)};
}

inline ColorLanes select(const LaneMask& first, const ColorLanes& a, const ColorLanes& b) {
  return {select(first, a.color, b.color), select(first, a.alpha, b.alpha)};
}

}  // namespace crt::core
