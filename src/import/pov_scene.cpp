#include "import/pov_scene.hpp"

#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>
#include <utility>

#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr int image_width = 800;

double length_of_vector(const Vec3& v) {
  return elementary::hypot(v.x, v.y, v.z);
}
double product_of(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vec3 across_both(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

std::string light_color(const PovColor& c) {
  return text::format("rgb({}, {}, {})", number_text(std::max(c.red, 0.0)),
                      number_text(std::max(c.green, 0.0)), number_text(std::max(c.blue, 0.0)));
}

std::string plain_color(const PovColor& c) {
  const auto channel = [](double x) { return number_text(std::clamp(x, 0.0, 1000.0)); };
  return text::format("rgb({}, {}, {})", channel(c.red), channel(c.green), channel(c.blue));
}

/// Returns by how many degrees a sky leans to the side of a view.
double roll_of(const Vec3& view, const Vec3& sky) {
  const Vec3 up{0, 1, 0};
  const Vec3 right = across_both(up, view);
  const double length = length_of_vector(right);
  if (length < 1e-9 * length_of_vector(view)) return 0;
  const Vec3 sideways = right / length;
  const Vec3 upright = across_both(view, sideways) / length_of_vector(view);
  return elementary::atan2(product_of(sky, sideways), product_of(sky, upright)) *
         (180 / std::numbers::pi);
}

}  // namespace

void PovScene::read(const std::string& name, std::string text) {
  open(name, std::move(text));
  while (statement()) {
  }
}

bool PovScene::statement() {
  const PovToken token = peek();
  if (token.kind == PovToken::Kind::end) return false;
  if (take_sign(";")) return true;
  if (token.kind != PovToken::Kind::word) fail("a statement begins with a word");
  const PovValue* const value = find(token.text);
  if (is_object(token)) {
    PovObject made = object();
    // What has no texture has the default one.
    if (made.solid && !made.has_texture)
      made.solid = make_changed(made.solid, {"material " + material_of(default_)});
    std::vector<std::string> flags;
    if (made.no_shadow) flags.emplace_back("shadow false");
    if (made.no_image) flags.emplace_back("visible false");
    if (made.solid) solids_.push_back(make_changed(made.solid, flags));
    return true;
  }
  if (token.text == "camera") {
    camera();
  } else if (token.text == "light_source") {
    light_source();
  } else if (token.text == "background") {
    background();
  } else if (token.text == "sky_sphere") {
    sky_sphere();
  } else if (token.text == "global_settings") {
    global_settings();
  } else if (value && (value->get<double>() || value->get<PovVector>())) {
    // The value of a macro that nobody needs.
    expression();
  } else if (behind() && behind()->is_sign("{")) {
    take();
    notes().differs(token.place, text::format("'{}' is not understood", token.text));
    skip_braces();
  } else {
    fail(text::format("'{}' is not understood as a statement", token.text));
  }
  return true;
}

void PovScene::camera() {
  const Place at = place();
  take();
  expect("{", "behind 'camera'");
  if (has_camera_) notes().differs(at, "of several cameras the last one is taken");
  camera_ = {};
  has_camera_ = true;
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_sign(",")) continue;
    if (token.kind != PovToken::Kind::word) fail("a word is expected in a camera");
    const std::string& word = token.text;
    Vec3* const vector = word == "location"    ? &camera_.location
                         : word == "direction" ? &camera_.direction
                         : word == "right"     ? &camera_.right
                         : word == "up"        ? &camera_.up
                         : word == "sky"       ? &camera_.sky
                         : word == "look_at"   ? &camera_.look_at
                                               : nullptr;
    if (vector) {
      take();
      *vector = vec3();
      if (word == "look_at") camera_.has_look_at = true;
    } else if (word == "angle") {
      take();
      camera_.angle = float_expression();
      if (take_sign(",")) float_expression();
    } else if (word == "orthographic") {
      take();
      camera_.is_orthographic = true;
    } else if (word == "perspective") {
      take();
    } else if (const auto matrix = transform(word)) {
      const Vec3 base = map_point(*matrix, {0, 0, 0});
      if (!camera_.has_look_at) camera_.look_at = camera_.location + camera_.direction;
      camera_.location = map_point(*matrix, camera_.location);
      camera_.look_at = map_point(*matrix, camera_.look_at);
      camera_.has_look_at = true;
      const Vec3 sky = map_point(*matrix, camera_.sky) - base;
      if (sky != Vec3(0, 0, 0)) camera_.sky = sky;
    } else {
      unknown_word("a camera");
    }
  }
  if (!camera_.has_look_at) camera_.look_at = camera_.location + camera_.direction;
  if (camera_.look_at == camera_.location) camera_.look_at.z += 1;
  if (camera_.has_look_at &&
      product_of(across_both(camera_.up, camera_.direction), camera_.right) <= 0)
    notes().differs(at, "this camera mirrors the scene, and CRT's does not");
}

