// From the public description of a primitive to its shape. Each primitive has overloads of
// validate(), is_solid() and make_shape(); the variant Primitive is the one list of them.
#include "core/geometry/shape.hpp"

#include "core/geometry/box/box.hpp"
#include "core/geometry/cone/cone.hpp"
#include "core/geometry/cylinder/cylinder.hpp"
#include "core/geometry/disc/disc.hpp"
#include "core/geometry/half_plane/half_plane.hpp"
#include "core/geometry/plane/plane.hpp"
#include "core/geometry/sphere/sphere.hpp"
#include "core/geometry/torus/torus.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "crt/validate.hpp"

namespace crt {

void validate(const Primitive& primitive) {
  core::validate(primitive);
}

namespace core {

void validate(const Primitive& primitive) {
  std::visit([](const auto& description) { validate(description); }, primitive);
}

bool is_solid(const Primitive& primitive) {
  return std::visit([](const auto& description) { return is_solid(description); }, primitive);
}

std::unique_ptr<const Shape> make_shape(const Primitive& primitive) {
  return std::visit([](const auto& description) { return make_shape(description); }, primitive);
}

}  // namespace core
}  // namespace crt
