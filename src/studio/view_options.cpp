#include "studio/view_options.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <utility>

namespace crt::studio {

namespace {

/// HiddenSpans say at once whether one of many spans encloses another.
class HiddenSpans {
 public:
  explicit HiddenSpans(std::vector<TextSpan> spans) : spans_(std::move(spans)) {
    std::sort(spans_.begin(), spans_.end(),
              [](const TextSpan& a, const TextSpan& b) { return a.begin < b.begin; });
    // From here on an end is the last of all spans that begin up to there.
    std::uint32_t last = 0;
    for (TextSpan& span : spans_) span.end = last = std::max(last, span.end);
  }

  bool hide(const EntityPlace& place) const {
    return enclose(place.statement) || enclose(place.origin);
  }

 private:
  bool enclose(const TextSpan& inner) const {
    const auto behind = std::upper_bound(
        spans_.begin(), spans_.end(), inner.begin,
        [](std::uint32_t begin, const TextSpan& span) { return begin < span.begin; });
    return behind != spans_.begin() && std::prev(behind)->end >= inner.end;
  }

  std::vector<TextSpan> spans_;
};

/// Returns the half-space that a section takes away.
Plane cutter_of(const SectionPlane& section) {
  Plane plane{.normal = {0, 0, 0}, .position = {0, 0, 0}, .material = cut_material()};
  plane.normal[section.axis] = section.is_flipped ? 1 : -1;
  plane.position[section.axis] = section.offset;
  return plane;
}

}  // namespace

bool is_same_region(const std::optional<Region>& a, const std::optional<Region>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->x == b->x && a->y == b->y && a->width == b->width && a->height == b->height;
}

bool differ_in_region_alone(const ViewOptions& a, const ViewOptions& b) {
  return a.channel == b.channel && a.t == b.t && show_same_entities(a, b) &&
         !is_same_region(a.region, b.region);
}

bool differ_in_display_alone(const ViewOptions& a, const ViewOptions& b) {
  return a.channel == b.channel && a.t == b.t && show_same_entities(a, b) &&
         is_same_region(a.region, b.region) && a.display != b.display;
}

bool show_same_entities(const ViewOptions& a, const ViewOptions& b) {
  return a.mode == b.mode && a.hidden == b.hidden && a.section == b.section;
}

std::optional<Region> clipped(const std::optional<Region>& region, const Settings& settings) {
  if (!region) return std::nullopt;
  const int left = std::clamp(region->x, 0, settings.width);
  const int top = std::clamp(region->y, 0, settings.height);
  const int width = std::min(region->width, settings.width - left);
  const int height = std::min(region->height, settings.height - top);
  if (width < 1 || height < 1) return std::nullopt;
  return Region{left, top, width, height};
}

std::vector<BoundingBox> boxes_of(const Scene& scene) {
  std::vector<BoundingBox> boxes;
  boxes.reserve(scene.entities.size());
  for (const Entity& entity : scene.entities) boxes.push_back(bounding_box(entity));
  return boxes;
}

namespace {

/// Cuts an entity. What light or the camera pass they pass afterwards, too.
Entity cut(const Entity& entity, const Entity& cutter) {
  if (entity.casts_shadow() && entity.is_visible()) return entity - cutter;
  return (entity.with_shadow(true).with_visible(true) - cutter)
      .with_shadow(entity.casts_shadow())
      .with_visible(entity.is_visible());
}

}  // namespace

Scene visible_scene(const Scene& scene, const std::vector<EntityPlace>& places,
                    const ViewOptions& options,
                    const std::function<const std::vector<BoundingBox>&()>& boxes) {
  Scene result = scene;
  if (options.hidden.empty() && !options.section) return result;
  result.entities.clear();
  const auto kept_as_it_is = [&](std::size_t index) {
    if (!options.section || !scene.entities[index].is_solid()) return true;
    const auto& [axis, offset, is_flipped] = *options.section;
    const BoundingBox& box = boxes()[index];
    return is_flipped ? box.lower[axis] >= offset : box.upper[axis] <= offset;
  };
  const std::optional<Entity> cutter =
      options.section ? std::optional<Entity>(cutter_of(*options.section)) : std::nullopt;
  const HiddenSpans hidden(options.hidden);
  for (std::size_t i = 0; i < scene.entities.size(); ++i) {
    if (i < places.size() && hidden.hide(places[i])) continue;
    const Entity& entity = scene.entities[i];
    result.entities.push_back(
        kept_as_it_is(i) ? entity : cut(entity, *cutter).with_id(static_cast<std::uint32_t>(i)));
  }
  return result;
}

}  // namespace crt::studio
