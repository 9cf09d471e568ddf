// This file has the built-ins that make and measure Vec3s and Colors.
#include <array>
#include <cmath>
#include <crt/elementary.hpp>

#include "lang/builtins.hpp"
#include "lang/colors.hpp"
#include "lang/failure.hpp"
#include "lang/utf8.hpp"

namespace crt::lang {

namespace {

Value make_vector(const Arguments& arguments) {
  return Vec3(arguments.number(0), arguments.number(1), arguments.number(2));
}

Value make_color(const Arguments& arguments) {
  const double alpha = arguments.size() > 3 ? arguments.number(3) : 1;
  return Color{arguments.number(0), arguments.number(1), arguments.number(2), alpha};
}

/// Computes srgb(r, g, b), srgb(r, g, b, a) or srgb("#ff8800").
Value make_srgb(const Arguments& arguments) {
  if (arguments.size() > 1) {
    if (arguments.size() == 2)
      fail(arguments.call, "srgb takes three or four numbers, or a String such as \"#ff8800\"");
    const double alpha = arguments.size() > 3 ? arguments.number(3) : 1;
    return Color{light_of_srgb(arguments.number(0)), light_of_srgb(arguments.number(1)),
                 light_of_srgb(arguments.number(2)), alpha};
  }
  const auto* text = std::get_if<String>(&arguments[0]);
  if (!text) arguments.wrong_type(0, "a String such as \"#ff8800\"");
  const std::optional<Color> color = color_of_text((*text)->text);
  if (!color) {
    fail(arguments.span(0), "\"{}\" is no colour such as \"#ff8800\" or \"#f80\"",
         abbreviated((*text)->text));
  }
  return *color;
}

double norm(const Vec3& v) {
  return elementary::hypot(v.x, v.y, v.z);
}

Value length(const Arguments& arguments) {
  return norm(arguments.vector(0));
}

Value normalize(const Arguments& arguments) {
  const Vec3 v = arguments.vector(0);
  const double size = norm(v);
  if (!(size > 0) || !std::isfinite(size))
    fail(arguments.span(0), "only a finite Vec3 other than 0 has a direction");
  return v / size;
}

Value dot(const Arguments& arguments) {
  const Vec3 a = arguments.vector(0);
  const Vec3 b = arguments.vector(1);
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Value cross(const Arguments& arguments) {
  const Vec3 a = arguments.vector(0);
  const Vec3 b = arguments.vector(1);
  return Vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

constexpr std::array vectors_table = {
    Builtin{"vec3", "vec3(x, y, z)", 3, 3, make_vector},
    Builtin{"rgb", "rgb(r, g, b)", 3, 3, make_color},
    Builtin{"rgba", "rgba(r, g, b, a)", 4, 4, make_color},
    Builtin{"srgb", "srgb(r, g, b)", 1, 4, make_srgb},
    Builtin{"length", "length(v)", 1, 1, length},
    Builtin{"normalize", "normalize(v)", 1, 1, normalize},
    Builtin{"dot", "dot(a, b)", 2, 2, dot},
    Builtin{"cross", "cross(a, b)", 2, 2, cross},
};

}  // namespace

std::span<const Builtin> vector_builtins() {
  return vectors_table;
}

}  // namespace crt::lang
