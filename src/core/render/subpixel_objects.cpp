#include "core/render/subpixel_objects.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "core/compile/compile.hpp"
#include "core/math/vector.hpp"
#include "core/render/tiles.hpp"

namespace crt::core {

namespace {

/// What is at least as wide and as high in pixels is not small.
constexpr double small_size = 1;
/// Objects that cover less of a pixel are not looked for, nor long and thinner ones.
constexpr double least_area = 1.0 / 64;
constexpr double least_width = least_area;
/// An object with a larger rectangle is long and seen askew.
constexpr double most_pixels = 4096;

struct Rectangle {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
};

/// Returns the rectangle around where a box appears in the picture, or nothing if part of it is
/// behind the camera.
std::optional<Rectangle> seen_rectangle(const CameraRays& camera, const Bounds& box) {
  std::optional<Rectangle> seen;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const std::optional<PicturePlace> place = camera.place_of(box.corner(corner));
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

/// Returns whether a sphere inside the box is large enough. This cheap test spares most objects the
/// other one.
bool is_surely_large(const CameraRays& camera, const Bounds& box) {
  const Vec3 extents = 0.5 * (box.upper - box.lower);
  const double least = std::min({extents.x, extents.y, extents.z});
  return 2 * least * camera.least_pixels_per_unit(0.5 * (box.lower + box.upper)) > 2 * small_size;
}

/// Marks are the pixels of a region in which subpixel objects may be seen.
class Marks {
 public:
  Marks(const CameraRays& camera, const Region& region) : camera_(camera), region_(region) {}

  void add(const Rectangle& seen) {
    if (is_beside(seen)) return;
    if (pixels_.empty()) pixels_.resize(pixel_count(region_));
    const int right = inside(seen.right, region_.x, region_.width);
    const int bottom = inside(seen.bottom, region_.y, region_.height);
    for (int y = inside(seen.top, region_.y, region_.height); y <= bottom; ++y) {
      for (int x = inside(seen.left, region_.x, region_.width); x <= right; ++x) {
        pixels_[index_in(region_, x, y)] = true;
      }
    }
  }

  /// Adds what is around a line, as far as it looks thin. Returns false if it looks thin nowhere.
  bool add(const CoreSegment& line) {
    const Point from = point_at(line.from, line.from_reach);
    const Point to = point_at(line.to, line.to_reach);
    if (is_wide(from, to)) return false;
    add_between(from, to, 0);
    return true;
  }

  std::vector<bool> take() { return std::move(pixels_); }

 private:
  /// A Point is a point of a line.
  struct Point {
    Vec3 position;
    double reach;
    double width;  ///< of what is around it, in pixels, about
    std::optional<PicturePlace> place;
  };

  Point point_at(const Vec3& position, double reach) const {
    return {position, reach, 2 * reach * camera_.least_pixels_per_unit(position),
            camera_.place_of(position)};
  }

  /// Returns whether all between two points is too wide to count. The reach is linear along the
  /// line, and the distance from the camera is convex. So nothing in between looks thinner than
  /// both ends.
  static bool is_wide(const Point& from, const Point& to) {
    return std::min(from.width, to.width) >= small_size;
  }

  /// Returns the pixel of the region that is nearest to a place.
  static int inside(double place, int begin, int size) {
    return begin + static_cast<int>(std::clamp(std::floor(place) - begin, 0.0, size - 1.0));
  }

  bool is_beside(const Rectangle& seen) const {
    return seen.right < region_.x || seen.left >= region_.x + region_.width ||
           seen.bottom < region_.y || seen.top >= region_.y + region_.height;
  }

  static Rectangle around(const Point& from, const Point& to) {
    const double width = std::max(from.width, to.width);
    const auto [left, right] = std::minmax(from.place->x, to.place->x);
    const auto [top, bottom] = std::minmax(from.place->y, to.place->y);
    return {left - width / 2, top - width / 2, right + width / 2, bottom + width / 2};
  }

  /// Halves the line until its parts are short in the picture, or not in it.
  void add_between(const Point& from, const Point& to, int halvings) {
    constexpr int max_halvings = 20;
    constexpr int enough_to_see_some = 6;
    if (is_wide(from, to)) return;
    const bool both_seen = from.place && to.place;
    if (both_seen) {
      const Rectangle seen = around(from, to);
      const double width = std::max(from.width, to.width);
      const bool is_short =
          std::max(seen.right - seen.left, seen.bottom - seen.top) <= width + small_size / 2;
      if (is_short && width >= least_width) add(seen);
      if (is_short || is_beside(seen)) return;
    }
    const bool none_seen = !from.place && !to.place;
    if (halvings == max_halvings || (none_seen && halvings == enough_to_see_some)) return;
    const Point middle =
        point_at(0.5 * (from.position + to.position), 0.5 * (from.reach + to.reach));
    add_between(from, middle, halvings + 1);
    add_between(middle, to, halvings + 1);
  }

  const CameraRays& camera_;
  Region region_;
  std::vector<bool> pixels_;
};

/// Returns the line through something long in the world, or nothing if the object is not a single
/// shape.
std::optional<CoreSegment> core_segment_of(const CompiledScene& scene, const SceneObject& object) {
  if (object.is_csg() || object.is_instance()) return std::nullopt;
  const Leaf& leaf = scene.leaves[object.first_leaf];
  std::optional<CoreSegment> segment = leaf.shape->core_segment();
  if (!segment) return segment;
  const Transform& world = leaf.placement->to_world();
  const Vec3 scale(glm::length(Vec3(world.row_x.x, world.row_y.x, world.row_z.x)),
                   glm::length(Vec3(world.row_x.y, world.row_y.y, world.row_z.y)),
                   glm::length(Vec3(world.row_x.z, world.row_y.z, world.row_z.z)));
  const double max_scale = largest_component(scale);
  return CoreSegment{leaf.placement->point_to_world(segment->from),
                     leaf.placement->point_to_world(segment->to), segment->from_reach * max_scale,
                     segment->to_reach * max_scale};
}

}  // namespace

std::vector<bool> subpixel_objects(const Frame& frame, const Region& region) {
  if (frame.features().lens) return {};
  const CameraRays& camera = frame.camera();
  const CompiledScene& scene = frame.data().compiled();
  Marks marks(camera, region);
  for (const SceneObject& object : scene.objects) {
    if (!object.solid || !object.bounds.finite() || object.bounds.empty()) continue;
    if ((object.passed_by & passing_camera) != 0) continue;
    const std::optional<CoreSegment> segment = core_segment_of(scene, object);
    if (segment && marks.add(*segment)) continue;
    if (is_surely_large(camera, object.bounds)) continue;
    const std::optional<Rectangle> seen = seen_rectangle(camera, object.bounds);
    if (seen && is_small(*seen)) marks.add(*seen);
  }
  return marks.take();
}

}  // namespace crt::core
