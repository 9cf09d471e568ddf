// A picture is laid over a surface by what is known of the place in space.
#pragma once

#include "core/geometry/shape.hpp"
#include "crt/pattern.hpp"

namespace crt::core {

/// PictureCoordinates are a place in a picture: 0 to 1 from left to right, and from bottom to top.
struct PictureCoordinates {
  double u = 0;
  double v = 0;
};

/// Returns where a point of a surface is in the picture, by a mapping other than uv. The map's
/// direction has length 1.
PictureCoordinates mapped(const ImageMap& map, const SurfacePoint& point);

}  // namespace crt::core
