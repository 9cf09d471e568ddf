#include "core/geometry/cone/cone.hpp"

#include "core/geometry/checks.hpp"

namespace crt::core {

void validate(const Cone& cone) {
  check_coordinates("from", cone.from);
  check_coordinates("to", cone.to);
  check_end("to", cone.from, cone.to);
  check_radius("radius", cone.radius);
  check_radius_or_zero("radius2", cone.radius2);
}

std::unique_ptr<const Shape> make_shape(const Cone& cone) {
  return std::make_unique<ConeShape>(cone);
}

}  // namespace crt::core
