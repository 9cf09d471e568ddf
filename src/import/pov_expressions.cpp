// Expressions of scenes of POV-Ray.
#include <algorithm>
#include <array>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>
#include <utility>

#include "import/pov_scene.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

constexpr int most_brackets = 150;  // of what stands in brackets in one another
constexpr std::size_t most_elements = 1'000'000;

PovValue number_value(double number) {
  return {number};
}
PovValue truth(bool value) {
  return {value ? 1.0 : 0.0};
}

/// Returns the numbers of a value, of which a lone one stands for all.
PovVector widened(const PovValue& value, std::size_t size) {
  if (const double* const number = value.get<double>()) return PovVector(size, *number);
  PovVector numbers = *value.get<PovVector>();
  numbers.resize(std::max(size, numbers.size()), 0);
  return numbers;
}

bool is_numeric(const PovValue& value) {
  return value.get<double>() || value.get<PovVector>();
}

double compute(char sign, double a, double b) {
  switch (sign) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    default:
      return b == 0 ? 0 : a / b;
  }
}

bool compare(const std::string& sign, double a, double b) {
  if (sign == "<") return a < b;
  if (sign == "<=") return a <= b;
  if (sign == ">") return a > b;
  if (sign == ">=") return a >= b;
  return (a == b) == (sign == "=");
}

/// Lists the operators by how loosely they bind.
bool is_of_level(const PovToken& token, int level) {
  if (token.kind != PovToken::Kind::sign) return false;
  const std::string& sign = token.text;
  switch (level) {
    case 0:
      return sign == "&" || sign == "|";
    case 1:
      return sign == "<" || sign == "<=" || sign == ">" || sign == ">=" || sign == "=" ||
             sign == "!=";
    case 2:
      return sign == "+" || sign == "-";
    default:
      return sign == "*" || sign == "/";
  }
}

std::optional<std::size_t> component_of(const std::string& name) {
  static constexpr std::array<std::pair<std::string_view, std::size_t>, 11> components = {
      {{"x", 0},
       {"y", 1},
       {"z", 2},
       {"t", 3},
       {"u", 0},
       {"v", 1},
       {"red", 0},
       {"green", 1},
       {"blue", 2},
       {"filter", 3},
       {"transmit", 4}}};
  for (const auto& [known, place] : components)
    if (known == name) return place;
  if (name == "gray" || name == "grey") return 5;
  return {};
}

}  // namespace

PovValue PovScene::expression() {
  if (++depth_ > most_brackets)
    throw Failure(place(), "brackets lie too deep in one another", ErrorCode::limit);
  PovValue value = binary(no_compare_ ? 2 : 0);
  if (!no_compare_ && take_sign("?")) {
    const PovValue chosen = expression();
    expect(":", "between the two values of '?'");
    const PovValue other = expression();
    const double* const number = value.get<double>();
    value = number && *number != 0 ? chosen : other;
  }
  --depth_;
  return value;
}

PovValue PovScene::binary(int level) {
  if (level > 3) return unary();
  PovValue left = binary(level + 1);
  while (is_of_level(peek(), level)) {
    // A vector may stand behind another without a comma.
    if (level == 1 && left.get<PovVector>()) break;
    const PovToken sign = take();
    const PovValue right = binary(level + 1);
    count();
    const std::string* const text = left.get<std::string>();
    const std::string* const other = right.get<std::string>();
    if (text && other && level == 1) {
      left = truth(compare(sign.text, text->compare(*other), 0));
      continue;
    }
    if (!is_numeric(left) || !is_numeric(right))
      throw Failure(sign.place, text::format("'{}' needs numbers or vectors", sign.text));
    if (left.get<double>() && right.get<double>()) {
      const double a = *left.get<double>(), b = *right.get<double>();
      if (level == 0) left = truth(sign.text == "&" ? a != 0 && b != 0 : a != 0 || b != 0);
      if (level == 1) left = truth(compare(sign.text, a, b));
      if (level >= 2) left = number_value(compute(sign.text[0], a, b));
      continue;
    }
    if (level < 2) throw Failure(sign.place, "vectors cannot be compared");
    const std::size_t size = std::max(left.get<double>() ? 0 : left.get<PovVector>()->size(),
                                      right.get<double>() ? 0 : right.get<PovVector>()->size());
    const PovVector a = widened(left, size), b = widened(right, size);
    PovVector result(size);
    for (std::size_t i = 0; i < size; ++i) result[i] = compute(sign.text[0], a[i], b[i]);
    const bool is_color = left.is_color || right.is_color;
    left = {std::move(result), is_color};
  }
  return left;
}

