// Solids touch, coincide, contain each other or overlap. These tests check which of them light is
// in, from all sides.
#include <doctest/doctest.h>

#include <algorithm>
#include <optional>

#include "support.hpp"

using namespace crt;
using namespace crt::test;

namespace {

constexpr double float_precision = 1e-6;

/// Returns Fresnel's reflectance between two media, for the sine of the angle in the first.
double reflectance(double n1, double n2, double sine) {
  const double cosine1 = std::sqrt(1 - sine * sine);
  const double cosine2 = std::sqrt(1 - std::pow(n1 / n2 * sine, 2));
  const double across = (n1 * cosine1 - n2 * cosine2) / (n1 * cosine1 + n2 * cosine2);
  const double within = (n2 * cosine1 - n1 * cosine2) / (n2 * cosine1 + n1 * cosine2);
  return 0.5 * (across * across + within * within);
}

/// Returns the weight of the straight path from `eye` towards `target` to a tiny ball at `goal`:
/// what a white world loses if the ball is there and black.
double weight_of_way(Scene scene, const Vec3& eye, const Vec3& target, const Vec3& goal) {
  scene.background = SolidBackground{{1, 1, 1}};
  const double without = seen(scene, eye, target).r;
  scene.entities.push_back(Sphere{.center = goal, .radius = 1e-7, .material = inert()});
  return without - seen(scene, eye, target).r;
}

struct Layer {
  double thickness;
  double index;
};

}  // namespace

TEST_CASE(
    "light through touching slabs bends by Snell's law from each to the next, from both sides") {
  const std::vector<Layer> layers = {{0.7, 1.5}, {1.1, 1.33}, {0.4, 1.5}, {0.9, 1.7}};
  Random random(1);
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    for (int round = 0; round < 40; ++round) {
      const Vec3 angles(random.between(0, 360), random.between(0, 360), random.between(0, 360));
      const Transform turned = rotate_degrees(angles);
      const Transform moved = translate(random.between(0, 100) * random.direction());
      const auto place = [&](const Vec3& p) { return apply(moved, apply(turned, p)); };
      Scene scene = dark_scene();
      scene.settings.precision = precision;
      scene.settings.recursion_depth = static_cast<int>(layers.size()) + 1;
      double height = 0;
      // If written alike, faces that touch are one surface. In every other round each slab gets to
      // its place by another transform, and faces that touch are a rounding apart.
      const bool alike = round % 4 < 2;
      for (const Layer& layer : layers) {
        const double low = alike ? height : 0;
        Entity slab = Box{.corner_a = {-50, low, -50},
                          .corner_b = {50, low + layer.thickness, 50},
                          .material = glass(layer.index)};
        if (!alike) slab = slab.transformed(translate({0, height, 0}));
        if (!alike && scene.entities.size() % 2 == 0) {
          slab = slab.transformed(rotate_degrees({angles.x, 0, 0}))
                     .transformed(rotate_degrees({0, angles.y, 0}));
          slab = slab.transformed(rotate_degrees({0, 0, angles.z}));
        } else {
          slab = slab.transformed(turned);
        }
        scene.entities.push_back(slab.transformed(moved));
        height += layer.thickness;
      }
      if (round % 2 == 1) std::reverse(scene.entities.begin(), scene.entities.end());

      const double angle = random.between(0, 1.5);
      const double sine = std::sin(angle);
      for (const bool upwards : {true, false}) {
        // The path is in the slabs' own space, along x and y.
        double x = 0;
        double weight = 1;
        double index = 1;
        std::vector<Layer> path = layers;
        if (!upwards) std::reverse(path.begin(), path.end());
        for (const Layer& layer : path) {
          weight *= 1 - reflectance(index, layer.index, sine / index);
          index = layer.index;
          x += layer.thickness * std::tan(std::asin(sine / index));
        }
        weight *= 1 - reflectance(index, 1, sine / index);
        const double start = upwards ? 0 : height;
        const double sense = upwards ? 1 : -1;
        const Vec3 direction(sine, sense * std::cos(angle), 0);
        const Vec3 first(0, start, 0);
        const Vec3 last(x, start + sense * height, 0);
        const double found = weight_of_way(scene, place(first - 2.0 * direction), place(first),
                                           place(last + 2.0 * direction));
        CAPTURE(round);
        CAPTURE(upwards);
        CHECK(found == doctest::Approx(weight).epsilon(float_precision));
      }
    }
  }
}

