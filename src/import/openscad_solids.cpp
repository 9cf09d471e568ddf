// Solid modules of OpenSCAD become solids of scripts.
#include <algorithm>
#include <array>
#include <cmath>
#include <crt/error.hpp>
#include <crt/measure.hpp>
#include <string_view>

#include "import/openscad.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

template <std::size_t N>
bool is_one_of(std::string_view name, const std::array<std::string_view, N>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

constexpr std::size_t most_facets_of_all = 1000000;

constexpr std::array<std::string_view, 4> flat_names = {"square", "circle", "polygon", "text"};
constexpr std::array<std::string_view, 7> solid_names = {
    "cube", "sphere", "cylinder", "polyhedron", "linear_extrude", "rotate_extrude", "surface"};

bool ends_with(std::string_view name, std::string_view ending) {
  return name.size() >= ending.size() && name.substr(name.size() - ending.size()) == ending;
}

/// Fits factors of a resize() to the axes that follow the others.
Vec3 resize_factors(const CsgNode& node, const Vec3& size) {
  Vec3 factors{1, 1, 1};
  const auto wanted = node.numbers("newsize", 3);
  const auto fits = node.numbers("auto", 3);
  double largest = 0;
  for (int axis = 0; wanted && axis < 3; ++axis) {
    const double length = (*wanted)[static_cast<std::size_t>(axis)];
    if (length <= 0 || !(size[axis] > 0)) continue;
    factors[axis] = length / size[axis];
    largest = std::max(largest, factors[axis]);
  }
  for (int axis = 0; wanted && fits && axis < 3 && largest > 0; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    if ((*wanted)[at] <= 0 && (*fits)[at] != 0) factors[axis] = largest;
  }
  return factors;
}

}  // namespace

bool is_group(const CsgNode& node) {
  return node.name == "group" || node.name == "color" || node.name == "render" ||
         node.name == "part";
}

std::vector<const CsgNode*> children_of(const CsgNode& node) {
  std::vector<const CsgNode*> children;
  for (const CsgNode& child : node.children)
    if (child.modifier != '%' && child.modifier != '*') children.push_back(&child);
  return children;
}

int dimension_of(const CsgNode& node) {
  if (is_one_of(node.name, flat_names) || node.name == "projection" || node.name == "offset")
    return 2;
  if (is_one_of(node.name, solid_names)) return 3;
  if (node.name == "import") {
    const std::string file = node.text("file");
    return ends_with(file, ".dxf") || ends_with(file, ".svg") ? 2 : 3;
  }
  for (const CsgNode& child : node.children)
    if (const int dimension = dimension_of(child)) return dimension;
  return 0;
}

std::optional<Matrix> matrix_of(const CsgNode& node) {
  const CsgValue& rows = node.argument("");
  if (rows.items.size() < 3) return {};
  Matrix matrix{};
  for (std::size_t row = 0; row < 3; ++row) {
    const auto numbers = numbers_of(rows.items[row], 4);
    if (!numbers) return {};
    std::copy_n(numbers->begin(), 4, matrix[row].begin());
  }
  return matrix;
}

std::optional<std::vector<double>> size_of(const CsgNode& node, std::size_t dimensions) {
  auto size = node.numbers("size", dimensions);
  if (!size) return {};
  for (std::size_t axis = 0; axis < dimensions; ++axis)
    if (!((*size)[axis] > 0)) return {};
  return size;
}

bool OpenScad::is_faceted(const CsgNode& node) const {
  const double fn = node.number("$fn", 0);
  return options_.facets || (fn > 0 && fn <= most_meant_sides);
}

SharedSolid OpenScad::all(const std::vector<const CsgNode*>& nodes, bool has_color) {
  std::vector<SharedSolid> parts;
  parts.reserve(nodes.size());
  for (const CsgNode* const node : nodes) parts.push_back(solid(*node, has_color));
  return make_sum(std::move(parts));
}

SharedSolid OpenScad::solid(const CsgNode& node, bool has_color) {
  const bool is_leaf = node.children.empty();
  if (is_leaf && !has_color) has_plain_ = true;
  if (node.name == "color") return colored(node, has_color);
  if (is_group(node) || node.name == "union") return all(children_of(node), has_color);
  if (node.name == "multmatrix") return placed(node, all(children_of(node), has_color), false);
  if (node.name == "difference" || node.name == "intersection") {
    std::vector<SharedSolid> parts;
    for (const CsgNode* const child : children_of(node)) parts.push_back(solid(*child, has_color));
    return node.name == "difference" ? make_difference(std::move(parts))
                                     : make_intersection(std::move(parts));
  }
  try {
    return leaf(node, has_color);
  } catch (const Error& error) {
    notes_.lost(node.place, text::format("'{}' is left out: {}", node.name, error.what()));
    return nullptr;
  }
}

