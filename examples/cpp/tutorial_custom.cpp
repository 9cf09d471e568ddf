// The fifth program of the tutorial for C++: a vase, whose sides are a wave that it computes
// itself.
#include <cmath>
#include <crt/crt.hpp>
#include <iostream>
#include <memory>

/// A Vase is the solid about the y axis from y = -1 to 1 with a radius that waves.
class Vase : public crt::CustomShape {
 public:
  crt::BoundingBox bounds() const override { return {{-0.8, -1, -0.8}, {0.8, 1, 0.8}}; }

  void crossings(const crt::Ray& ray, std::vector<crt::CustomCrossing>& out) const override {
    // The ray is looked at from where it enters the bounds to where it leaves them. It is outside
    // before and after.
    const int steps = 200;
    double t = ray.t_min;
    bool inside = false;
    for (int i = 1; i <= steps; ++i) {
      const double next = ray.t_min + i * (ray.t_max - ray.t_min) / steps;
      const bool is_inside = i < steps && height(point_at(ray, next)) < 0;
      if (is_inside != inside) out.push_back(crossing(ray, t, next, inside));
      t = next;
      inside = is_inside;
    }
  }

  crt::CustomPoint point(const crt::Vec3& p, std::uint32_t face) const override {
    if (face == bottom) return {.normal = {0, -1, 0}};
    if (face == top) return {.normal = {0, 1, 0}};
    return {.normal = {p.x, -radius(p.y) * slope(p.y), p.z}};
  }

  std::uint32_t face_count() const override { return 3; }
  std::string name() const override { return "the vase"; }

 private:
  static constexpr std::uint32_t side = 0, bottom = 1, top = 2;

  static double radius(double y) { return 0.55 + 0.2 * std::sin(3 * y); }
  static double slope(double y) { return 0.6 * std::cos(3 * y); }
  static crt::Vec3 point_at(const crt::Ray& ray, double t) {
    return ray.origin + t * ray.direction;
  }
  /// Is below 0 inside, and 0 on the surface.
  static double height(const crt::Vec3& p) {
    return std::max(std::hypot(p.x, p.z) - radius(p.y), std::abs(p.y) - 1);
  }

  /// Halves the piece of the ray in which it enters or leaves, until the error is small.
  static crt::CustomCrossing crossing(const crt::Ray& ray, double from, double to, bool leaves) {
    while (to - from > 1e-13) {
      const double middle = from + (to - from) / 2;
      const bool is_inside = height(point_at(ray, middle)) < 0;
      (is_inside == leaves ? from : to) = middle;
    }
    const crt::Vec3 p = point_at(ray, from);
    const bool is_end = std::abs(std::abs(p.y) - 1) < 1e-12 && ray.direction.y != 0;
    return {.t = from, .error = 1e-13, .face = !is_end ? side : p.y < 0 ? bottom : top};
  }
};

int main() try {
  // It is a solid like any other, and is hollowed out.
  const crt::Entity vase = crt::Custom{.shape = std::make_shared<const Vase>()};
  const crt::Entity hollow = crt::Sphere{.center = {0, 0.62, 0}, .radius = 0.5};
  const crt::Material glaze{.color = crt::Color{0.1, 0.3, 0.5}, .specular = 0.5, .shininess = 60};

  crt::Scene scene;
  scene.entities = {
      (vase - hollow).with_material(glaze),
      crt::Plane{.position = {0, -1, 0}, .material = crt::Material{.color = crt::grey(0.5)}}};
  scene.lights = {crt::ParallelLight{.from = {-4, 6, -3}, .color = crt::grey(1.2)},
                  crt::PointLight{.origin = {3, 2, -4}, .color = crt::grey(0.4)}};
  scene.camera = {.position = {0, 2.2, -4.5}, .pointing = {0, -0.05, 0}, .fov = 0.55};
  scene.background = crt::GradientBackground{.horizon = {0.8, 0.84, 0.88}, .sky = {0.1, 0.2, 0.4}};
  scene.settings = {.width = 320, .height = 320, .supersampling = 3};
  crt::render(crt::prepare(scene)).write("vase.png");
} catch (const crt::Error& error) {
  std::cerr << "tutorial_custom: " << error.what() << '\n';
  return 1;
}
