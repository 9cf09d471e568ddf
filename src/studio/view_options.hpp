// ViewOptions say what the live view shows of a scene. None of them touches the script.
#pragma once

#include <crt/bounding_box.hpp>
#include <crt/render.hpp>
#include <crt/scene.hpp>
#include <crt/script.hpp>
#include <functional>
#include <optional>
#include <vector>

#include "studio/view_mode.hpp"

namespace crt::studio {

/// Says which of a pixel's numbers is shown.
enum class Channel { color, depth, normal, id, part, albedo, samples, error };

/// A SectionPlane takes away what lies on one side of a plane across an axis.
struct SectionPlane {
  int axis = 0;  ///< 0 is x, 1 is y, 2 is z
  double offset = 0;
  bool is_flipped = false;  ///< takes away what is below the offset, not what is above

  bool operator==(const SectionPlane&) const = default;
};

/// A Display says how light is shown, beside what the scene's settings say. No picture that is
/// rendered depends on it.
struct Display {
  double exposure = 0;                ///< stops, beside those of the settings
  std::optional<ToneMap> tone_map{};  ///< in the place of that of the settings
  bool denoise = false;               ///< also where the settings do not have it

  bool operator==(const Display&) const = default;
};

struct ViewOptions {
  Channel channel = Channel::color;
  ViewMode mode = ViewMode::rendered;
  std::vector<TextSpan> hidden{};  ///< statements of the script whose entities are not shown
  std::optional<SectionPlane> section{};
  std::optional<Region> region{};  ///< the part of the picture that is refined
  double t = 0;                    ///< the frame
  Display display{};
};

bool is_same_region(const std::optional<Region>& a, const std::optional<Region>& b);

/// Says whether two options differ by their regions, and else by nothing that is rendered.
bool differ_in_region_alone(const ViewOptions& a, const ViewOptions& b);

/// Says whether two options differ by how they are displayed, and by nothing else.
bool differ_in_display_alone(const ViewOptions& a, const ViewOptions& b);

/// Says whether visible_scene() and then scene_in_mode() give the same entities by two options.
bool show_same_entities(const ViewOptions& a, const ViewOptions& b);

/// Returns what of a region lies in a picture, or nothing.
std::optional<Region> clipped(const std::optional<Region>& region, const Settings& settings);

/// Returns the boxes of the scene's entities, for visible_scene().
std::vector<BoundingBox> boxes_of(const Scene& scene);

/// Returns the scene without what is hidden, and cut by the section. Entities keep their ids. Mere
/// surfaces are not cut. `boxes` is called if there is a section.
Scene visible_scene(const Scene& scene, const std::vector<EntityPlace>& places,
                    const ViewOptions& options,
                    const std::function<const std::vector<BoundingBox>&()>& boxes);

}  // namespace crt::studio