SharedSolid OpenScad::made_of(const Faces& faces) {
  facets_ += faces.faces.size();
  if (facets_ > most_facets_of_all)
    throw Error(ErrorCode::limit,
                text::format("all solids together have over {} facets", most_facets_of_all));
  return make_polyhedron(faces);
}

SharedSolid OpenScad::leaf(const CsgNode& node, bool has_color) {
  if (node.name == "cube") return cube(node);
  if (node.name == "sphere") return sphere(node);
  if (node.name == "cylinder") return cylinder(node);
  if (node.name == "polyhedron") return polyhedron(node);
  if (node.name == "linear_extrude" || node.name == "rotate_extrude" || node.name == "hull" ||
      node.name == "minkowski") {
    if (!has_color) has_plain_ = true;
    if (node.name == "linear_extrude") return linear_extrude(node);
    if (node.name == "rotate_extrude") return rotate_extrude(node);
    return node.name == "hull" ? hull(node) : minkowski(node);
  }
  if (node.name == "resize") return resized(node, has_color);
  if (node.name == "import") return imported(node);
  if (node.name == "surface") return surface(node);
  if (dimension_of(node) == 2) {
    notes_.differs(node.place,
                   text::format("'{}' is flat where a solid belongs, and OpenSCAD ignores it, too",
                                node.name));
    return nullptr;
  }
  notes_.lost(node.place, text::format("'{}' is not understood", node.name));
  return nullptr;
}

SharedSolid OpenScad::cube(const CsgNode& node) {
  const auto size = size_of(node, 3);
  if (!size) return nullptr;
  const Vec3 edges{(*size)[0], (*size)[1], (*size)[2]};
  const bool center = node.flag("center");
  return make_object("Box", {attribute("cornerA", center ? edges * -0.5 : Vec3(0, 0, 0)),
                             attribute("cornerB", center ? edges * 0.5 : edges)});
}

SharedSolid OpenScad::sphere(const CsgNode& node) {
  const double radius = node.number("r", 1);
  if (!(radius > 0) || !std::isfinite(radius)) return nullptr;
  if (is_faceted(node))
    return made_of(sphere_facets(radius, fragments_of(radius, resolution_of(node))));
  return make_object("Sphere", {attribute("center", Vec3(0, 0, 0)), attribute("radius", radius)});
}

SharedSolid OpenScad::cylinder(const CsgNode& node) {
  const double height = node.number("h", 1);
  const double r1 = node.number("r1", 1), r2 = node.number("r2", 1);
  if (!(height > 0) || !std::isfinite(height) || !(r1 >= 0) || !(r2 >= 0) ||
      !std::isfinite(r1 + r2) || r1 + r2 == 0)
    return nullptr;
  const double low = node.flag("center") ? -height / 2 : 0, high = low + height;
  if (is_faceted(node)) {
    const int fragments = fragments_of(std::max(r1, r2), resolution_of(node));
    if (r1 != r2) return made_of(frustum_facets(low, r1, high, r2, fragments));
    SharedSolid prism = make_object(
        "Extrusion", {attribute("profile", profile_text({circle_contour(0, 0, r1, fragments)})),
                      attribute("height", height)});
    if (low == 0) return prism;
    return make_changed(prism, {"translate " + vector_text({0, 0, low})});
  }
  const Vec3 from{0, 0, r1 == 0 ? high : low}, to{0, 0, r1 == 0 ? low : high};
  std::vector<std::string> attributes{attribute("from", from), attribute("to", to),
                                      attribute("radius", r1 == 0 ? r2 : r1)};
  if (r1 == r2) return make_object("Cylinder", attributes);
  if (r1 != 0 && r2 != 0) attributes.push_back(attribute("radius2", r2));
  return make_object("Cone", attributes);
}

