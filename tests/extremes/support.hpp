// The tests of extremes share this: random directions, rotations, and cameras of one pixel.
#pragma once

#include <crt/query.hpp>
#include <crt/render.hpp>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "render/pictures.hpp"

namespace crt::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double between(double low, double high) { return low + (high - low) * unit_(engine_); }
  int integer(int low, int high) {
    return low + static_cast<int>((high - low + 1) * unit_(engine_) * 0.999999);
  }

  /// Returns a direction, evenly over the sphere.
  Vec3 direction() {
    while (true) {
      const Vec3 v(between(-1, 1), between(-1, 1), between(-1, 1));
      const double length = glm::length(v);
      if (length > 0.01 && length <= 1) return v / length;
    }
  }

 private:
  std::mt19937_64 engine_;
  std::uniform_real_distribution<double> unit_;
};

inline Vec3 apply(const Transform& map, const Vec3& p) {
  return Vec3(glm::dot(map.row_x, p), glm::dot(map.row_y, p), glm::dot(map.row_z, p)) +
         map.translation;
}

/// Turns a direction.
inline Vec3 turn(const Transform& map, const Vec3& v) {
  return {glm::dot(map.row_x, v), glm::dot(map.row_y, v), glm::dot(map.row_z, v)};
}

/// Returns the ray through the middle of a pixel of a pinhole camera without roll, as docs/image.md
/// has it.
inline Ray pixel_ray(const Scene& scene, int x, int y) {
  const Vec3 forward = glm::normalize(scene.camera.pointing - scene.camera.position);
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), forward));
  const Vec3 up = glm::cross(forward, right);
  const double half_up = std::tan(scene.camera.fov / 2);
  const double half_across = half_up * scene.settings.width / scene.settings.height;
  const double nx = 2 * (x + 0.5) / scene.settings.width - 1;
  const double ny = 1 - 2 * (y + 0.5) / scene.settings.height;
  return {.origin = scene.camera.position,
          .direction = glm::normalize(forward + nx * half_across * right + ny * half_up * up)};
}

inline double difference(const Color& a, const Color& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// Counts pixels that differ by more than `alike` where the reference has no edge next to them.
inline int speckles(const Image& image, const Image& reference, double alike = 0.01) {
  constexpr double smooth = 0.05;
  int count = 0;
  for (int y = 1; y + 1 < image.height(); ++y) {
    for (int x = 1; x + 1 < image.width(); ++x) {
      const Color middle = reference.at(x, y);
      bool at_edge = false;
      for (int i = 0; i < 9; ++i) {
        at_edge =
            at_edge || difference(middle, reference.at(x + i % 3 - 1, y + i / 3 - 1)) > smooth;
      }
      if (!at_edge && difference(middle, image.at(x, y)) > alike) ++count;
    }
  }
  return count;
}

/// Returns a unit vector across `v`, which must have length 1.
inline Vec3 across(const Vec3& v) {
  return glm::normalize(std::abs(v.x) < 0.6 ? glm::cross(v, Vec3(1, 0, 0))
                                            : glm::cross(v, Vec3(0, 1, 0)));
}

}  // namespace crt::test