TEST_CASE("light through a shell that is filled to the brim bends as in concentric spheres") {
  // n r sin(angle) is constant along the path (Bouguer).
  const double outer = 1;
  const double inner = 0.7;
  Random random(2);
  for (int round = 0; round < 60; ++round) {
    const Transform turned =
        rotate_degrees({random.between(0, 360), random.between(0, 360), random.between(0, 360)});
    const Vec3 center = round % 3 == 0 ? Vec3(0) : 30.0 * random.direction();
    const Entity shell = Entity(Sphere{.radius = outer, .material = glass(1.5)}) -
                         Entity(Sphere{.radius = inner, .material = glass(1.5)});
    const Entity filling = Sphere{.radius = inner, .material = glass(1.33)};
    Scene scene = dark_scene();
    scene.settings.recursion_depth = 5;
    scene.entities = {shell, filling};
    if (round % 2 == 1) scene.entities = {filling, shell};
    for (Entity& entity : scene.entities) {
      entity = entity.transformed(turned).transformed(translate(center));
    }
    const double b = random.between(0, 0.65);  // below the inner radius: through all
    const double angle_outside = std::asin(b / outer);
    const double angle_shell = std::asin(b / (1.5 * outer));
    const double angle_shell_inside = std::asin(b / (1.5 * inner));
    const double angle_filling = std::asin(b / (1.33 * inner));
    // The angle goes around the centre from where the ray comes in to where it goes out.
    const double around_shell = angle_shell_inside - angle_shell;
    const double around_filling = std::numbers::pi - 2 * angle_filling;
    const double around = 2 * around_shell + around_filling;
    const Vec3 u = random.direction();
    const Vec3 v = across(u);
    const auto rim = [&](double angle) {
      return center + outer * (std::cos(angle) * u + std::sin(angle) * v);
    };
    const auto heading = [&](double out_of_radius, double at) {
      return std::cos(out_of_radius) * (rim(at) - center) +
             std::sin(out_of_radius) * (std::cos(at) * v - std::sin(at) * u);
    };
    const Vec3 in = -heading(-angle_outside, 0);
    const Vec3 out = heading(angle_outside, around);
    const double f_out = reflectance(1, 1.5, std::sin(angle_outside));
    const double f_in = reflectance(1.5, 1.33, std::sin(angle_shell_inside));
    const double weight = std::pow((1 - f_out) * (1 - f_in), 2);
    CAPTURE(round);
    CHECK(weight_of_way(scene, rim(0) - 2.0 * in, rim(0), rim(around) + 2.0 * out) ==
          doctest::Approx(weight).epsilon(float_precision));
    // The reverse path has the same weight.
    CHECK(weight_of_way(scene, rim(around) + 2.0 * out, rim(around), rim(0) - 2.0 * in) ==
          doctest::Approx(weight).epsilon(float_precision));
  }
}

namespace {

/// Fogs are boxes of fogs of index 1 on a grid of whole numbers, turned and moved all together.
struct Fogs {
  struct Fog {
    Vec3 low;
    Vec3 high;
    double absorption;
  };
  std::vector<Fog> fogs;
  Transform turned;
  Vec3 moved{0, 0, 0};

  Scene scene() const {
    Scene scene = dark_scene();
    scene.settings.recursion_depth = 256;
    for (const Fog& fog : fogs) {
      Material material = glass(1);
      material.absorption = grey(fog.absorption);
      scene.entities.push_back(
          Entity(Box{.corner_a = fog.low, .corner_b = fog.high, .material = material})
              .transformed(turned)
              .transformed(translate(moved)));
    }
    return scene;
  }

  Vec3 place(const Vec3& p) const { return apply(turned, p) + moved; }
};

struct Span {
  double enter;
  double leave;
};

std::optional<Span> span(const Fogs::Fog& fog, const Vec3& origin, const Vec3& direction) {
  Span result{-1e9, 1e9};
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (fog.low[axis] - origin[axis]) / direction[axis];
    const double b = (fog.high[axis] - origin[axis]) / direction[axis];
    result.enter = std::max(result.enter, std::min(a, b));
    result.leave = std::min(result.leave, std::max(a, b));
  }
  if (result.leave - result.enter < 1e-9) return std::nullopt;
  return result;
}

/// Returns the optical depth along the line from t = 0 to `end` by the rule as docs/image.md has
/// it. It returns nothing where the rule goes in circles among three solids, or the line passes an
/// edge.
std::optional<double> optical_depth(const Fogs& scene, const Vec3& origin, const Vec3& direction,
                                    double end) {
  constexpr double same = 1e-9;
  std::vector<std::optional<Span>> spans;
  std::vector<double> cuts = {0, end};
  for (const Fogs::Fog& fog : scene.fogs) {
    spans.push_back(span(fog, origin, direction));
    if (!spans.back()) continue;
    cuts.push_back(spans.back()->enter);
    cuts.push_back(spans.back()->leave);
  }
  const auto is_inner = [&](std::size_t a, std::size_t b) {
    const Span& x = *spans[a];
    const Span& y = *spans[b];
    const bool in_y = x.enter > y.enter - same && x.leave < y.leave + same;
    const bool in_x = y.enter > x.enter - same && y.leave < x.leave + same;
    return in_y != in_x ? in_y : a > b;
  };
  std::sort(cuts.begin(), cuts.end());
  double depth = 0;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    const double middle = 0.5 * (cuts[i] + cuts[i + 1]);
    if (cuts[i] < -same || cuts[i + 1] > end + same || cuts[i + 1] - cuts[i] < same) continue;
    std::vector<std::size_t> around;
    for (std::size_t k = 0; k < spans.size(); ++k) {
      if (spans[k] && spans[k]->enter < middle && middle < spans[k]->leave) around.push_back(k);
    }
    if (around.empty()) continue;
    std::optional<std::size_t> innermost;
    for (const std::size_t a : around) {
      if (std::all_of(around.begin(), around.end(),
                      [&](std::size_t b) { return a == b || is_inner(a, b); })) {
        innermost = a;
      }
    }
    if (!innermost) return std::nullopt;
    depth += scene.fogs[*innermost].absorption * (cuts[i + 1] - cuts[i]);
  }
  return depth;
}

