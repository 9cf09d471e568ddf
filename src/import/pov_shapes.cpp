// The shapes of POV-Ray become objects of scripts.
#include <algorithm>
#include <cmath>
#include <utility>

#include "import/pov_scene.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

/// x and z of a prism are x and y of a profile, which is drawn out along y.
constexpr const char* upright_in_pov = "matrix [[1, 0, 0, 0], [0, 0, 1, 0], [0, 1, 0, 0]]";

struct Point {
  double x = 0;
  double y = 0;
};

std::string corner(std::initializer_list<double> numbers) {
  std::vector<std::string> texts;
  for (const double number : numbers) texts.push_back(number_text(number));
  return list_text(texts);
}

Point toward(const Point& from, const Point& a, const Point& b, double share) {
  return {from.x + (b.x - a.x) * share, from.y + (b.y - a.y) * share};
}

/// Adds the corners of a contour from the points of a spline.
std::vector<std::string> corners_of(const std::vector<Point>& p, Spline spline) {
  std::vector<std::string> corners;
  switch (spline) {
    case Spline::linear:
      for (const Point& point : p) corners.push_back(corner({point.x, point.y}));
      break;
    case Spline::quadratic:
      // Each piece is the part of a parabola through three points that lies behind the second.
      for (std::size_t i = 1; i < p.size(); ++i) {
        if (i == 1) {
          corners.push_back(corner({p[1].x, p[1].y}));
          continue;
        }
        const Point control = toward(p[i - 1], p[i - 2], p[i], 0.25);
        corners.push_back(corner({control.x, control.y, p[i].x, p[i].y}));
      }
      break;
    case Spline::cubic:
      for (std::size_t i = 1; i + 1 < p.size(); ++i) {
        if (i == 1) {
          corners.push_back(corner({p[1].x, p[1].y}));
          continue;
        }
        const Point a = toward(p[i - 1], p[i - 2], p[i], 1.0 / 6);
        const Point b = toward(p[i], p[i + 1], p[i - 1], 1.0 / 6);
        corners.push_back(corner({a.x, a.y, b.x, b.y, p[i].x, p[i].y}));
      }
      break;
    case Spline::bezier:
      for (std::size_t i = 0; i + 3 < p.size(); i += 4) {
        if (i == 0) corners.push_back(corner({p[0].x, p[0].y}));
        corners.push_back(
            corner({p[i + 1].x, p[i + 1].y, p[i + 2].x, p[i + 2].y, p[i + 3].x, p[i + 3].y}));
      }
      break;
  }
  return corners;
}

/// Cuts the points of a prism into contours, each of which ends where it begins.
std::vector<std::vector<Point>> contours_of(const std::vector<Point>& points, Spline spline) {
  std::vector<std::vector<Point>> contours;
  const std::size_t before = spline == Spline::quadratic || spline == Spline::cubic ? 1 : 0;
  const std::size_t behind = spline == Spline::cubic ? 1 : 0;
  const std::size_t step = spline == Spline::bezier ? 4 : 1;
  std::size_t begin = 0;
  while (begin + before + 2 < points.size()) {
    const Point& first = points[begin + before];
    std::size_t end = begin + before + (step == 4 ? 3 : 1);
    while (end < points.size() && (points[end].x != first.x || points[end].y != first.y))
      end += step;
    end = std::min(end + behind, points.size() - 1);
    contours.emplace_back(points.begin() + static_cast<std::ptrdiff_t>(begin),
                          points.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    begin = end + 1;
  }
  return contours;
}

}  // namespace

