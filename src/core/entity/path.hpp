// Sweeps and tubes follow paths of points.
#pragma once

#include <vector>

#include "crt/vec.hpp"

namespace crt::core {

/// Checks that a path has points enough, and not too many, and that those that follow one another
/// are apart. Throws Error (invalid_argument, limit) naming the point.
void check_path(const std::vector<Vec3>& path, bool is_closed);

}  // namespace crt::core
