#include "core/geometry/cylinder/cylinder.hpp"

#include "core/geometry/checks.hpp"

namespace crt::core {

void validate(const Cylinder& cylinder) {
  check_coordinates("from", cylinder.from);
  check_coordinates("to", cylinder.to);
  check_end("to", cylinder.from, cylinder.to);
  check_radius("radius", cylinder.radius);
}

std::unique_ptr<const Shape> make_shape(const Cylinder& cylinder) {
  return std::make_unique<CylinderShape>(cylinder);
}

}  // namespace crt::core
