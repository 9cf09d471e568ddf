// What may be declared in scenes of POV-Ray: values, objects, textures and what these are made of.
#include <utility>

#include "import/pov_scene.hpp"
#include "text/format.hpp"

namespace crt::importing {

PovValue PovScene::declared_value(const std::string& name) {
  // Directives may stand before the value.
  const std::size_t waiting = std::exchange(hold_, 0);
  const PovToken token = peek();
  hold_ = waiting;
  const bool is_block = token.kind == PovToken::Kind::word && behind() && behind()->is_sign("{");
  if (token.is_word("array")) {
    take();
    return array();
  }
  if (token.is_word("function") || token.is_word("spline")) {
    take();
    notes().differs(token.place, text::format("'{}' is not understood", token.text));
    if (take_sign("("))
      while (!take_sign(")")) take();
    skip_braces();
    return {PovUnknown{token.text}};
  }
  if (!is_block) return expression();
  // Within a block directives have their place, and behind it they wait again.
  const std::size_t held = std::exchange(hold_, 0);
  PovValue value = declared_block(name, token);
  hold_ = held;
  // Textures may lie on one another.
  while (value.get<PovTexture>() && peek().is_word("texture")) {
    notes().differs(place(), "of textures on one another the first one is taken");
    take();
    hold_ = 0;
    PovTexture other;
    read_texture(other);
    hold_ = held;
  }
  return value;
}

PovValue PovScene::declared_block(const std::string& name, const PovToken& token) {
  if (is_object(token)) {
    PovObject made = object();
    made.solid = make_named(made.solid, name);
    return {made};
  }
  take();
  const std::string& kind = token.text;
  if (kind == "texture" || kind == "material" || kind == "interior") {
    PovTexture texture = default_;
    if (kind == "texture") read_texture(texture);
    if (kind == "material") read_material(texture);
    if (kind == "interior") read_interior(texture);
    return {texture};
  }
  if (kind == "pigment") return {pigment()};
  if (kind == "finish") {
    PovFinish finish = default_.finish;
    read_finish(finish);
    return {finish};
  }
  if (kind == "transform") return {transform_block()};
  if (kind == "color_map" || kind == "colour_map" || kind == "pigment_map") return {color_map()};
  notes().differs(token.place, text::format("'{}' is not understood", kind));
  skip_braces();
  return {PovUnknown{kind}};
}

}  // namespace crt::importing
