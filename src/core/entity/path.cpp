#include "core/entity/path.hpp"

#include "core/geometry/checks.hpp"
#include "core/math/vector.hpp"
#include "crt/sweep.hpp"
#include "text/format.hpp"

namespace crt::core {

void check_path(const std::vector<Vec3>& path, bool is_closed) {
  const std::size_t count = path.size();
  if (count < (is_closed ? 3 : 2))
    reject("path", is_closed ? "must have at least 3 points, as it is closed"
                             : "must have at least 2 points");
  check_count("path has", "points", count, most_path_points);
  for (const Vec3& point : path) check_coordinates("path", point);
  for (std::size_t i = 0; i + (is_closed ? 0 : 1) < count; ++i) {
    if (!(largest_component(path[(i + 1) % count] - path[i]) >= smallest_length))
      reject("path", text::format("stands still at point {}", i));
  }
}

}  // namespace crt::core
