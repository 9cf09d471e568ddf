// The filter works on planes: one float a pixel each, with a margin, so that loops over them have
// no branches.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "core/denoise/denoise.hpp"

namespace crt::core {

/// Planes are wider than the picture by so many pixels on each side.
inline constexpr int margin_of_planes = 9;

/// A PlaneLayout says where pixels are in a plane, of which those of the picture begin at (0, 0).
class PlaneLayout {
 public:
  PlaneLayout(int width, int height)
      : width_(width), height_(height), stride_(width + 2 * margin_of_planes) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t size() const {
    return static_cast<std::size_t>(stride_) *
           static_cast<std::size_t>(height_ + 2 * margin_of_planes);
  }
  /// Returns the place of a pixel, which may be in the margin.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y + margin_of_planes) * static_cast<std::size_t>(stride_) +
           static_cast<std::size_t>(x + margin_of_planes);
  }

 private:
  int width_;
  int height_;
  int stride_;
};

using Plane = std::vector<float>;

/// PicturePlanes are all that is known of the pixels. In the margin all is 0.
struct PicturePlanes {
  explicit PicturePlanes(const PlaneLayout& of) : layout(of) {
    for (Plane* const plane :
         {&light[0], &light[1], &light[2], &variance, &albedo[0], &albedo[1], &albedo[2],
          &normal[0], &normal[1], &normal[2], &cover, &nearness, &slope_x, &slope_y, &is_known})
      plane->resize(layout.size());
  }

  PlaneLayout layout;
  std::array<Plane, 3> light;  ///< colours without the albedo
  Plane variance;              ///< of the light, summed over the channels
  std::array<Plane, 3> albedo;
  std::array<Plane, 3> normal;
  Plane cover;
  Plane nearness;  ///< of a plane it is linear in x and y, as seen by a pinhole camera
  Plane slope_x;   ///< what it changes by from pixel to pixel
  Plane slope_y;
  Plane is_known;  ///< 1 for pixels that there are, 0 for others and the margin
};

/// A SurfaceDistance says how far the surfaces of two pixels differ, of which the second is (dx,
/// dy) away. It is in units of what is tolerated, and squared.
class SurfaceDistance {
 public:
  SurfaceDistance(const PicturePlanes& planes, int dx, int dy)
      : normal_{planes.normal[0].data(), planes.normal[1].data(), planes.normal[2].data()},
        albedo_{planes.albedo[0].data(), planes.albedo[1].data(), planes.albedo[2].data()},
        cover_(planes.cover.data()),
        nearness_(planes.nearness.data()),
        slope_x_(planes.slope_x.data()),
        slope_y_(planes.slope_y.data()),
        dx_(static_cast<float>(dx)),
        dy_(static_cast<float>(dy)) {}

  float operator()(std::size_t one, std::size_t other) const {
    const float normal = apart(normal_[0], one, other) + apart(normal_[1], one, other) +
                         apart(normal_[2], one, other);
    const float albedo = apart(albedo_[0], one, other) + apart(albedo_[1], one, other) +
                         apart(albedo_[2], one, other);
    const float cover = apart(cover_, one, other);
    const float expected = nearness_[one] + dx_ * slope_x_[one] + dy_ * slope_y_[one];
    const float beside = squared(nearness_[other] - expected);
    const float tolerated = squared(nearness_tolerance * nearness_[one]) + least_squared;
    return normal * (1 / squared(normal_tolerance)) + albedo * (1 / squared(albedo_tolerance)) +
           cover * (1 / squared(cover_tolerance)) + beside / tolerated;
  }

 private:
  static constexpr float squared(float x) { return x * x; }
  static float apart(const float* plane, std::size_t one, std::size_t other) {
    return squared(plane[one] - plane[other]);
  }

  static constexpr float normal_tolerance = 0.25F;
  static constexpr float albedo_tolerance = 0.25F;
  static constexpr float cover_tolerance = 0.1F;
  static constexpr float nearness_tolerance = 0.03F;  ///< relative
  static constexpr float least_squared = 1e-35F;

  const float* normal_[3];
  const float* albedo_[3];
  const float* cover_;
  const float* nearness_;
  const float* slope_x_;
  const float* slope_y_;
  float dx_;
  float dy_;
};

/// What is as far off as this, or farther, has no weight.
inline constexpr float max_surface_distance = 9;

/// Returns a weight that falls from 1 to 0 as a distance grows up to the farthest. It is about
/// exp(-distance / 2).
inline float weight_of(float distance) {
  const float rest = (max_surface_distance - distance) * (1 / max_surface_distance);
  const float square = rest * rest;
  return square * square;
}

}  // namespace crt::core
