#include "core/geometry/exact_shape.hpp"

namespace crt::core {

std::unique_ptr<const ExactShape> make_exact_shape(const Primitive& primitive) {
  return std::visit([](const auto& description) { return make_exact_shape(description); }, primitive);
}

}  // namespace crt::core
