#include "core/render/frame.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/base/invalid_index.hpp"
#include "core/math/vector.hpp"
#include "core/render/media_order.hpp"

namespace crt::core {

namespace {

/// Sorts the solids around a ray's start, given by their exits, by where the ray's line enters
/// them. Solids that it enters at one place are sorted from the last one left to the first.
void sort_by_entry(const PreparedData& data, const WorldRay& ray, std::vector<RayHit>& exits,
                   Workspace& work) {
  WorldRay back = ray;
  back.direction = -ray.direction;
  struct Around {
    RayHit exit;
    RayHit entry;
  };
  std::vector<Around> solids;
  solids.reserve(exits.size());
  for (const RayHit& exit : exits) {
    // Backwards the ray may start outside already, if it starts on the solid's surface.
    const SolidExit stay = data.find_exit(back, exit.object, work.rays);
    solids.push_back({exit, stay.inside ? stay.exit : RayHit{.t = 0}});
  }
  const auto comes_first = [](const Around& a, const Around& b) {
    if (!same_end(a.entry, b.entry)) return a.entry.t > b.entry.t;
    return same_end(a.exit, b.exit) ? a.exit.object < b.exit.object : a.exit.t > b.exit.t;
  };
  sort_by_insertion(solids, comes_first);
  for (std::size_t i = 0; i < solids.size(); ++i) exits[i] = solids[i].exit;
}

}  // namespace

Frame::Frame(const PreparedData& data, const Settings& settings, Workspace& work)
    : data_(data),
      settings_(settings),
      camera_(data.scene().camera, settings.width, settings.height, settings.compat),
      filter_(settings),
      subpixel_count_(static_cast<std::size_t>(settings.supersampling) *
                      static_cast<std::size_t>(settings.supersampling)),
      subpixels_((subpixel_count_ + lane_count - 1) / lane_count) {
  const int side = settings.supersampling;
  // Samples of 2015 lie at the upper left corners of subpixels, others in their middles.
  const double in_subpixel = settings.compat == compat_2015 ? 0 : 0.5;
  std::size_t index = 0;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column, ++index) {
      set_lane(subpixels_[index / lane_count], index % lane_count,
               {filter_((column + in_subpixel) / side), filter_((row + in_subpixel) / side)});
    }
  }
  lights_.reserve(data.scene().lights.size());
  for (const Light& light : data.scene().lights) {
    lights_.emplace_back(light, settings.falloff_model, data.environment());
    if (std::holds_alternative<EnvironmentLight>(light)) environment_ = lights_.back();
    ambient_ += lights_.back().ambient();
    draws_numbers_ = draws_numbers_ || lights_.back().has_size();
    shows_lights_ = shows_lights_ || lights_.back().is_visible();
  }
  const ChosenLights* const chosen = data.chosen_lights();
  numbers_of_chosen_.assign(lights_.size(), invalid_index);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    if (chosen != nullptr && chosen->has_lights_of_scene() && lights_[i].has_extent()) {
      numbers_of_chosen_[i] = count++;
    } else {
      asked_lights_.push_back(i);
    }
  }
  draws_numbers_ = draws_numbers_ || chosen != nullptr;
  if (!features().lens) kind_with_lens_ = first_decision();
  if (settings.indirect > 0) ambient_ = Rgb(0);
  draws_numbers_ = draws_numbers_ || settings.indirect > 0 || features().principled;
  if (features().gain > 1) {
    gains_behind_.assign(static_cast<std::size_t>(settings.recursion_depth) + 1, 1);
    for (std::size_t i = gains_behind_.size() - 1; i-- > 1;) {
      gains_behind_[i - 1] = std::min(features().gain * gains_behind_[i], largest_share);
    }
  }
  if (!features().transparency) return;
  if (data.scene().camera.projection == Projection::orthographic) return;
  const PicturePlaceLanes in_middle = {lanes_of(0.5 * settings.width),
                                       lanes_of(0.5 * settings.height)};
  RayLanes line;
  camera_.rays(1, {&in_middle, 1}, {}, {&line, 1});
  RayBatch eye;
  set_camera_rays({&line, 1}, eye);
  const WorldRay middle = eye.ray(0);
  one_viewpoint_ = features().lens ? data.all_pass_by(camera_.lens_bounds())
                                   : !data.is_on_surface(middle.origin, work.rays);
  if (one_viewpoint_) find_surrounding_media(data, middle, passing_camera, camera_media_, work);
  // In which order several solids hold a point of the lens depends on the ray.
  if (features().lens && camera_media_.size() > 1) {
    one_viewpoint_ = false;
    camera_media_.clear();
  }
}

std::uint32_t Frame::first_decision() const {
  for (const std::uint32_t light : asked_lights_) {
    if (lights_[light].has_size()) return SampleDecision::of_light(light);
  }
  return data_.chosen_lights() == nullptr ? SampleDecision::diffuse_direction
                                          : SampleDecision::chosen_light;
}

void find_surrounding_media(const PreparedData& data, const WorldRay& ray, PassingRays kind,
                            std::vector<Medium>& out, Workspace& work) {
  ++work.stats.media_lookups;
  out.clear();
  std::vector<RayHit>& exits = work.crossings;
  data.containing_solids(ray, exits, work.rays);
  std::erase_if(exits, [&](const RayHit& exit) {
    return data.materials()[data.hit_material(exit)].opaque || data.is_passed(exit.object, kind);
  });
  if (exits.size() > max_media_at_once) exits.resize(max_media_at_once);
  if (exits.size() > 1) sort_by_entry(data, ray, exits, work);
  // Each solid gets the place that it would have if the ray had come from outside of all.
  for (const RayHit& exit : exits) {
    auto place = out.end();
    const auto is_inside_of = [&](const Medium& around) {
      if (exit.object > around.object) return true;
      const RayHit other = data.find_exit(ray, around.object, work.rays).exit;
      return exit.t < other.t || same_end(exit, other);
    };
    while (place != out.begin() && !is_inside_of(*std::prev(place))) --place;
    out.insert(place, {exit.object, data.hit_material(exit)});
  }
}

}  // namespace crt::core