void PovScene::light_source() {
  take();
  expect("{", "behind 'light_source'");
  Vec3 origin = vec3();
  take_sign(",");
  const PovColor color = color_value();
  std::string kind = "PointLight";
  Vec3 target{0, 0, 0};
  double radius = 30, falloff = 45, size = 0, fade = 0;
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_sign(",")) continue;
    if (token.kind != PovToken::Kind::word) fail("a word is expected in a light");
    const std::string& word = token.text;
    if (word == "spotlight" || word == "cylinder" || word == "parallel") {
      take();
      kind = word == "spotlight"  ? "SpotLight"
             : word == "cylinder" ? "CylinderLight"
                                  : "ParallelLight";
    } else if (word == "point_at") {
      take();
      target = vec3();
    } else if (word == "radius" || word == "falloff" || word == "fade_distance") {
      take();
      const double number = float_expression();
      (word == "radius" ? radius : word == "falloff" ? falloff : fade) = number;
    } else if (word == "area_light") {
      take();
      const Vec3 a = vec3();
      take_sign(",");
      const Vec3 b = vec3();
      for (int i = 0; i < 2; ++i) {
        take_sign(",");
        float_expression();
      }
      size = std::max(length_of_vector(a), length_of_vector(b)) / 2;
      notes().differs(token.place, "this area_light is a ball of its size");
    } else if (word == "looks_like") {
      take();
      expect("{", "behind 'looks_like'");
      const PovToken name = peek();
      const PovValue* const value = name.kind == PovToken::Kind::word ? find(name.text) : nullptr;
      PovObject look;
      if (is_object(name)) {
        look = object();
      } else if (const PovObject* const known = value ? value->get<PovObject>() : nullptr) {
        look = *known;
        take();
      }
      expect("}", "behind what a light looks like");
      // It casts no shadow, and stands where the light is.
      if (look.solid)
        solids_.push_back(
            make_changed(look.solid, {"translate " + vector_text(origin), "shadow false"}));
    } else if (const auto matrix = transform(word)) {
      origin = map_point(*matrix, origin);
      target = map_point(*matrix, target);
    } else if (word == "shadowless" || word == "fade_power") {
      take();
      if (word == "fade_power")
        float_expression();
      else
        notes().differs(token.place, "a light without shadows is not understood: it has some");
    } else if (word == "adaptive" || word == "tightness" || word == "area_illumination") {
      take();
      float_expression();
    } else if (word == "jitter" || word == "circular" || word == "orient") {
      take();
    } else {
      unknown_word("a light");
    }
  }
  const bool is_aimed = kind != "PointLight";
  if (is_aimed && target == origin) target.z += 1;
  std::string light = kind + " { " + attribute(kind == "ParallelLight" ? "from" : "origin", origin);
  if (is_aimed) light += " " + attribute("pointing", target);
  light += " color -> " + light_color(color);
  if (kind == "SpotLight") {
    const double angle = std::clamp(2 * falloff, 0.01, 360.0);
    light += " " + attribute("angle", angle) + " " +
             attribute("penumbra", std::clamp(falloff - radius, 0.0, angle / 2));
  }
  if (kind == "CylinderLight") light += " " + attribute("radius", std::max(falloff, 1e-6));
  if (kind == "PointLight" && size > 0) light += " " + attribute("radius", size);
  if (fade > 0 && kind != "ParallelLight") light += " " + attribute("falloff", 2 * fade * fade);
  const double brightest = std::max({color.red, color.green, color.blue});
  // The first light brings the ambient light that surfaces have by default.
  if (lights_.empty() && brightest > 0)
    light += " " + attribute("ambient", default_.finish.ambient * ambient_light_ / brightest);
  lights_.push_back(light + " }");
}

