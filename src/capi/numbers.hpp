// Numbers, colours and pictures of C become those of C++, and back.
#pragma once

#include <memory>

#include "capi/guard.hpp"
#include "capi/handles.hpp"
#include "crt/color.hpp"
#include "crt/image.hpp"
#include "crt/vec.hpp"

namespace crt::capi {

inline Color to_color(const double (&rgb)[3], double alpha = 1) {
  return {rgb[0], rgb[1], rgb[2], alpha};
}

inline Vec3 to_vec3(const double (&numbers)[3]) {
  return {numbers[0], numbers[1], numbers[2]};
}

inline void put(double (&out)[3], const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) out[axis] = v[axis];
}

inline void put(double (&out)[3], const Color& color) {
  out[0] = color.r;
  out[1] = color.g;
  out[2] = color.b;
}

inline std::shared_ptr<const Image> to_image(const crt_image* image, const char* argument) {
  require(image, argument);
  return image->value;
}

}  // namespace crt::capi
