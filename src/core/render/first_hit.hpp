// First hits are what camera rays meet first. AOVs report them beside the pixels' colours.
#pragma once

#include <cstdint>
#include <limits>

#include "core/shading/rgb.hpp"
#include "crt/render.hpp"

namespace crt::core {

/// A FirstHit says how a surface looks. All is 0 where there is none. A pixel has the mean over its
/// samples.
struct FirstHit {
  Vec3 normal{0, 0, 0};  ///< world, unit length, turned to the viewer and tilted by bumps
  Rgb color{0, 0, 0};    ///< the material's
  double cover = 0;      ///< 1 where there is a surface
  double nearness = 0;   ///< 1 / the distance from the ray's origin, in the world

  void add(const FirstHit& other) {
    normal += other.normal;
    color += other.color;
    cover += other.cover;
    nearness += other.nearness;
  }
  void divide(std::int64_t count) {
    const auto divisor = static_cast<double>(count);
    *this = {normal / divisor, color / divisor, cover / divisor, nearness / divisor};
  }
};

/// A FirstPlace says where a surface is, and whose. A pixel has that of the ray through its middle.
struct FirstPlace {
  double distance =
      std::numeric_limits<double>::infinity();  ///< from the ray's origin, in the world
  std::uint32_t entity_id = no_entity_id;
  std::uint32_t part_id = no_entity_id;
};

}  // namespace crt::core
