// Which materials let light through.
#pragma once

#include <variant>

#include "crt/material.hpp"

namespace crt::core {

/// Whether light may get through a surface of it somewhere, as far as its numbers tell.
inline bool lets_light_in(const Material& material) {
  const auto* color = std::get_if<Color>(&material.color);
  return material.transparency > 0 || color == nullptr || color->a < 1;
}

}  // namespace crt::core
