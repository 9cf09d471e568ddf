#include "studio/view_mode.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace crt::studio {

namespace {

/// Cuts have a colour of their own, as in drawings of sections.
constexpr Color cut_color = {0.85, 0.32, 0.2};
constexpr Color clay_color = {0.7, 0.7, 0.7};
/// What a mode shows is near enough for looking, in what a display shows.
constexpr double target_error = 4.0 / 255;
constexpr int min_samples = 8;
constexpr int max_samples = 128;
/// Mirrors and glass are followed so far, which shows what is in front of them and behind them.
constexpr int most_bounces = 6;
/// The panorama has so many rows. All in it is soft.
constexpr int panorama_rows = 64;

/// A FarLight shines from a direction: x is to the right of a camera, y up, and z ahead.
struct FarLight {
  Vec3 from;
  double strength;  ///< of a parallel light
};

/// These light materials. They are points, so that highlights have no noise, and throw no shadows.
/// The panorama has them as well, for mirrors.
constexpr std::array<FarLight, 4> studio_lights = {{{{-0.75, 0.8, -0.6}, 0.6},
                                                    {{0.95, 0.25, -0.35}, 0.25},
                                                    {{0.35, 0.55, 0.9}, 0.3},
                                                    {{0, -0.6, -0.8}, 0.1}}};
constexpr double studio_ambient = 0.2;
/// In the panorama each is a spot, white up to the first angle in radians, which fades up to the
/// second.
constexpr double spot_inner = 0.2;
constexpr double spot_outer = 0.4;
constexpr double spot_radiance = 5;

/// These light clay: parts of a sky, each as wide as the angle.
constexpr std::array<FarLight, 5> sky_lights = {{{{0, 1, 0}, 0.4},
                                                 {{-0.8, 0.7, -0.6}, 0.45},
                                                 {{0.8, 0.6, -0.6}, 0.25},
                                                 {{-0.8, 0.6, 0.6}, 0.12},
                                                 {{0.8, 0.6, 0.6}, 0.18}}};
constexpr double sky_light_angle = 0.9;
constexpr double sky_ambient = 0.06;
/// The camera's own light shows shapes where no sky is seen, as in rooms.
constexpr Color camera_light_color = {0.35, 0.35, 0.35};

double length_of(const Vec3& v) {
  return std::hypot(v.x, v.y, v.z);
}

double smooth_step(double low, double high, double x) {
  const double share = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return share * share * (3 - 2 * share);
}

/// Returns the light of the studio from a direction: soft from above, dark below, and spots.
double studio_light(const Vec3& direction) {
  double light = 0.1 + 0.45 * smooth_step(-0.6, 0.9, direction.y);
  for (const auto& [from, strength] : studio_lights) {
    const double along = from.x * direction.x + from.y * direction.y + from.z * direction.z;
    const double angle = std::acos(std::clamp(along / length_of(from), -1.0, 1.0));
    light += spot_radiance * strength * (1 - smooth_step(spot_inner, spot_outer, angle));
  }
  return light;
}

std::shared_ptr<const Image> studio_panorama() {
  auto image = std::make_shared<Image>(2 * panorama_rows, panorama_rows);
  for (int row = 0; row < image->height(); ++row) {
    const double height = std::numbers::pi * (0.5 - (row + 0.5) / image->height());
    for (int column = 0; column < image->width(); ++column) {
      const double turn = 2 * std::numbers::pi * ((column + 0.5) / image->width() - 0.5);
      const Vec3 direction{std::cos(height) * std::sin(turn), std::sin(height),
                           std::cos(height) * std::cos(turn)};
      image->set(column, row, grey(studio_light(direction)));
    }
  }
  return image;
}

/// Adds parallel lights as wide as an angle, turned about y. The first has an ambient share that
/// makes so much of white.
void add_lights(std::vector<Light>& lights, std::span<const FarLight> far_lights, double turn,
                double angle, double ambient) {
  for (const auto& [from, strength] : far_lights) {
    const Vec3 turned{std::cos(turn) * from.x + std::sin(turn) * from.z, from.y,
                      std::cos(turn) * from.z - std::sin(turn) * from.x};
    lights.emplace_back(ParallelLight{.from = turned,
                                      .pointing = {0, 0, 0},
                                      .color = grey(strength),
                                      .ambient = lights.empty() ? ambient / strength : 0,
                                      .angle = angle});
  }
}

Light light_at(const Camera& camera) {
  if (camera.projection != Projection::orthographic)
    return PointLight{.origin = camera.position, .color = camera_light_color};
  return ParallelLight{
      .from = camera.position, .pointing = camera.pointing, .color = camera_light_color};
}

/// Returns light that is white at most.
Color dimmed(const Color& light) {
  const auto most = std::max({light.r, light.g, light.b});
  return most > 1 ? Color{light.r / most, light.g / most, light.b / most} : light;
}

/// Lets a material show that it gives off light, and light others no more than a white one does.
SharedMaterial with_dimmed_light(const SharedMaterial& material) {
  if (const PrincipledMaterial* const principled = material.principled()) {
    const Color* const emission = std::get_if<Color>(&principled->emission);
    if (emission == nullptr || dimmed(*emission) == *emission) return material;
    PrincipledMaterial dim = *principled;
    dim.emission = dimmed(*emission);
    return dim;
  }
  if (dimmed(material->emission) == material->emission) return material;
  Material dim = *material;
  dim.emission = dimmed(dim.emission);
  return dim;
}

/// Lets the scene take the light of a mode, and no more time than that needs.
void simplify(Scene& scene) {
  scene.camera.aperture = scene.camera.lens_radius = 0;
  Settings& settings = scene.settings;
  settings.dof_samples = 1;
  settings.target_error = target_error;
  settings.time_budget = 0;
  settings.min_samples = min_samples;
  settings.max_samples = max_samples;
  settings.light_samples = 1;
  settings.recursion_depth = std::min(settings.recursion_depth, most_bounces);
  settings.indirect = 0;
  settings.clamp = 0;
  settings.ambient_model = AmbientModel::surface;
  settings.exposure = 0;
  settings.tone_map = ToneMap::none;
  settings.show_clip = false;
}

}  // namespace