void PovScene::background() {
  take();
  expect("{", "behind 'background'");
  background_ = "Background { color -> " + plain_color(color_value()) + " }";
  expect("}", "behind the colour of the background");
}

void PovScene::sky_sphere() {
  const Place at = place();
  take();
  expect("{", "behind 'sky_sphere'");
  PovPigment sky;
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_word("pigment")) {
      sky = pigment();
    } else if (token.kind != PovToken::Kind::word || !transform(token.text)) {
      unknown_word("a sky_sphere");
    }
  }
  if (sky.stops.size() < 2) {
    background_ = "Background { color -> " + plain_color(sky.color) + " }";
    return;
  }
  notes().differs(at, "of this sky the colours at the horizon and straight above are taken");
  background_ =
      text::format("Background {{ horizon -> {} sky -> {} }}",
                   plain_color(sky.stops.front().second), plain_color(sky.stops.back().second));
}

void PovScene::global_settings() {
  take();
  expect("{", "behind 'global_settings'");
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_sign(",")) continue;
    if (take_word("max_trace_level")) {
      max_trace_level_ = float_expression();
    } else if (take_word("assumed_gamma")) {
      assumed_gamma_ = take_word("srgb") ? 2.2 : float_expression();
    } else if (take_word("ambient_light")) {
      ambient_light_ = numbers(3)[0];
    } else if (token.kind == PovToken::Kind::word) {
      unknown_word("the global settings");
    } else {
      fail("a word is expected in the global settings");
    }
  }
}

std::string PovScene::settings() const {
  const double wide = std::max(length_of_vector(camera_.right), 1e-9);
  const double tall = std::max(length_of_vector(camera_.up), 1e-9);
  const double far = std::max(length_of_vector(camera_.direction), 1e-9);
  const int height =
      static_cast<int>(std::clamp(std::round(image_width * tall / wide), 1.0, 8192.0));
  const double half = std::clamp(camera_.angle, 0.01, 179.0) / 2 * (std::numbers::pi / 180);
  const double rise = camera_.angle > 0 ? elementary::tan(half) * tall / wide : tall / 2 / far;
  const double fov = 2 * elementary::atan(rise) * (180 / std::numbers::pi);
  // Old scenes are computed as they are shown. Others are in linear light.
  const bool is_linear = assumed_gamma_ > 0 ? assumed_gamma_ < 1.5 : version_ >= 3.7;
  std::string text =
      text::format("Settings {{\n    width -> {}\n    height -> {}\n    supersampling -> 2\n",
                   image_width, height);
  if (!is_linear) text += "    gamma -> 1\n";
  text += text::format("    recursiondepth -> {}\n",
                       static_cast<int>(std::clamp(max_trace_level_, 1.0, 256.0)));
  if (camera_.is_orthographic) text += "    projection -> \"orthographic\"\n";
  text += text::format("    camera -> Camera {{\n        position -> {}\n        pointing -> {}\n",
                       vector_text(camera_.location), vector_text(camera_.look_at));
  text += text::format("        fov -> {:.6g}\n", std::clamp(fov, 0.001, 179.0));
  const double roll = roll_of(camera_.look_at - camera_.location, camera_.sky);
  if (std::abs(roll) > 1e-6) text += text::format("        roll -> {:.6g}\n", roll);
  text += "    }\n";
  if (!lights_.empty()) {
    text += "    lights -> [\n";
    for (const std::string& light : lights_)
      text += "        " + light + (&light == &lights_.back() ? "\n" : ",\n");
    text += "    ]\n";
  }
  const std::string black = "Background { color -> rgb(0, 0, 0) }";
  return text + "    background -> " + (background_.empty() ? black : background_) + "\n}\n";
}

}  // namespace crt::importing
