// A scene is cut open by taking a half-space from each of its solids, whose material is hatched.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <variant>
#include <vector>

#include "core/entity/entity_node.hpp"
#include "core/geometry/finite_sides.hpp"
#include "core/math/drawing_axes.hpp"
#include "crt/error.hpp"
#include "crt/section.hpp"
#include "crt/surface_mesh.hpp"

namespace crt {

namespace core {

namespace {

/// Cuts without hatching say: there are so many lines along the longest side.
constexpr double usual_lines = 40;

/// Lines are darker than what is between them, or lighter if that is nearly black.
Color line_color(const Color& color) {
  constexpr double nearly_black = 0.05;
  constexpr double darker = 0.15;
  constexpr double lighter = 0.4;
  if (std::max({color.r, color.g, color.b}) < nearly_black) return grey(lighter);
  return {darker * color.r, darker * color.g, darker * color.b, 1};
}

/// Returns stripes of which a quarter is lines, `distance` apart.
Stripes hatching(const Color& color, const Vec3& direction, double distance) {
  const Stripes lines{.color_a = line_color(color),
                      .color_b = color,
                      .direction = direction,
                      .scale = 0.5 * distance};
  return {.color_a = color, .direction = direction, .scale = distance, .pattern_b = nested(lines)};
}

/// Returns how far a box reaches along a direction.
double reach_of_box(const BoundingBox& box, const Vec3& direction) {
  double reach = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (direction[axis] != 0)
      reach += direction[axis] * (direction[axis] > 0 ? box.upper[axis] : box.lower[axis]);
  return reach;
}

/// Cuts an entity with a half-space. What is around all of it, such as its id, stays there.
Entity cut_away(const Entity& entity, const Entity& cutter) {
  const bool casts_shadow = entity.casts_shadow();
  const bool is_visible = entity.is_visible();
  Entity rest = entity.with_shadow(true).with_visible(true) - cutter;
  const auto* wrapper = std::get_if<EntityWrapper>(&entity.node().content);
  if (wrapper != nullptr && wrapper->id) rest = rest.with_id(*wrapper->id);
  if (!casts_shadow) rest = rest.with_shadow(false);
  if (!is_visible) rest = rest.with_visible(false);
  return rest;
}

/// A SceneCut says which solids of a scene a plane meets.
class SceneCut {
 public:
  SceneCut(const Scene& scene, const Vec3& normal, double offset)
      : scene_(scene), normal_(unit_normal(normal)), offset_(offset) {}

  Scene run(double hatch) {
    Scene result = scene_;
    result.camera.section_normal = {0, 0, 0};
    find();
    const double longest = sides_.longest();
    if (hatch == 0) hatch = longest > 0 ? longest / usual_lines : 1;
    const DrawingAxes axes = axes_across(normal_);
    bool is_turned = false;
    for (const std::size_t place : met_) {
      const Entity& entity = scene_.entities[place];
      const Vec3 direction = is_turned ? axes.x - axes.y : axes.x + axes.y;
      const Color color = plain_color(entity).value_or(grey(0.8));
      const Material material{
          .color = Pattern(hatching({color.r, color.g, color.b, 1}, direction, hatch))};
      const Plane cutter{.normal = -normal_, .position = normal_ * offset_, .material = material};
      result.entities[place] = cut_away(entity, cutter);
      is_turned = !is_turned;
    }
    for (const std::size_t place : gone_) result.entities[place] = empty_entity();
    return result;
  }

 private:
  void find() {
    for (std::size_t i = 0; i < scene_.entities.size(); ++i) {
      const Entity& entity = scene_.entities[i];
      if (!entity.is_solid() || entity.is_empty()) continue;
      const BoundingBox box = bounding_box(entity);
      if (!(reach_of_box(box, normal_) > offset_)) continue;
      if (-reach_of_box(box, -normal_) > offset_) {
        gone_.push_back(i);
        continue;
      }
      met_.push_back(i);
      sides_.include(box.lower, box.upper);
    }
  }

  const Scene& scene_;
  Vec3 normal_;
  double offset_;
  std::vector<std::size_t> met_;
  std::vector<std::size_t> gone_;
  FiniteSides sides_;
};

}  // namespace

}  // namespace core

Scene sectioned(const Scene& scene, const Vec3& normal, double offset, double hatch) {
  if (!std::isfinite(offset))
    throw Error(ErrorCode::invalid_argument, "the offset must be finite", "offset");
  if (!(hatch >= 0 && std::isfinite(hatch)))
    throw Error(ErrorCode::invalid_argument, "the hatch must be at least 0", "hatch");
  return core::SceneCut(scene, normal, offset).run(hatch);
}

}  // namespace crt
