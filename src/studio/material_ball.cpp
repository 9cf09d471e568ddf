#include "studio/material_ball.hpp"

#include <algorithm>
#include <crt/error.hpp>
#include <crt/prepared_scene.hpp>
#include <crt/render.hpp>
#include <crt/script.hpp>
#include <string_view>

#include "text/base64.hpp"

namespace crt::studio {

namespace {

/// The ball's variables are computed within this, and else there is no ball.
constexpr std::uint64_t most_steps = 1'000'000;

constexpr std::string_view stage = R"(
Settings {
    width -> 112 height -> 112 supersampling -> 3 recursiondepth -> 6
    camera -> Camera { position -> vec3(0, 0.35, -3.2) pointing -> vec3(0, 0, 0) fov -> 42 }
    lights -> [
        ParallelLight {
            from -> vec3(-2, 3, -2) pointing -> vec3(0, 0, 0) color -> rgb(0.9, 0.9, 0.9)
            ambient -> 0.2
        }
    ]
    background -> Background { horizon -> rgb(0.75, 0.78, 0.82) sky -> rgb(0.35, 0.5, 0.75) }
}
Scene {
    Plane {
        normal -> vec3(0, 1, 0) position -> vec3(0, -1, 0)
        material -> Material {
            color -> Checker {
                colorA -> rgb(0.6, 0.6, 0.6) colorB -> rgb(0.35, 0.35, 0.35) scale -> 0.5 } }
    }
    Sphere { center -> vec3(0, 0, 0) radius -> 1 material -> )";

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
  const auto node = std::find_if(tree.begin(), tree.end(), [&](const ScriptNode& candidate) {
    return candidate.kind == NodeKind::object && candidate.name == "Material" &&
           candidate.span.begin == byte;
  });
  if (node == tree.end()) return std::nullopt;
  ScriptOptions options;
  options.limits.steps = most_steps;
  try {
    const ScriptResult result = run_script(script_of_ball(text, tree, node->span), name, options);
    if (!result.scene) return std::nullopt;
    const Image image = render(prepare(*result.scene), RenderOptions{.threads = 1});
    return text::base64(image.encode("png", {.reproducible = true}));
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace crt::studio
