#include "studio/material_ball.hpp"

#include <algorithm>
#include <crt/error.hpp>
#include <crt/prepared_scene.hpp>
#include <crt/render.hpp>
#include <crt/script.hpp>
#include <string_view>

#include "studio/view_mode.hpp"
#include "text/base64.hpp"

namespace crt::studio {

namespace {

/// The ball's variables are computed within this, and else there is no ball.
constexpr std::uint64_t most_steps = 1'000'000;

/// Rough mirrors are smooth after some samples, and a ball must not take long.
constexpr int most_samples = 32;

/// The light is that of ViewMode::material.
constexpr std::string_view stage = R"(
Settings {
    width -> 112 height -> 112 recursiondepth -> 6
    camera -> Camera { position -> vec3(0, 0.35, -3.2) pointing -> vec3(0, 0, 0) fov -> 42 }
}
Scene {
    Plane {
        normal -> vec3(0, 1, 0) position -> vec3(0, -1, 0)
        material -> Material {
            color -> Checker {
                colorA -> rgb(0.6, 0.6, 0.6) colorB -> rgb(0.35, 0.35, 0.35) scale -> 0.5 } }
    }
    Sphere { center -> vec3(0, 0, 0) radius -> 1 material -> )";

/// Returns the place of the material that begins at a byte, be it an object, derived, or what an
/// attribute takes.
std::optional<TextSpan> material_at(const std::vector<ScriptNode>& tree, std::uint32_t byte) {
  for (const ScriptNode& node : tree) {
    const bool is_material =
        node.name == "Material" || node.name == "PrincipledMaterial" || !node.base.empty();
    if (node.kind == NodeKind::object && is_material && node.span.begin == byte) return node.span;
    for (const ScriptAttribute& attribute : node.attributes) {
      if (attribute.name == "material" && attribute.value_span.begin == byte)
        return attribute.value_span;
    }
  }
  return std::nullopt;
}

/// Returns the script with the ball in place of its own scene.
std::string script_of_ball(std::string text, const std::vector<ScriptNode>& tree,
                           TextSpan material) {
  const std::string own = text.substr(material.begin, material.end - material.begin);
  for (const ScriptNode& node : tree) {
    if (node.kind != NodeKind::scene && node.kind != NodeKind::settings) continue;
    std::fill(text.begin() + node.span.begin, text.begin() + node.span.end, ' ');
  }
  return text.append(stage).append(own).append(" }\n}\n");
}

}  // namespace

std::optional<std::string> material_ball(const std::string& text, const std::string& name,
                                         const std::vector<ScriptNode>& tree, std::uint32_t byte) {
  const std::optional<TextSpan> place = material_at(tree, byte);
  if (!place) return std::nullopt;
  ScriptOptions options;
  options.limits.steps = most_steps;
  try {
    const ScriptResult result = run_script(script_of_ball(text, tree, *place), name, options);
    if (!result.scene) return std::nullopt;
    const Camera camera = result.scene->camera;
    Scene scene = scene_in_mode(*result.scene, ViewMode::material, camera);
    scene.settings.max_samples = most_samples;
    const Image image = render(prepare(scene), RenderOptions{.threads = 1});
    return text::base64(image.encode("png", {.reproducible = true}));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace crt::studio
