#pragma once

#include "core/math/lanes.hpp"

namespace crt::core {

/// LightNumbers say which light is chosen and which point of it is seen, from as many points as
/// there are lanes: numbers in [0, 1).
struct LightNumbers {
  Lanes u{};
  Lanes v{};
  Lanes choice{};
};

}  // namespace crt::core