PovValue PovScene::unary() {
  if (take_sign("+")) return unary();
  const bool negates = peek().is_sign("-");
  if (!negates && !peek().is_sign("!")) return suffixed();
  const PovToken sign = take();
  if (++depth_ > most_brackets)
    throw Failure(sign.place, "too many signs stand in a row", ErrorCode::limit);
  PovValue value = unary();
  --depth_;
  if (!is_numeric(value)) throw Failure(sign.place, "a sign needs a number or a vector");
  if (!negates) return truth(value.get<double>() && *value.get<double>() == 0);
  if (const double* const number = value.get<double>()) return number_value(-*number);
  PovVector numbers = *value.get<PovVector>();
  for (double& number : numbers) number = -number;
  return {std::move(numbers), value.is_color};
}

PovValue PovScene::suffixed() {
  PovValue value = primary();
  for (;;) {
    if (peek().is_sign("[")) {
      const auto* const array = value.get<std::shared_ptr<PovArray>>();
      if (!array) return value;
      take();
      const bool was = std::exchange(no_compare_, false);
      const double index = float_expression();
      no_compare_ = was;
      expect("]", "behind an index");
      if (!(index >= 0) || index >= static_cast<double>((*array)->size()))
        fail("there is no such element of this array");
      value = PovValue((**array)[static_cast<std::size_t>(index)]);
    } else if (peek().is_sign(".") && is_numeric(value)) {
      take();
      const PovToken name = take();
      const auto component = component_of(name.text);
      if (!component) throw Failure(name.place, "a component such as x or red is expected");
      const PovVector numbers = widened(value, 5);
      value = number_value(*component < 5
                               ? numbers[*component]
                               : 0.297 * numbers[0] + 0.589 * numbers[1] + 0.114 * numbers[2]);
    } else {
      return value;
    }
  }
}

std::optional<PovValue> PovScene::element() {
  const PovToken& token = peek();
  const PovValue* const value = token.kind == PovToken::Kind::word ? find(token.text) : nullptr;
  if (!value || !value->get<std::shared_ptr<PovArray>>()) return {};
  return suffixed();
}

PovValue PovScene::vector_literal() {
  expect("<", "here");
  const bool was = std::exchange(no_compare_, true);
  PovVector numbers;
  do {
    const PovValue value = expression();
    const double* const number = value.get<double>();
    if (!number) fail("a vector is made of numbers");
    numbers.push_back(*number);
    if (numbers.size() > 5) fail("a vector has at most 5 numbers");
    take_sign(",");
  } while (!peek().is_sign(">") && peek().kind != PovToken::Kind::end);
  no_compare_ = was;
  expect(">", "at the end of a vector");
  return {std::move(numbers)};
}

PovValue PovScene::primary() {
  count();
  const PovToken& token = peek();
  if (token.kind == PovToken::Kind::number) return number_value(take().number);
  if (token.kind == PovToken::Kind::text) return {take().text};
  if (token.is_sign("<")) return vector_literal();
  if (token.is_sign("(")) {
    take();
    const bool was = std::exchange(no_compare_, false);
    PovValue value = expression();
    no_compare_ = was;
    expect(")", "behind an expression");
    return value;
  }
  if (token.kind != PovToken::Kind::word) fail("a value is expected here");
  return named(take());
}

PovValue PovScene::named(const PovToken& name) {
  if (const PovValue* const value = find(name.text)) {
    if (!value->get<std::monostate>()) return *value;
  }
  static constexpr std::array<std::string_view, 10> colors = {
      "color", "colour", "rgb", "rgbf", "rgbt", "rgbft", "srgb", "srgbf", "srgbt", "srgbft"};
  if (std::find(colors.begin(), colors.end(), name.text) != colors.end()) {
    const bool is_plain = name.text[0] == 'c';
    // "color red 1" and "color Red" are colours, too.
    PovValue value = is_plain && component_of(peek().text) ? color() : unary();
    if (!is_numeric(value)) throw Failure(name.place, "a colour is expected here");
    PovVector numbers = widened(value, 3);
    const bool is_transmit = name.text == "rgbt" || name.text == "srgbt";
    if (is_transmit && numbers.size() > 3) numbers.insert(numbers.begin() + 3, 0.0);
    numbers.resize(5, 0);
    if (value.get<double>()) {
      numbers = {*value.get<double>(), *value.get<double>(), *value.get<double>(), 0, 0};
      if (name.text == "rgbf") numbers[3] = numbers[0];
      if (name.text == "rgbt") numbers[4] = numbers[0];
    }
    if (name.text[0] == 's') {
      for (std::size_t i = 0; i < 3; ++i)
        numbers[i] = numbers[i] <= 0.04045 ? numbers[i] / 12.92
                                           : elementary::pow((numbers[i] + 0.055) / 1.055, 2.4);
    }
    return {std::move(numbers), true};
  }
  if (component_of(name.text) && name.text.size() > 1 && name.text != "gray" &&
      name.text != "grey") {
    const std::size_t channel = *component_of(name.text);
    const double share = float_expression();
    PovValue rest = color();
    PovVector numbers = *rest.get<PovVector>();
    numbers[channel] = share;
    return {std::move(numbers), true};
  }
  static constexpr std::array<std::pair<std::string_view, double>, 13> constants = {
      {{"pi", std::numbers::pi},
       {"true", 1},
       {"yes", 1},
       {"on", 1},
       {"false", 0},
       {"no", 0},
       {"off", 0},
       {"clock", 0},
       {"frame_number", 1},
       {"final_frame", 1},
       {"version", 3.7},
       {"image_width", 800},
       {"image_height", 600}}};
  for (const auto& [known, value] : constants)
    if (known == name.text) return number_value(value);
  if (name.text == "clock_on" || name.text == "clock_delta") return number_value(0);
  if (name.text == "x" || name.text == "u") return {PovVector{1, 0, 0}};
  if (name.text == "y" || name.text == "v") return {PovVector{0, 1, 0}};
  if (name.text == "z") return {PovVector{0, 0, 1}};
  if (name.text == "t") return {PovVector{0, 0, 0, 1}};
  if (auto value = function(name)) return *value;
  throw Failure(name.place, text::format("'{}' is not defined", name.text));
}

