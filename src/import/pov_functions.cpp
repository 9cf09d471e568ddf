// Functions of scenes of POV-Ray.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <crt/elementary.hpp>
#include <cstdint>
#include <numbers>

#include "import/pov_scene.hpp"
#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::importing {

namespace {

using Function = double (*)(double);
double sign_of(double x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}
double square_root(double x) {
  return std::sqrt(std::max(x, 0.0));
}
double cut_off(double x) {
  return std::trunc(x);
}
double to_radians(double x) {
  return x * (std::numbers::pi / 180);
}
double in_degrees(double x) {
  return x * (180 / std::numbers::pi);
}
double sinh_of(double x) {
  return (elementary::exp(x) - elementary::exp(-x)) / 2;
}
double cosh_of(double x) {
  return (elementary::exp(x) + elementary::exp(-x)) / 2;
}
double tanh_of(double x) {
  return 1 - 2 / (elementary::exp(2 * x) + 1);
}
double absolute(double x) {
  return std::abs(x);
}
double floor_of(double x) {
  return std::floor(x);
}
double ceil_of(double x) {
  return std::ceil(x);
}

struct NamedFunction {
  const char* name;
  Function function;
};
constexpr NamedFunction functions_of_one[] = {
    {"sin", elementary::sin},   {"cos", elementary::cos},   {"tan", elementary::tan},
    {"asin", elementary::asin}, {"acos", elementary::acos}, {"atan", elementary::atan},
    {"exp", elementary::exp},   {"ln", elementary::log},    {"log", elementary::log10},
    {"sqrt", square_root},      {"abs", absolute},          {"floor", floor_of},
    {"ceil", ceil_of},          {"int", cut_off},           {"sgn", sign_of},
    {"radians", to_radians},    {"degrees", in_degrees},    {"sinh", sinh_of},
    {"cosh", cosh_of},          {"tanh", tanh_of}};

double length_of(const Vec3& v) {
  return elementary::hypot(v.x, v.y, v.z);
}
Vec3 cross_of(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot_of(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

PovValue vector_value(const Vec3& v) {
  return {PovVector{v.x, v.y, v.z}};
}

/// Turns a point about an axis, left-handed.
Vec3 turned_about(const Vec3& point, const Vec3& axis, double degrees) {
  const double length = length_of(axis);
  if (length == 0) return point;
  const Vec3 a = axis / length;
  const double c = cosine_of_degrees(degrees), s = sine_of_degrees(degrees);
  return point * c + cross_of(a, point) * s + a * (dot_of(a, point) * (1 - c));
}

std::string shown_number(double number, double length, double digits) {
  std::string text = digits < 0 ? text::format("{}", number) : std::string();
  if (digits >= 0) {
    // A form has a fixed number of digits, so the rounding is done here.
    const int places = static_cast<int>(std::min(digits, 15.0));
    const double scale = elementary::pow(10, places);
    const double rounded = std::round(std::abs(number) * scale);
    const double whole = std::floor(rounded / scale);
    text = text::format("{:.0f}", whole);
    if (places > 0) {
      std::string rest = text::format("{:.0f}", rounded - whole * scale);
      rest.insert(0, static_cast<std::size_t>(std::max(0, places - static_cast<int>(rest.size()))),
                  '0');
      text += "." + rest;
    }
    if (number < 0) text.insert(0, "-");
  }
  const double wanted = std::min(std::abs(length), 1000.0);
  while (static_cast<double>(text.size()) < wanted) text.insert(0, length < 0 ? "0" : " ");
  return text;
}

}  // namespace

double PovScene::random(double stream) {
  const auto found = random_.find(stream);
  if (found == random_.end()) fail("rand() needs the number of a stream, which seed() gives");
  std::uint64_t& next = found->second;
  // It is the generator of the manual's rand(): a linear one of 32 bits.
  next = (next * 1812433253U + 12345U) & 0xffffffffU;
  return static_cast<double>(next) / 0xffffffffU;
}

std::optional<PovValue> PovScene::function(const PovToken& name) {
  if (!peek().is_sign("(")) return {};
  // A word that is no function is not defined, whatever stands behind it.
  static const std::vector<std::string> others = {"atan2",        "pow",
                                                  "mod",          "min",
                                                  "max",          "div",
                                                  "rand",         "seed",
                                                  "select",       "vlength",
                                                  "vdot",         "vnormalize",
                                                  "vcross",       "vrotate",
                                                  "vaxis_rotate", "concat",
                                                  "str",          "chr",
                                                  "substr",       "strupr",
                                                  "strlwr",       "strlen",
                                                  "strcmp",       "asc",
                                                  "val",          "dimension_size",
                                                  "defined",      "even",
                                                  "odd",          "dimensions"};
  const bool is_of_one = std::any_of(std::begin(functions_of_one), std::end(functions_of_one),
                                     [&](const NamedFunction& f) { return name.text == f.name; });
  if (!is_of_one && std::find(others.begin(), others.end(), name.text) == others.end()) return {};
  const bool was = std::exchange(no_compare_, false);
  expect("(", "behind the name of a function");
  std::optional<PovValue> value = text_function(name.text);
  if (!value) value = vector_function(name.text);
  if (!value) value = number_function(name.text);
  expect(")", "behind the arguments of a function");
  no_compare_ = was;
  return value;
}

std::optional<PovValue> PovScene::number_function(const std::string& name) {
  if (name == "dimension_size" || name == "dimensions") {
    const PovValue value = expression();
    const auto* const array = value.get<std::shared_ptr<PovArray>>();
    if (!array) fail("an array is expected here");
    if (name == "dimensions") return PovValue{1.0};
    const PovArray* inner = array->get();
    for (double dimension = take_sign(",") ? float_expression() : 1; dimension > 1; --dimension) {
      const auto* const held =
          inner->empty() ? nullptr : inner->front().get<std::shared_ptr<PovArray>>();
      if (!held) fail("this array has no such dimension");
      inner = held->get();
    }
    return PovValue{static_cast<double>(inner->size())};
  }
  const double x = float_expression();
  for (const NamedFunction& known : functions_of_one)
    if (name == known.name) return PovValue{known.function(x)};
  if (name == "rand") return PovValue{random(x)};
  if (name == "even") return PovValue{std::fmod(std::floor(x), 2) == 0 ? 1.0 : 0.0};
  if (name == "odd") return PovValue{std::fmod(std::floor(x), 2) != 0 ? 1.0 : 0.0};
  if (name == "seed") {
    const auto stream = static_cast<double>(random_.size());
    if (random_.size() > 100000) fail("there are too many streams of random numbers");
    const double whole = std::clamp(std::trunc(x), -2147483648.0, 2147483647.0);
    random_[stream] = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole));
    return PovValue{stream};
  }
  std::vector<double> rest{x};
  while (take_sign(",")) rest.push_back(float_expression());
  const auto need = [&](std::size_t least) {
    if (rest.size() < least) fail(text::format("{}() needs {} numbers", name, least));
  };
  if (name == "min") return PovValue{*std::min_element(rest.begin(), rest.end())};
  if (name == "max") return PovValue{*std::max_element(rest.begin(), rest.end())};
  need(2);
  if (name == "atan2") return PovValue{elementary::atan2(x, rest[1])};
  if (name == "pow") return PovValue{elementary::pow(x, rest[1])};
  if (name == "mod") return PovValue{rest[1] == 0 ? 0 : std::fmod(x, rest[1])};
  if (name == "div") return PovValue{rest[1] == 0 ? 0 : std::trunc(x / rest[1])};
  need(3);  // select
  if (rest.size() == 3) return PovValue{x < 0 ? rest[1] : rest[2]};
  return PovValue{x < 0 ? rest[1] : x == 0 ? rest[2] : rest[3]};
}