SharedSolid PovScene::shape(const std::string& type, const Place& at) {
  if (type == "sphere") return sphere();
  if (type == "box") return box();
  if (type == "cylinder" || type == "cone") return cone(type == "cylinder", at);
  if (type == "blob") return blob();
  if (type == "quadric") return quadric();
  if (type == "prism") return prism(at);
  if (type == "lathe") return lathe(at, false);
  if (type == "sor") return lathe(at, true);
  if (type == "mesh") return mesh();
  if (type == "mesh2") return mesh2(at);
  if (type == "text") return text_object(at);
  if (type == "torus") {
    const double radius = float_expression();
    comma();
    return make_object("Torus", {attribute("center", Vec3(0, 0, 0)),
                                 attribute("axis", Vec3(0, 1, 0)), attribute("radius", radius),
                                 attribute("thickness", std::abs(float_expression()))});
  }
  if (type == "superellipsoid") {
    const PovVector powers = numbers(2);
    return make_object("Superellipsoid",
                       {attribute("eastwest", std::clamp(powers[0], 0.01, 10.0)),
                        attribute("northsouth", std::clamp(powers[1], 0.01, 10.0))});
  }
  if (type == "plane") {
    const Vec3 normal = vec3();
    comma();
    const double length =
        std::sqrt(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    const double way = float_expression();
    if (length == 0) fail("the normal of a plane has no direction");
    return make_object(
        "Plane", {attribute("normal", normal), attribute("position", normal * (way / length))});
  }
  if (type == "disc") {
    const Vec3 center = vec3();
    comma();
    const Vec3 normal = vec3();
    comma();
    const double radius = float_expression();
    if (take_sign(",")) {
      float_expression();
      notes().lost(at, "a disc with a hole is not understood");
      return nullptr;
    }
    return make_object("Disc", {attribute("center", center), attribute("normal", normal),
                                attribute("radius", radius)});
  }
  return triangle(type == "smooth_triangle");
}

SharedSolid PovScene::sphere() {
  const Vec3 center = vec3();
  comma();
  const double radius = float_expression();
  if (radius == 0) return nullptr;
  return make_object("Sphere",
                     {attribute("center", center), attribute("radius", std::abs(radius))});
}

SharedSolid PovScene::box() {
  const Vec3 a = vec3();
  comma();
  const Vec3 b = vec3();
  if (a.x == b.x || a.y == b.y || a.z == b.z) return nullptr;
  return make_object("Box", {attribute("cornerA", a), attribute("cornerB", b)});
}

SharedSolid PovScene::cone(bool is_cylinder, const Place& at) {
  Vec3 from = vec3();
  comma();
  double radius = is_cylinder ? 0 : std::abs(float_expression());
  if (!is_cylinder) comma();
  Vec3 to = vec3();
  comma();
  double other = std::abs(float_expression());
  if (is_cylinder) radius = other;
  if (from == to || (radius == 0 && other == 0)) {
    notes().differs(at, "this has no size, and is left out");
    return nullptr;
  }
  if (radius == 0) {
    std::swap(from, to);
    std::swap(radius, other);
  }
  std::vector<std::string> attributes{attribute("from", from), attribute("to", to),
                                      attribute("radius", radius)};
  if (radius == other) return make_object("Cylinder", attributes);
  if (other != 0) attributes.push_back(attribute("radius2", other));
  return make_object("Cone", attributes);
}

SharedSolid PovScene::blob() {
  std::vector<std::string> parts;
  double threshold = 1;
  while (peek().is_word("threshold") || peek().is_word("sphere") || peek().is_word("cylinder") ||
         peek().is_word("component")) {
    const PovToken word = take();
    if (word.text == "component") {
      // It is how scenes of old say what a ball is: its strength, its radius and its center.
      const double strength = float_expression();
      comma();
      const double radius = float_expression();
      comma();
      parts.push_back(
          list_text({vector_text(vec3()), number_text(std::abs(radius)), number_text(strength)}));
      continue;
    }
    if (word.text == "threshold") {
      threshold = float_expression();
      continue;
    }
    expect("{", "behind a part of a blob");
    std::vector<std::string> part{vector_text(vec3())};
    comma();
    if (word.text == "cylinder") {
      part.push_back(vector_text(vec3()));
      comma();
    }
    part.push_back(number_text(float_expression()));
    comma();
    take_word("strength");
    part.push_back(number_text(float_expression()));
    parts.push_back(list_text(part));
    PovObject ignored;
    modifiers(ignored, [&](const std::string& name) {
      if (name != "translate" && name != "rotate" && name != "scale") return false;
      notes().lost(place(), "a part of a blob that is moved is not understood");
      transform(name);
      return true;
    });
  }
  if (parts.empty()) return nullptr;
  return make_object("Blob",
                     {attribute("parts", list_text(parts)), attribute("threshold", threshold)});
}

SharedSolid PovScene::quadric() {
  const Vec3 squares = vec3();
  comma();
  const Vec3 products = vec3();
  comma();
  const Vec3 linear = vec3();
  comma();
  std::vector<std::string> attributes{attribute("squares", squares)};
  if (products != Vec3(0, 0, 0)) attributes.push_back(attribute("products", products));
  if (linear != Vec3(0, 0, 0)) attributes.push_back(attribute("linear", linear));
  attributes.push_back(attribute("constant", float_expression()));
  return make_object("Quadric", attributes);
}

bool PovScene::take_spline(Spline& spline) {
  if (take_word("linear_spline"))
    spline = Spline::linear;
  else if (take_word("quadratic_spline"))
    spline = Spline::quadratic;
  else if (take_word("cubic_spline"))
    spline = Spline::cubic;
  else if (take_word("bezier_spline"))
    spline = Spline::bezier;
  else
    return false;
  return true;
}

SharedSolid PovScene::prism(const Place& at) {
  Spline spline = Spline::linear;
  bool is_cone = false;
  while (true) {
    if (take_word("conic_sweep"))
      is_cone = true;
    else if (!take_word("linear_sweep") && !take_spline(spline))
      break;
  }
  const double low = float_expression();
  comma();
  const double high = float_expression();
  comma();
  const double count_of_points = float_expression();
  std::vector<Point> points;
  for (double i = 0; i < count_of_points || peek().is_sign("<"); ++i) {
    comma();
    const PovVector p = numbers(2);
    points.push_back({p[0], p[1]});
    comma();
  }
  if (is_cone) {
    notes().lost(at, "a prism with conic_sweep is not understood");
    return nullptr;
  }
  std::vector<std::string> contours;
  for (const std::vector<Point>& contour : contours_of(points, spline))
    contours.push_back(list_text(corners_of(contour, spline)));
  if (contours.empty() || low == high) return nullptr;
  std::vector<std::string> changes{upright_in_pov};
  if (low != 0) changes.push_back("translate " + vector_text({0, low, 0}));
  return make_changed(
      make_object("Extrusion",
                  {attribute("profile", contours.size() == 1 ? contours[0] : list_text(contours)),
                   attribute("height", high - low)}),
      changes);
}

SharedSolid PovScene::lathe(const Place& at, bool is_sor) {
  Spline spline = is_sor ? Spline::cubic : Spline::linear;
  if (is_sor) notes().differs(at, "this sor is given the curve of a cubic spline");
  while (take_spline(spline)) {
  }
  const double count_of_points = float_expression();
  std::vector<Point> points;
  for (double i = 0; i < count_of_points; ++i) {
    comma();
    const PovVector p = numbers(2);
    points.push_back({std::abs(p[0]), p[1]});
  }
  const std::size_t before = spline == Spline::quadratic || spline == Spline::cubic ? 1 : 0;
  const std::size_t behind = spline == Spline::cubic ? 1 : 0;
  if (points.size() < before + behind + 2) return nullptr;
  std::vector<std::string> corners = corners_of(points, spline);
  const Point& first = points[before];
  const Point& last = points[points.size() - 1 - behind];
  const bool is_closed = first.x == last.x && first.y == last.y;
  if (!is_closed) {
    if (first.x != 0 || last.x != 0)
      notes().differs(at, "this surface is open, and gets flat ends: it is a solid here");
    if (last.x != 0) corners.push_back(corner({0, last.y}));
    if (first.x != 0) corners.insert(corners.begin(), corner({0, first.y}));
  }
  return make_object("Revolution", {attribute("profile", list_text(corners))});
}

SharedSolid PovScene::text_object(const Place& at) {
  if (!take_word("ttf") && !take_word("internal")) fail("'ttf' is expected here");
  const PovValue font = expression();
  const std::string* const name = font.get<std::string>();
  comma();
  const std::string content = text_expression();
  comma();
  const double depth = float_expression();
  comma();
  const PovVector offset = numbers(3);
  if (content.empty() || depth == 0) return nullptr;
  notes().differs(at, text::format("the font '{}' is not used: the letters are those of "
                                   "Liberation Sans",
                                   name ? *name : "internal"));
  if (offset[0] != 0 || offset[1] != 0)
    notes().differs(at, "the distances of these letters are those of the font");
  return make_object("Text", {attribute("text", quoted_text(content)), attribute("depth", depth)});
}

}  // namespace crt::importing
