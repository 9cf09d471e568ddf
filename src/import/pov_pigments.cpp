// Pigments of POV-Ray become colours and patterns.
#include <algorithm>
#include <cmath>
#include <utility>

#include "import/pov_pigment.hpp"
#include "import/pov_scene.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

using Stops = std::vector<std::pair<double, PovColor>>;

std::string stops_text(const Stops& stops) {
  std::vector<std::string> texts;
  for (const auto& [position, color] : stops)
    texts.push_back(list_text({number_text(position), rgb_text(color)}));
  return list_text(texts);
}

/// Puts the ends of a map to 0 and 1, in order, as scripts want them.
Stops tidied(Stops stops) {
  for (auto& stop : stops) stop.first = std::clamp(stop.first, 0.0, 1.0);
  std::stable_sort(stops.begin(), stops.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  if (stops.size() > 64) stops.resize(64);
  if (stops.size() == 1) stops.push_back({1.0, stops.front().second});
  return stops;
}

PovColor mean_of(const Stops& stops) {
  PovColor sum{};
  for (const auto& [position, c] : stops) {
    sum = {sum.red + c.red, sum.green + c.green, sum.blue + c.blue, sum.filter + c.filter,
           sum.transmit + c.transmit};
  }
  const double share = stops.empty() ? 0 : 1.0 / static_cast<double>(stops.size());
  return {sum.red * share, sum.green * share, sum.blue * share, sum.filter * share,
          sum.transmit * share};
}

constexpr PovPattern patterns[] = {
    {"checker", "Checker", 1, true}, {"gradient", "Gradient", 2, true},
    {"bozo", "Noise", 1, false},     {"bumps", "Noise", 1, false},
    {"spotted", "Noise", 1, false},  {"granite", "Noise", 0.4, false},
    {"agate", "Noise", 0.6, false},  {"wrinkles", "Noise", 1, false},
    {"dents", "Noise", 1, false},    {"crackle", "Noise", 1, false},
    {"marble", "Marble", 1, false},  {"wood", "Wood", 1, false},
    {"leopard", "Noise", 1, false},  {"cells", "Noise", 1, false}};

}  // namespace

const PovPattern* pov_pattern(const std::string& name) {
  const auto found = std::find_if(std::begin(patterns), std::end(patterns),
                                  [&](const PovPattern& p) { return name == p.name; });
  return found == std::end(patterns) ? nullptr : found;
}

std::string checker_text(const PovColor& a, const PovColor& b) {
  return text::format("Checker {{ colorA -> {} colorB -> {}", rgb_text(a), rgb_text(b));
}

std::string rgb_text(const PovColor& c) {
  return text::format("rgb({}, {}, {})", number_text(std::max(c.red, 0.0)),
                      number_text(std::max(c.green, 0.0)), number_text(std::max(c.blue, 0.0)));
}

PovPigment PovScene::pigment() {
  PovPigment result;
  expect("{", "behind 'pigment'");
  read_pigment(result);
  return result;
}

