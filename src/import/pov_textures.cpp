// Textures of POV-Ray become materials.
#include <algorithm>
#include <cmath>
#include <utility>

#include "import/pov_pigment.hpp"
#include "import/pov_scene.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

PovColor times(const PovColor& c, double factor) {
  return {c.red * factor, c.green * factor, c.blue * factor, c.filter, c.transmit};
}

/// Is how much light a colour lets through.
double clearness(const PovColor& c) {
  return std::clamp(c.filter + c.transmit, 0.0, 1.0);
}

}  // namespace

bool PovScene::texture_word(PovObject& object, PovTexture& texture, const std::string& word) {
  (void)object;
  if (word == "texture" || word == "material" || word == "interior" || word == "normal") {
    take();
    if (word == "texture") read_texture(texture);
    if (word == "material") read_material(texture);
    if (word == "interior") read_interior(texture);
    if (word == "normal") read_normal(texture);
    return true;
  }
  if (word == "pigment") {
    take();
    expect("{", "behind 'pigment'");
    read_pigment(texture.pigment);
    texture.has_pigment = true;
    return true;
  }
  if (word == "finish") {
    take();
    read_finish(texture.finish);
    return true;
  }
  if (word == "color" || word == "colour" || word == "rgb" || word == "rgbf" || word == "rgbt") {
    const Place at = place();
    texture.pigment = {.color = color_value()};
    texture.has_pigment = true;
    notes().differs(at, "a colour outside of a pigment is taken for one");
    return true;
  }
  return false;
}

void PovScene::read_texture(PovTexture& texture) {
  expect("{", "behind 'texture'");
  std::vector<PovTexture> parts;  // of a pattern of textures
  bool is_checker = false;
  bool is_in_tiles = false;  // which have brackets of their own
  double scale = 1;
  for (;;) {
    const PovToken token = peek();
    if (take_sign("}")) {
      if (!std::exchange(is_in_tiles, false)) break;
      continue;
    }
    if (take_sign(",")) continue;
    if (const std::optional<PovValue> held = element()) {
      if (!held->get<PovTexture>()) fail("this element is no texture");
      texture = *held->get<PovTexture>();
      continue;
    }
    if (token.kind != PovToken::Kind::word) fail("a word is expected in a texture");
    const PovValue* const value = find(token.text);
    PovObject ignored;
    if (const PovTexture* const known = value ? value->get<PovTexture>() : nullptr) {
      take();
      texture = *known;
      texture_name_ = token.text;
    } else if ((value && value->get<PovUnknown>()) || token.is_word("tile2")) {
      take();
    } else if (pov_pattern(token.text) || token.is_word("tiles")) {
      take();
      is_checker = token.text == "checker" || token.text == "tiles";
      if (!is_checker)
        notes().differs(token.place, "of a pattern of textures the first one is taken");
      if (token.text == "gradient") vec3();
      if (token.text == "tiles") is_in_tiles = take_sign("{");
    } else if (token.is_word("texture")) {
      take();
      read_texture(parts.emplace_back(default_));
    } else if (!texture_word(ignored, texture, token.text)) {
      const auto matrix = transform(token.text);
      if (!matrix) unknown_word("a texture");
      if (matrix) scale *= mean_scale(*matrix);
    }
  }
  if (parts.empty()) return;
  texture = parts.front();
  if (!is_checker || parts.size() < 2) return;
  const Vec3 offset = Vec3(-1e-6, -1e-6, -1e-6) * scale;
  texture.pigment.pattern = checker_text(parts[0].pigment.color, parts[1].pigment.color) +
                            (scale == 1 ? "" : " " + attribute("scale", scale)) + " " +
                            attribute("offset", offset) + " }";
}

void PovScene::read_material(PovTexture& texture) {
  expect("{", "behind 'material'");
  while (!take_sign("}")) {
    const PovToken token = peek();
    const PovValue* const value = token.kind == PovToken::Kind::word ? find(token.text) : nullptr;
    PovObject ignored;
    if (const PovTexture* const known = value ? value->get<PovTexture>() : nullptr) {
      take();
      texture = *known;
      texture_name_ = token.text;
    } else if (token.kind != PovToken::Kind::word) {
      fail("a word is expected in a material");
    } else if (!texture_word(ignored, texture, token.text) && !transform(token.text)) {
      unknown_word("a material");
    }
  }
}

