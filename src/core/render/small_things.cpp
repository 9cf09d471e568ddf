#include "core/render/small_things.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/render/tiles.hpp"
#include "core/scene/compile.hpp"

namespace crt::core {

namespace {

/// In pixels: what is at least as wide and as high is not small.
constexpr double small_size = 1;
/// What covers less of a pixel is not looked for.
constexpr double least_area = 1.0 / 64;
/// Long things that are seen askew have a rectangle that says little.
constexpr double most_pixels = 4096;

struct Rectangle {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
};

/// Around where a box appears in the picture; nothing if part of it is behind the camera.
std::optional<Rectangle> seen_rectangle(const CameraRays& camera, const Bounds& box) {
  std::optional<Rectangle> seen;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vec3 point((corner & 1u) != 0 ? box.upper.x : box.lower.x,
                     (corner & 2u) != 0 ? box.upper.y : box.lower.y,
                     (corner & 4u) != 0 ? box.upper.z : box.lower.z);
    const std::optional<PicturePlace> place = camera.place_of(point);
    if (!place) return std::nullopt;
    if (!seen) seen = {place->x, place->y, place->x, place->y};
    seen->left = std::min(seen->left, place->x);
    seen->right = std::max(seen->right, place->x);
    seen->top = std::min(seen->top, place->y);
    seen->bottom = std::max(seen->bottom, place->y);
  }
  return seen;
}

bool is_small(const Rectangle& seen) {
  const double width = seen.right - seen.left;
  const double height = seen.bottom - seen.top;
  return std::min(width, height) < small_size && width * height >= least_area &&
         (width + 1) * (height + 1) <= most_pixels;
}

/// A cheap test that spares most objects the other: whether a ball inside the box is large enough.
bool is_surely_large(const CameraRays& camera, const Bounds& box) {
  const Vec3 extents = 0.5 * (box.upper - box.lower);
  const double least = std::min({extents.x, extents.y, extents.z});
  return 2 * least * camera.least_pixels_per_unit(0.5 * (box.lower + box.upper)) > 2 * small_size;
}

}  // namespace

std::vector<bool> small_things(const Frame& frame, const Region& region) {
  std::vector<bool> pixels;
  if (frame.features().lens) return pixels;
  const CameraRays& camera = frame.camera();
  const auto inside = [](double place, int begin, int size) {
    return static_cast<int>(std::clamp(std::floor(place) - begin, 0.0, size - 1.0));
  };
  for (const SceneObject& object : frame.data().compiled().objects) {
    if (!object.solid || !object.bounds.finite() || object.bounds.empty()) continue;
    if (is_surely_large(camera, object.bounds)) continue;
    const std::optional<Rectangle> seen = seen_rectangle(camera, object.bounds);
    if (!seen || !is_small(*seen)) continue;
    if (seen->right < region.x || seen->left >= region.x + region.width || seen->bottom < region.y ||
        seen->top >= region.y + region.height)
      continue;
    if (pixels.empty()) pixels.resize(pixel_count(region));
    const int right = inside(seen->right, region.x, region.width);
    const int bottom = inside(seen->bottom, region.y, region.height);
    for (int y = inside(seen->top, region.y, region.height); y <= bottom; ++y) {
      for (int x = inside(seen->left, region.x, region.width); x <= right; ++x)
        pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(region.width) +
               static_cast<std::size_t>(x)] = true;
    }
  }
  return pixels;
}

}  // namespace crt::core