void PovScene::read_pigment(PovPigment& pigment) {
  const PovPattern* pattern = nullptr;
  Vec3 direction{0, 1, 0};
  Vec3 offset{0, 0, 0};
  double size = 1;
  std::vector<PovColor> colors;
  const Place begin = place();
  while (!take_sign("}")) {
    const PovToken token = peek();
    if (take_sign(",")) continue;
    if (token.kind == PovToken::Kind::end) fail("a '}' is missing");
    const PovValue* const value = token.kind == PovToken::Kind::word ? find(token.text) : nullptr;
    if (const PovPigment* const known = value ? value->get<PovPigment>() : nullptr) {
      take();
      pigment = *known;
    } else if (const Stops* const map = value ? value->get<Stops>() : nullptr) {
      take();
      pigment.stops = *map;
    } else if (const PovPattern* const found = value ? nullptr : pov_pattern(token.text)) {
      take();
      pattern = found;
      if (token.text == "gradient") direction = vec3();
      if (!found->is_same)
        notes().differs(token.place, text::format("the pattern '{}' is that of the script's {}",
                                                  token.text, found->type));
    } else if (token.is_word("color_map") || token.is_word("colour_map")) {
      take();
      pigment.stops = color_map();
    } else if (token.is_word("image_map")) {
      take();
      notes().differs(token.place, "a picture on a surface is not understood: it is left grey");
      skip_braces();
      pigment.color = {0.5, 0.5, 0.5};
    } else if (token.is_word("translate") || token.is_word("scale") || token.is_word("rotate") ||
               token.is_word("matrix") || token.is_word("transform")) {
      const auto moved = transform(token.text);
      if (!moved) continue;
      const auto scale = even_scale(*moved, 1e-9);
      size *= scale.value_or(mean_scale(*moved));
      offset = map_point(*moved, offset);
      const Vec3 base = map_point(*moved, {0, 0, 0});
      const Vec3 turned = map_point(*moved, direction) - base;
      if (turned != Vec3(0, 0, 0)) direction = turned;
    } else if (token.is_word("brick") || token.is_word("hexagon") || token.is_word("quick_color") ||
               token.is_word("quick_colour")) {
      take();
      if (token.text[0] != 'q')
        notes().differs(token.place,
                        text::format("the pattern '{}' is not understood", token.text));
      PovColor ignored{};
      if (token.text[0] == 'q') ignored = color_value();
    } else if (token.kind == PovToken::Kind::word && !value &&
               (token.text == "turbulence" || token.text == "octaves" || token.text == "lambda" ||
                token.text == "omega" || token.text == "frequency" || token.text == "phase")) {
      take();
      numbers(3);
    } else if (token.is_word("pigment")) {
      take();
      colors.push_back(this->pigment().color);
    } else if (token.kind == PovToken::Kind::word || token.is_sign("<")) {
      const bool is_color = token.is_sign("<") || value || token.text.substr(0, 3) == "rgb" ||
                            token.text.substr(0, 5) == "color" ||
                            token.text.substr(0, 6) == "colour" ||
                            token.text.substr(0, 4) == "srgb" || token.text == "red" ||
                            token.text == "green" || token.text == "blue";
      if (is_color) {
        colors.push_back(color_value());
      } else {
        unknown_word("a pigment");
      }
    } else {
      fail("this does not belong into a pigment");
    }
  }
  if (!colors.empty()) {
    pigment.color = colors.front();
    if (!pattern) pigment.pattern.clear();
  }
  if (pattern && std::string_view(pattern->type) == "Checker") {
    const PovColor blue{0, 0, 1}, green{0, 1, 0};
    const PovColor a = colors.empty() ? blue : colors[0];
    const PovColor b = colors.size() < 2 ? green : colors[1];
    pigment.stops = {{0, a}, {1, b}};
    pigment.color = a;
    pigment.pattern = checker_text(a, b);
    // A face between two cubes belongs to the upper one, as it does in POV-Ray.
    offset -= Vec3(1e-6, 1e-6, 1e-6) * size;
  } else if (pattern) {
    if (pigment.stops.empty()) pigment.stops = {{0, {}}, {1, {1, 1, 1}}};
    const Stops stops = tidied(pigment.stops);
    pigment.color = mean_of(stops);
    pigment.pattern = text::format("{} {{ colors -> {}", pattern->type, stops_text(stops));
    if (std::string_view(pattern->type) == "Gradient")
      pigment.pattern += " " + attribute("direction", direction);
    if (std::string_view(pattern->type) == "Wood") pigment.pattern += " direction -> vec3(0, 0, 1)";
  } else if (!pigment.stops.empty() && pigment.pattern.empty()) {
    notes().differs(begin, "of a pattern that is not understood the mean colour is taken");
    pigment.color = mean_of(pigment.stops);
  }
  if (pattern) {
    const double scale = pattern->period * size;
    if (scale != 1) pigment.pattern += " " + attribute("scale", scale);
    if (offset != Vec3(0, 0, 0)) pigment.pattern += " " + attribute("offset", offset);
    pigment.pattern += " }";
  }
}

std::vector<std::pair<double, PovColor>> PovScene::color_map() {
  Stops stops;
  expect("{", "behind 'color_map'");
  while (!take_sign("}")) {
    if (peek().kind == PovToken::Kind::word) {
      const PovToken name = take();
      const PovValue* const value = find(name.text);
      const Stops* const known = value ? value->get<Stops>() : nullptr;
      if (!known) throw Failure(name.place, text::format("'{}' is no map of colours", name.text));
      stops = *known;
      continue;
    }
    expect("[", "in a map of colours");
    const double position = float_expression();
    take_sign(",");
    // An entry may be a pigment, whose colour counts.
    const auto entry = [&] {
      const PovValue* const value =
          peek().kind == PovToken::Kind::word ? find(peek().text) : nullptr;
      if (const PovPigment* const known = value ? value->get<PovPigment>() : nullptr) {
        take();
        return known->color;
      }
      return color_value();
    };
    const bool is_range = peek().kind == PovToken::Kind::number;
    const double end = is_range ? float_expression() : position;
    take_sign(",");
    stops.emplace_back(position, entry());
    take_sign(",");
    if (is_range) stops.emplace_back(end, entry());
    while (!take_sign("]")) {
      if (peek().kind == PovToken::Kind::end) fail("a ']' is missing");
      unknown_word("a map of colours");
    }
    if (stops.size() > 10000) fail("this map has too many colours");
  }
  return stops;
}

}  // namespace crt::importing
