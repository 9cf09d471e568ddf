#include "import/scene_text.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <filesystem>
#include <numbers>

#include "import/solid.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr double field_of_view = 30;  // degrees

/// Keeps so many digits as a camera needs.
double with_four_digits(double number) {
  if (number == 0 || !std::isfinite(number)) return number;
  const double step = elementary::pow(10, std::floor(elementary::log10(std::abs(number))) - 3);
  return step >= 1 ? std::round(number / step) * step
                   : std::round(number / step) / std::round(1 / step);
}

double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Returns how far along a direction a camera of 4 to 3 stands that sees a box, of which these are
/// half of the edges, with a margin.
double way_to_see(const Vec3& half, const Vec3& direction) {
  const double across = elementary::hypot(direction.x, direction.z);
  const Vec3 right = Vec3(-direction.z, 0, direction.x) / across;
  const Vec3 up{-direction.x * direction.y / across, across, -direction.z * direction.y / across};
  const double rise = elementary::tan(field_of_view / 2 * std::numbers::pi / 180);
  double way = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{(corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                 (corner & 4) != 0 ? half.z : -half.z};
    const double wide = std::max(std::abs(dot(p, up)), std::abs(dot(p, right)) * 3 / 4);
    way = std::max(way, 1.1 * wide / rise + dot(p, direction));
  }
  return std::max(way, 1e-6);
}

Vec3 rounded(const Vec3& v) {
  return {with_four_digits(v.x), with_four_digits(v.y), with_four_digits(v.z)};
}

}  // namespace

std::string settings_for(const BoundingBox& box) {
  const Vec3 center = (box.lower + box.upper) * 0.5;
  const Vec3 size = box.upper - box.lower;
  // It looks from the front, from the right and from above.
  const Vec3 direction = Vec3(0.45, 0.5, -1) / elementary::hypot(0.45, 0.5, 1.0);
  const double way = way_to_see(size * 0.5, direction);
  return text::format(R"(Settings {{
    width -> 800
    height -> 600
    supersampling -> 3
    recursiondepth -> 8
    camera -> Camera {{
        position -> {}
        pointing -> {}
        fov -> {}
    }}
    lights -> [
        ParallelLight {{
            from -> vec3(-1, 3, -2)
            pointing -> vec3(0, 0, 0)
            color -> rgb(0.75, 0.73, 0.7)
            ambient -> 0.2
        }},
        ParallelLight {{
            from -> vec3(3, 1, -1)
            pointing -> vec3(0, 0, 0)
            color -> rgb(0.25, 0.27, 0.3)
        }}
    ]
    background -> Background {{ color -> rgb(1, 1, 1) }}
}}
)",
                      vector_text(rounded(center + direction * way)), vector_text(rounded(center)),
                      field_of_view);
}

BoundingBox box_around(const std::vector<Entity>& entities) {
  BoundingBox all{Vec3(1, 1, 1), Vec3(-1, -1, -1)};
  for (const Entity& entity : entities) {
    const BoundingBox box = bounding_box(entity);
    const Vec3 size = box.upper - box.lower;
    if (!(size.x >= 0) || !std::isfinite(size.x + size.y + size.z)) continue;
    const bool is_first = all.lower.x > all.upper.x;
    for (int axis = 0; axis < 3; ++axis) {
      all.lower[axis] = is_first ? box.lower[axis] : std::min(all.lower[axis], box.lower[axis]);
      all.upper[axis] = is_first ? box.upper[axis] : std::max(all.upper[axis], box.upper[axis]);
    }
  }
  return all;
}

std::string heading_of(const std::string& name) {
  std::string shown = std::filesystem::path(name).filename().string();
  for (char& c : shown)
    if (static_cast<unsigned char>(c) < ' ') c = '?';
  return text::format("-- `crt import` has made this of {}.\n", shown);
}

}  // namespace crt::importing
