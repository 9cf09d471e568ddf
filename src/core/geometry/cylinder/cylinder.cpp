#include "core/geometry/cylinder/cylinder.hpp"

namespace crt::core {

std::unique_ptr<const Shape> make_shape(const Cylinder& cylinder) {
  return std::make_unique<CylinderShape>(cylinder);
}

}  // namespace crt::core
