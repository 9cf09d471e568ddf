#pragma once

#include <array>
#include <cstdint>

#include "crt/vec.hpp"

namespace crt::core {

enum class SurfaceKind : std::uint8_t { plane, sphere, cylinder, cone, torus };

/// The whole surface that a face is a piece of, in object space, by parameters that are bit-equal
/// when the surfaces are the same (canonical as far as doubles allow; see make_surface_key in
/// scene/ for how placements enter).
struct Surface {
  SurfaceKind kind = SurfaceKind::plane;
  Vec3 position{
      0, 0, 0};  ///< a point of the plane; the centre; a point of the axis (cone: the apex if there is one)
  Vec3 direction{0, 0, 0};            ///< the normal or axis, any length; 0 where there is none
  std::array<double, 2> sizes{0, 0};  ///< radii, thickness, or slope
};

}  // namespace crt::core
