// This file has the built-ins that make and measure Vec3s and Colors.
#include <array>
#include <cmath>
#include <crt/elementary.hpp>

#include "lang/builtins.hpp"
#include "lang/failure.hpp"

namespace crt::lang {

namespace {

Value make_vector(const Arguments& arguments) {
  return Vec3(arguments.number(0), arguments.number(1), arguments.number(2));
}

Value make_color(const Arguments& arguments) {
  const double alpha = arguments.size() > 3 ? arguments.number(3) : 1;
  return Color{arguments.number(0), arguments.number(1), arguments.number(2), alpha};
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
