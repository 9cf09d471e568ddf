#include "core/geometry/cone/cone.hpp"

namespace crt::core {

std::unique_ptr<const Shape> make_shape(const Cone& cone) {
  return std::make_unique<ConeShape>(cone);
}

}  // namespace crt::core