std::optional<PovValue> PovScene::vector_function(const std::string& name) {
  if (name.empty() || name[0] != 'v' || name == "val") return {};
  const Vec3 a = vec3();
  if (name == "vlength") return PovValue{length_of(a)};
  if (name == "vnormalize") {
    const double length = length_of(a);
    return vector_value(length == 0 ? a : a / length);
  }
  expect(",", "between the arguments of a function");
  const Vec3 b = vec3();
  if (name == "vdot") return PovValue{dot_of(a, b)};
  if (name == "vcross") return vector_value(cross_of(a, b));
  if (name == "vrotate") return vector_value(map_point(rotation_matrix(b), a));
  expect(",", "between the arguments of a function");
  return vector_value(turned_about(a, b, float_expression()));
}

std::optional<PovValue> PovScene::text_function(const std::string& name) {
  if (name == "defined") {
    const PovToken word = take();
    return PovValue{find(word.text) ? 1.0 : 0.0};
  }
  if (name == "concat") {
    std::string text;
    do {
      text += text_expression();
      if (text.size() > 1000000) fail("this text is too long");
    } while (take_sign(","));
    return PovValue{text};
  }
  if (name == "str") {
    const double number = float_expression();
    expect(",", "between the arguments of a function");
    const double length = float_expression();
    expect(",", "between the arguments of a function");
    return PovValue{shown_number(number, length, float_expression())};
  }
  if (name == "chr")
    return PovValue{std::string(1, static_cast<char>(std::clamp(float_expression(), 1.0, 126.0)))};
  const bool takes_text = name == "substr" || name == "strupr" || name == "strlwr" ||
                          name == "strlen" || name == "strcmp" || name == "asc" || name == "val";
  if (!takes_text) return {};
  std::string text = text_expression();
  if (name == "strlen") return PovValue{static_cast<double>(text.size())};
  if (name == "asc") return PovValue{text.empty() ? 0.0 : static_cast<double>(text[0])};
  if (name == "strlwr") return PovValue{text::in_small_letters(text)};
  if (name == "strupr") {
    for (char& c : text)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return PovValue{text};
  }
  if (name == "val") {
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return PovValue{number};
  }
  expect(",", "between the arguments of a function");
  if (name == "strcmp") return PovValue{sign_of(text.compare(text_expression()))};
  const double first = float_expression();
  expect(",", "between the arguments of a function");
  const double length = float_expression();
  if (!(first >= 1) || !(length >= 0) || first > static_cast<double>(text.size()))
    fail("substr() is out of its text");
  return PovValue{
      text.substr(static_cast<std::size_t>(first) - 1, static_cast<std::size_t>(length))};
}

}  // namespace crt::importing
