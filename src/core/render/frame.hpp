// A Frame is what all rays of one render share: the prepared scene, and what is computed before the
// first ray.
#pragma once

#include <optional>
#include <vector>

#include "core/camera/camera_rays.hpp"
#include "core/math/vector.hpp"
#include "core/render/workspace.hpp"
#include "core/sampling/pixel_filter.hpp"
#include "core/shading/prepared_light.hpp"

namespace crt::core {

class Frame {
 public:
  /// `data` and `settings` must outlive the frame. The workspace lends memory and counts what is
  /// looked up.
  Frame(const PreparedData& data, const Settings& settings, Workspace& work);

  const PreparedData& data() const { return data_; }
  const Settings& settings() const { return settings_; }
  const Features& features() const { return data_.features(); }
  const CameraRays& camera() const { return camera_; }
  const FilterPlaces& filter() const { return filter_; }
  /// A pixel's grid says, row by row, where in (or around) the first pixel of the picture its
  /// samples lie. The count is exact, and the last lanes may be unused.
  std::size_t subpixel_count() const { return subpixel_count_; }
  const std::vector<PicturePlaceLanes>& subpixels() const { return subpixels_; }
  const std::vector<PreparedLight>& lights() const { return lights_; }
  /// Returns the numbers of those lights that every point asks.
  const std::vector<std::uint32_t>& asked_lights() const { return asked_lights_; }
  /// Returns a light's number among the ChosenLights, or invalid_index if it is none of them.
  std::uint32_t number_of_chosen(std::uint32_t light) const { return numbers_of_chosen_[light]; }

  /// Returns whether a decision at the first surface takes the numbers of the lens, which has no
  /// use for them: that on the point of a light or, without such lights, on the diffuse direction.
  bool takes_numbers_of_lens(std::uint32_t kind) const { return kind == kind_with_lens_; }
  /// Returns whether samples draw numbers beyond those of their place and lens.
  bool draws_numbers() const { return draws_numbers_; }
  /// Returns whether a light is seen itself.
  bool shows_lights() const { return shows_lights_; }

  /// Returns the background as a light, or null if it is none.
  const PreparedLight* environment() const { return environment_ ? &*environment_ : nullptr; }

  /// Returns what all lights together give every point.
  const Rgb& ambient() const { return ambient_; }

  /// Sets camera rays in the world. Surfaces at their very start, to rounding, count as passed. A
  /// camera on a surface sees what is before it, or what is behind it from within.
  static void set_camera_rays(std::span<const RayLanes> camera_rays, RayBatch& rays) {
    for (std::size_t group = 0; group < camera_rays.size(); ++group) {
      rays.lines[group] = camera_rays[group];
      rays.start_errors[group] = start_rounding * largest_component(camera_rays[group].origin);
    }
    rays.with_starts = 0;
  }

  /// Returns what all the surfaces may multiply the weight of a continuing ray by, which it can
  /// still pass after so many bounces.
  double gain_behind(int bounces) const { return gains_behind_[static_cast<std::size_t>(bounces)]; }

  /// Returns whether all camera rays start at one point off all surfaces, or on a lens that all
  /// surfaces pass by, so that the same solids surround them all. Those are then camera_media(),
  /// the outermost first.
  bool one_viewpoint() const { return one_viewpoint_; }
  const std::vector<Medium>& camera_media() const { return camera_media_; }

 private:
  std::uint32_t first_decision() const;

  const PreparedData& data_;
  const Settings& settings_;
  CameraRays camera_;
  FilterPlaces filter_;
  std::size_t subpixel_count_;
  std::vector<PicturePlaceLanes> subpixels_;
  std::vector<PreparedLight> lights_;
  std::vector<std::uint32_t> asked_lights_;
  std::vector<std::uint32_t> numbers_of_chosen_;
  Rgb ambient_{0, 0, 0};
  std::optional<PreparedLight> environment_;
  bool draws_numbers_ = false;
  bool shows_lights_ = false;
  std::uint32_t kind_with_lens_ = SampleDecision::none;
  std::vector<double> gains_behind_;  ///< by bounces; none if no surface brightens light
  bool one_viewpoint_ = false;
  std::vector<Medium> camera_media_;
};

/// Puts the transparent solids around the start of a ray into `out`, the outermost first. Those
/// that rays of the kind pass are left out.
void find_surrounding_media(const PreparedData& data, const WorldRay& ray, PassingRays kind,
                            std::vector<Medium>& out, Workspace& work);

}  // namespace crt::core