Fogs random_fogs(Random& random, int count) {
  Fogs result;
  for (int i = 0; i < count; ++i) {
    Fogs::Fog fog{Vec3(0), Vec3(0), random.between(0.02, 0.5)};
    for (int axis = 0; axis < 3; ++axis) {
      const int low = random.integer(-3, 1);
      fog.low[axis] = low;
      fog.high[axis] = random.integer(low + 1, 3);
    }
    result.fogs.push_back(fog);
  }
  result.turned =
      rotate_degrees({random.between(0, 360), random.between(0, 360), random.between(0, 360)});
  result.moved = 10.0 * random.direction();
  return result;
}

}  // namespace

TEST_CASE(
    "what lies around light does not depend on its sense, nor on whether it is seen or casts a "
    "shadow") {
  Random random(3);
  int compared = 0;
  for (int round = 0; round < 1500; ++round) {
    Fogs fogs = random_fogs(random, random.integer(2, 5));
    // These fogs are outside alone: nothing starts within one.
    const Vec3 direction = random.direction();
    const Vec3 middle(random.between(-2, 2), random.between(-2, 2), random.between(-2, 2));
    const double half_length = 12;
    const Vec3 origin = middle - half_length * direction;
    const std::optional<double> depth = optical_depth(fogs, origin, direction, 2 * half_length);
    if (!depth) continue;
    ++compared;
    Scene scene = fogs.scene();
    scene.settings.precision = round % 2 == 0 ? Precision::standard : Precision::exact;
    const Vec3 from = fogs.place(origin);
    const Vec3 to = fogs.place(middle + half_length * direction);
    const double expected = std::exp(-*depth);
    CAPTURE(round);

    scene.background = SolidBackground{{1, 1, 1}};
    CHECK(seen(scene, from, to).r == doctest::Approx(expected).epsilon(float_precision));
    CHECK(seen(scene, to, from).r == doctest::Approx(expected).epsilon(float_precision));

    // A white disc stands at the far end, lit along the line and seen from beside it.
    scene.background = SolidBackground{{0, 0, 0}};
    const Vec3 towards = glm::normalize(from - to);
    scene.lights = {PointLight{.origin = from}};
    scene.entities.push_back(Disc{
        .center = to, .normal = towards, .radius = 1e-3, .material = Material{.color = grey(1)}});
    CHECK(seen(scene, to + 1e-2 * (towards + across(towards)), to).r ==
          doctest::Approx(expected).epsilon(float_precision));
  }
  CHECK(compared > 1300);
}

TEST_CASE("a camera and a light within solids that coincide and overlap know what is around them") {
  Random random(4);
  int compared = 0;
  for (int round = 0; round < 600; ++round) {
    Fogs fogs = random_fogs(random, random.integer(2, 4));
    const Vec3 origin(random.between(-2.5, 2.5), random.between(-2.5, 2.5),
                      random.between(-2.5, 2.5));
    const Vec3 end(random.between(-2.5, 2.5), random.between(-2.5, 2.5), random.between(-2.5, 2.5));
    const double length = glm::length(end - origin);
    const std::optional<double> depth =
        optical_depth(fogs, origin, (end - origin) / length, length);
    if (!depth) continue;
    ++compared;
    Scene scene = fogs.scene();
    const Vec3 from = fogs.place(origin);
    const Vec3 to = fogs.place(end);
    const Vec3 towards = glm::normalize(from - to);
    // A white screen stands within the fogs, seen along the light's own path, which counts twice.
    scene.lights = {PointLight{.origin = from}};
    scene.entities.push_back(Disc{
        .center = to, .normal = towards, .radius = 1e-3, .material = Material{.color = grey(1)}});
    CAPTURE(round);
    const double expected = std::exp(-*depth);
    CHECK(seen(scene, from, to).r == doctest::Approx(expected * expected).epsilon(float_precision));
  }
  CHECK(compared > 400);
}