const SharedMaterial& cut_material() {
  static const SharedMaterial material(Material{.color = cut_color});
  return material;
}

Scene scene_in_mode(Scene scene, ViewMode mode, const Camera& front) {
  if (mode == ViewMode::rendered) return scene;
  const Vec3 ahead = front.pointing - front.position;
  const double turn = std::atan2(ahead.x, ahead.z);
  scene.lights.clear();
  simplify(scene);
  if (mode == ViewMode::clay) {
    add_lights(scene.lights, sky_lights, turn, sky_light_angle, sky_ambient);
    scene.lights.push_back(light_at(scene.camera));
    scene.background = GradientBackground{.horizon = grey(0.3), .sky = grey(0.5)};
    return scene;
  }
  static const std::shared_ptr<const Image> panorama = studio_panorama();
  add_lights(scene.lights, studio_lights, turn, 0, studio_ambient);
  // A panorama of 2015 turns the other way.
  scene.background =
      PanoramaBackground{.image = panorama, .angle = scene.settings.compat == 0 ? -turn : turn};
  for (Entity& entity : scene.entities) entity = entity.with_shadow(false);
  return scene;
}

std::function<SharedMaterial(const SharedMaterial&)> materials_of(ViewMode mode) {
  if (mode == ViewMode::rendered) return {};
  if (mode == ViewMode::material)
    return [](const SharedMaterial& material) { return with_dimmed_light(material); };
  return [](const SharedMaterial& material) {
    static const SharedMaterial clay(Material{.color = clay_color});
    return &*material == &*cut_material() ? material : clay;
  };
}

}  // namespace crt::studio
