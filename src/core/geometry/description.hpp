// Equal primitives are found by comparing their descriptions as bytes.
#pragma once

#include <cstddef>
#include <span>
#include <variant>

#include "crt/primitives.hpp"

namespace crt::core {

/// Returns the fields of a primitive but for its material. All are doubles, or pointers to what is
/// shared, so that there are no gaps among them, and equal bytes are equal shapes. 0 and -0 differ.
inline std::span<const std::byte> description_of(const Primitive& primitive) {
  return std::visit(
      [](const auto& shape) {
        const auto* begin = reinterpret_cast<const std::byte*>(&shape);
        const auto* end = reinterpret_cast<const std::byte*>(&shape.material);
        static_assert(sizeof(shape) % sizeof(double) == 0 &&
                      alignof(decltype(shape)) == alignof(double));
        return std::span(begin, end);
      },
      primitive);
}

}  // namespace crt::core