PovValue PovScene::color() {
  PovVector numbers(5, 0);
  while (const auto component = component_of(peek().text)) {
    if (*component >= 5) break;
    take();
    numbers[*component] = float_expression();
  }
  return {std::move(numbers), true};
}

double PovScene::float_expression() {
  const Place at = place();
  const PovValue value = expression();
  if (const double* const number = value.get<double>()) return *number;
  if (const PovVector* const numbers = value.get<PovVector>()) {
    if (!numbers->empty()) return numbers->front();
  }
  throw Failure(at, "a number is expected here");
}

std::string PovScene::text_expression() {
  const Place at = place();
  const PovValue value = expression();
  if (const std::string* const text = value.get<std::string>()) return *text;
  throw Failure(at, "a text is expected here");
}

PovVector PovScene::numbers(std::size_t least) {
  const Place at = place();
  const PovValue value = expression();
  if (!is_numeric(value)) throw Failure(at, "a vector is expected here");
  return widened(value, least);
}

Vec3 PovScene::vec3() {
  const PovVector v = numbers(3);
  return {v[0], v[1], v[2]};
}

void PovScene::with_channels(PovVector& numbers) {
  while (peek().kind == PovToken::Kind::word && peek().text.size() > 1) {
    const auto channel = component_of(peek().text);
    if (!channel || *channel >= 5) return;
    take();
    numbers[*channel] = float_expression();
  }
}

PovColor PovScene::color_value() {
  PovVector v = numbers(5);
  with_channels(v);
  return {v[0], v[1], v[2], v[3], v[4]};
}

PovValue PovScene::array() {
  std::vector<std::size_t> sizes;
  double all = 1;
  while (take_sign("[")) {
    const double size = float_expression();
    expect("]", "behind the size of an array");
    all *= size;
    if (!(size >= 1) || all > static_cast<double>(most_elements) || sizes.size() > 5)
      throw Failure(place(), "this is no size of an array", ErrorCode::limit);
    sizes.push_back(static_cast<std::size_t>(size));
  }
  count(static_cast<std::uint64_t>(all));
  const auto elements = std::make_shared<PovArray>(array_of(sizes, 0));
  if (peek().is_sign("{")) fill(*elements);
  return {elements};
}

PovArray PovScene::array_of(const std::vector<std::size_t>& sizes, std::size_t dimension) {
  PovArray elements(dimension < sizes.size() ? sizes[dimension] : 0);
  if (dimension + 1 < sizes.size()) {
    for (PovValue& element : elements)
      element = {std::make_shared<PovArray>(array_of(sizes, dimension + 1))};
  }
  return elements;
}

void PovScene::fill(PovArray& elements) {
  if (++depth_ > most_brackets)
    throw Failure(place(), "brackets lie too deep in one another", ErrorCode::limit);
  expect("{", "before the elements of an array");
  for (std::size_t i = 0; !take_sign("}"); ++i) {
    if (i >= most_elements) fail("this array has too many elements");
    if (i >= elements.size()) elements.emplace_back();
    if (!peek().is_sign("{")) {
      elements[i] = declared_value("");
    } else {
      if (!elements[i].get<std::shared_ptr<PovArray>>())
        elements[i] = {std::make_shared<PovArray>()};
      fill(**elements[i].get<std::shared_ptr<PovArray>>());
    }
    take_sign(",");
  }
  --depth_;
}

}  // namespace crt::importing