void PovScene::read_finish(PovFinish& finish) {
  expect("{", "behind 'finish'");
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_sign(",")) continue;
    if (token.kind != PovToken::Kind::word) fail("a word is expected in a finish");
    const PovValue* const value = find(token.text);
    if (const PovFinish* const known = value ? value->get<PovFinish>() : nullptr) {
      take();
      finish = *known;
      continue;
    }
    const auto number = [&](double& into) {
      take();
      const PovVector v = numbers(3);
      into = v[0] == v[1] && v[1] == v[2] ? v[0] : (v[0] + v[1] + v[2]) / 3;
      // "albedo" may stand before a number.
    };
    if (token.text == "ambient")
      number(finish.ambient);
    else if (token.text == "diffuse") {
      take();
      take_word("albedo");
      finish.diffuse = numbers(3)[0];
      if (take_sign(",")) numbers(3);
    } else if (token.text == "emission")
      number(finish.emission);
    else if (token.text == "specular" || token.text == "phong") {
      take();
      take_word("albedo");
      (token.text == "phong" ? finish.phong : finish.specular) = float_expression();
    } else if (token.text == "roughness")
      number(finish.roughness);
    else if (token.text == "phong_size")
      number(finish.phong_size);
    else if (token.text == "metallic") {
      take();
      finish.metallic = true;
      if (peek().kind == PovToken::Kind::number) float_expression();
    } else if (token.text == "reflection") {
      take();
      if (!take_sign("{")) {
        finish.reflection = numbers(3)[0];
        continue;
      }
      const PovVector first = numbers(3);
      finish.reflection = (first[0] + first[1] + first[2]) / 3;
      while (!take_sign("}")) {
        if (take_sign(",")) {
          const PovVector most = numbers(3);
          finish.reflection = (finish.reflection + (most[0] + most[1] + most[2]) / 3) / 2;
        } else {
          unknown_word("a reflection");
        }
      }
    } else if (token.text == "conserve_energy" || token.text == "brilliance" ||
               token.text == "crand" || token.text == "reflection_exponent") {
      take();
      if (peek().kind == PovToken::Kind::number) float_expression();
    } else {
      unknown_word("a finish");
    }
  }
}

void PovScene::read_normal(PovTexture& texture) {
  const Place at = place();
  expect("{", "behind 'normal'");
  double height = 0.5, size = 1;
  bool is_known = false;
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_sign(",")) continue;
    if (token.is_word("bumps") || token.is_word("bozo") || token.is_word("wrinkles") ||
        token.is_word("dents") || token.is_word("granite")) {
      take();
      is_known = true;
      if (peek().kind == PovToken::Kind::number) height = float_expression();
    } else if (token.is_word("scale")) {
      const auto scaled = transform("scale");
      if (scaled) size *= mean_scale(*scaled);
    } else if (token.kind == PovToken::Kind::word && !transform(token.text)) {
      unknown_word("a normal");
    } else if (token.kind != PovToken::Kind::word) {
      expression();
    }
  }
  if (!is_known) return notes().differs(at, "this normal is not understood, and left out");
  if (height == 0) return;
  texture.bump = " " + attribute("bump", "Noise { " + attribute("scale", size) + " }") + " " +
                 attribute("bumpheight", 0.1 * height * size);
}

void PovScene::read_interior(PovTexture& texture) {
  expect("{", "behind 'interior'");
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_sign(",")) continue;
    if (token.kind != PovToken::Kind::word) fail("a word is expected in an interior");
    const PovValue* const value = find(token.text);
    if (const PovTexture* const known = value ? value->get<PovTexture>() : nullptr) {
      take();
      texture.index = known->index;
    } else if (take_word("ior")) {
      texture.index = float_expression();
    } else {
      unknown_word("an interior");
    }
  }
}

void PovScene::default_texture() {
  expect("{", "behind #default");
  while (!take_sign("}")) {
    const PovToken token = peek();
    PovObject ignored;
    if (token.kind != PovToken::Kind::word || !texture_word(ignored, default_, token.text))
      unknown_word("#default");
  }
}

std::string PovScene::material_of(const PovTexture& texture) {
  const PovFinish& finish = texture.finish;
  const PovPigment& pigment = texture.pigment;
  const double clear = clearness(pigment.color);
  const double mirror = std::clamp(finish.reflection, 0.0, 1.0);
  std::string text = "Material { color -> ";
  text += pigment.pattern.empty() ? rgb_text(pigment.color) : pigment.pattern;
  if (mirror > 0) text += " " + attribute("reflectivity", std::min(mirror, 1 - clear));
  if (clear > 0) text += " " + attribute("transparency", clear);
  if (clear > 0 && texture.index != 1)
    text += " " + attribute("refractiveindex", std::clamp(texture.index, 0.01, 100.0));
  text += " " + attribute("diffuse", std::max(0.0, finish.diffuse * (1 - clear)));
  const double shine = std::max(finish.specular, finish.phong);
  if (shine > 0) {
    // POV-Ray's specular is of the angle to the normal, and CRT's of that to the mirrored ray,
    // which is twice as large. So a fourth of its exponent gives a highlight of its size.
    const double size = finish.phong >= finish.specular ? finish.phong_size
                                                        : 0.25 / std::max(finish.roughness, 0.0001);
    text += " " + attribute("specular", shine) + " " + attribute("shininess", std::max(size, 0.0));
  }
  const double glow = finish.emission + (finish.ambient >= 0.3 ? finish.ambient : 0);
  if (glow > 0 && pigment.pattern.empty())
    text += " " + attribute("emission", rgb_text(times(pigment.color, glow)));
  const std::string name = texture_name_.empty() ? "paint1" : texture_name_;
  texture_name_.clear();
  return writer_.material(text + texture.bump + " }", name);
}

}  // namespace crt::importing
