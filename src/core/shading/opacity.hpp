// Some materials let light through.
#pragma once

#include <variant>

#include "crt/material.hpp"

namespace crt::core {

/// Returns whether light may get through a surface of the material somewhere, as far as its numbers
/// show.
inline bool lets_light_in(const Material& material) {
  const auto* color = std::get_if<Color>(&material.color);
  return material.transparency > 0 || color == nullptr || color->a < 1;
}

}  // namespace crt::core
