// These tests compare pictures of random solids, most of whose faces coincide, with a tracer that
// knows no surface a ray starts on: it lifts the start by a hair. Where two hairs of different size
// agree the picture must as well.
#include <doctest/doctest.h>

#include "extremes/support.hpp"
#include "support/solids.hpp"

using namespace crt;
using namespace crt::test;

namespace {

struct Paint {
  Color color;
  double reflectivity;
};

class HairTracer {
 public:
  HairTracer(const Scene& scene, std::vector<Paint> paints, double hair)
      : scene_(scene), paints_(std::move(paints)), hair_(hair), queries_(prepare(scene)) {}

  /// Returns the red light along a ray.
  double red(const Ray& ray, int bounces) {
    const std::optional<Hit> hit = queries_.intersect(ray);
    if (!hit) return background;
    const Paint& paint = paints_[hit->entity_id];
    const Vec3 normal = hit->entering ? hit->normal : -hit->normal;
    const Vec3 start = hit->position + hair_ * normal;
    double light = 0;
    for (const Light& light_source : scene_.lights) {
      const Vec3 offset = std::get<PointLight>(light_source).origin - hit->position;
      const double cosine = glm::dot(offset, normal) / glm::length(offset);
      if (cosine <= 0 || queries_.occluded({.origin = start, .direction = offset, .t_max = 1}))
        continue;
      light += paint.color.r * (1 - paint.reflectivity) * cosine;
    }
    if (bounces == 0) return light;
    const Vec3 mirrored = ray.direction - 2 * glm::dot(ray.direction, normal) * normal;
    return light + paint.reflectivity * red({.origin = start, .direction = mirrored}, bounces - 1);
  }

  static constexpr double background = 0.25;

 private:
  const Scene& scene_;
  std::vector<Paint> paints_;
  double hair_;
  RayQueries queries_;
};

/// Returns a solid on the grid: a tree of the maker's, or a cone or torus that it cuts.
Entity random_solid(SolidMaker& maker) {
  const int kind = maker.integer(0, 3);
  if (kind > 1) return maker.tree(2).entity();
  const Vec3 a = maker.grid_point();
  const double size = maker.integer(1, 3);
  const Entity round =
      kind == 0
          ? Entity(Cone{.from = a,
                        .to = a + Vec3(0, maker.integer(1, 4), 0),
                        .radius = size,
                        .radius2 = static_cast<double>(maker.integer(0, 3))})
          : Entity(Torus{.center = a, .radius = size, .thickness = 0.5 * maker.integer(1, 4)});
  const Entity other = maker.tree(1).entity();
  const int operation = maker.integer(0, 3);
  if (operation == 0) return round;
  if (operation == 1) return round - other;
  return operation == 2 ? other - round : round + other;
}

constexpr int bounces = 2;

/// A Count has the pixels that both hairs agree on, and those of them where the picture differs.
struct Count {
  int agreed = 0;
  int wrong = 0;
};

Count compare(const Scene& scene, const std::vector<Paint>& paints, double size) {
  constexpr double tolerance = 1e-4;
  HairTracer coarse(scene, paints, 1e-6 * size);
  HairTracer fine(scene, paints, 1e-8 * size);
  const Image image = render(prepare(scene), {.threads = 1});
  Count count;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const Ray ray = pixel_ray(scene, x, y);
      const double expected = fine.red(ray, bounces);
      if (std::abs(expected - coarse.red(ray, bounces)) > tolerance) continue;
      ++count.agreed;
      if (std::abs(image.at(x, y).r - expected) > tolerance) ++count.wrong;
    }
  }
  return count;
}

}  // namespace

TEST_CASE("pictures of random solids with coincident faces are those of rays lifted by a hair") {
  SolidMaker maker(20);
  Random random(20);
  int agreed = 0;
  for (int round = 0; round < 120; ++round) {
    Scene scene = dark_scene();
    scene.background = SolidBackground{grey(HairTracer::background)};
    scene.settings.width = 32;
    scene.settings.height = 32;
    scene.settings.recursion_depth = bounces;
    scene.settings.precision = round % 2 == 0 ? Precision::standard : Precision::exact;
    const double size = std::ldexp(1.0, random.integer(-60, 60));
    Transform placed = round % 3 == 0
                           ? Transform{}
                           : rotate_degrees({random.between(0, 360), random.between(0, 360), 0});
    placed.translation = random.between(0, 20) * random.direction();
    std::vector<Paint> paints;
    for (int i = 0; i < 3; ++i) {
      paints.push_back({grey(random.between(0.2, 1)), random.integer(0, 1) * 0.4});
      const Material material{.color = paints.back().color,
                              .reflectivity = paints.back().reflectivity};
      scene.entities.push_back(
          random_solid(maker).with_material(material).transformed(placed).transformed(scale(size)));
    }
    const auto place = [&](const Vec3& p) { return size * apply(placed, p); };
    scene.lights = {PointLight{.origin = place(9.0 * random.direction())},
                    PointLight{.origin = place(random.between(0, 4) * random.direction())}};
    scene.camera = {.position = place(random.between(2, 12) * random.direction()),
                    .pointing = place(Vec3(0))};
    const Count count = compare(scene, paints, size);
    agreed += count.agreed;
    CAPTURE(round);
    CHECK(count.wrong == 0);
  }
  CHECK(agreed > 100'000);
}