SharedSolid OpenScad::polyhedron(const CsgNode& node) {
  Faces made;
  for (const CsgValue& item : node.argument("points").items) {
    const auto point = numbers_of(item, 3);
    if (!point) {
      notes_.lost(node.place, "a point of this polyhedron is not three numbers");
      return nullptr;
    }
    made.points.emplace_back((*point)[0], (*point)[1], (*point)[2]);
  }
  const bool has_faces = node.argument("faces").kind == CsgValue::Kind::list;
  for (const CsgValue& face : node.argument(has_faces ? "faces" : "triangles").items) {
    std::vector<std::uint32_t> corners;
    for (const CsgValue& corner : face.items) {
      if (!(corner.number >= 0) || !(corner.number < static_cast<double>(made.points.size()))) {
        notes_.lost(node.place,
                    "a face of this polyhedron has a corner that is none of its points");
        return nullptr;
      }
      corners.push_back(static_cast<std::uint32_t>(corner.number));
    }
    if (corners.size() >= 3) made.faces.push_back(std::move(corners));
  }
  return made_of(made);
}

SharedSolid OpenScad::imported(const CsgNode& node) {
  const std::string file = node.text("file");
  if (file.empty()) return nullptr;
  if (!ends_with(file, ".stl") && !ends_with(file, ".off") && !ends_with(file, ".3mf")) {
    notes_.lost(node.place, text::format("the file '{}' is not one that is understood: .stl, .off "
                                         "and .3mf are",
                                         file));
    return nullptr;
  }
  return make_object("Mesh", {attribute("file", quoted_text(file))});
}

SharedSolid OpenScad::surface(const CsgNode& node) {
  notes_.lost(node.place, "surface() is not understood: write it as a mesh, and import() that");
  return nullptr;
}

SharedSolid OpenScad::placed(const CsgNode& node, const SharedSolid& solid, bool is_flat) {
  std::optional<Matrix> matrix = matrix_of(node);
  if (!solid) return nullptr;
  if (!matrix) {
    notes_.lost(node.place, "this matrix is not one of finite numbers");
    return nullptr;
  }
  if (is_flat) {
    // A flat thing has no height that could be moved.
    for (std::size_t axis = 0; axis < 4; ++axis) (*matrix)[2][axis] = axis == 2 ? 1 : 0;
    (*matrix)[0][2] = (*matrix)[1][2] = 0;
  }
  if (determinant(*matrix) == 0) {
    notes_.differs(node.place, "this matrix flattens what it is for, and nothing is left");
    return nullptr;
  }
  return make_changed(solid, modifiers_of(*matrix, csg_digits));
}

SharedSolid OpenScad::colored(const CsgNode& node, bool has_color) {
  const auto channels = node.numbers("", 4);
  const bool is_color =
      channels && (*channels)[0] >= 0 && (*channels)[1] >= 0 && (*channels)[2] >= 0;
  if (has_color || !is_color) {
    if (channels && !is_color && (*channels)[3] < 1 && !has_color)
      notes_.differs(node.place, "a transparency without a colour has no effect");
    return all(children_of(node), has_color);
  }
  const std::string color =
      text::format("srgb({}, {}, {})", (*channels)[0], (*channels)[1], (*channels)[2]);
  std::vector<std::string> attributes{attribute("color", color)};
  const double alpha = std::clamp((*channels)[3], 0.0, 1.0);
  if (alpha < 1) attributes.push_back(attribute("transparency", number_text(1 - alpha)));
  std::string material = "Material {";
  for (const std::string& text : attributes) material += " " + text;
  const SharedSolid solid = all(children_of(node), true);
  if (!solid) return nullptr;
  return make_changed(solid, {"material " + writer_.material(material + " }", "paint1")});
}

SharedSolid OpenScad::resized(const CsgNode& node, bool has_color) {
  const SharedSolid child = all(children_of(node), has_color);
  if (!child) return nullptr;
  try {
    const std::optional<Entity> entity = entity_of(child, writer_.materials(), name_);
    if (!entity) {
      notes_.lost(node.place, "this resize() cannot be made, as its solid cannot");
      return nullptr;
    }
    const BoundingBox box = timed([&](MeasureOptions options) {
      options.relative_width = 1e-9;
      return tight_bounding_box(*entity, options);
    });
    const Vec3 factors = resize_factors(node, box.upper - box.lower);
    Matrix matrix{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      matrix[axis][axis] = factors[static_cast<int>(axis)];
    return make_changed(child, modifiers_of(matrix, 0));
  } catch (const Error& error) {
    notes_.lost(node.place, text::format("the size of this is not known: {}", error.what()));
    return nullptr;
  }
}

}  // namespace crt::importing
