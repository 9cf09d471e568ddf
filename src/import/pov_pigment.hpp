// Patterns of POV-Ray, and what scripts call them.
#pragma once

#include <string>

#include "import/pov_value.hpp"

namespace crt::importing {

/// A PovPattern is what a script calls a pattern of POV-Ray, and how long its period is there.
struct PovPattern {
  const char* name;
  const char* type;
  double period;
  bool is_same;  ///< and not just alike
};

/// Returns the pattern of a name, or nothing if it is none that is understood.
const PovPattern* pov_pattern(const std::string& name);

/// Returns the beginning of a Checker, up to its scale.
std::string checker_text(const PovColor& a, const PovColor& b);

/// Returns "rgb(1, 0.5, 0)", with no channel below 0.
std::string rgb_text(const PovColor& color);

}  // namespace crt::importing
