// Hulls and Minkowski sums of OpenSCAD's solids, where they are known exactly, or of facets.
#include <algorithm>
#include <cmath>
#include <crt/error.hpp>
#include <crt/polyhedron.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "import/openscad.hpp"
#include "text/format.hpp"

namespace crt::importing {

namespace {

struct Ball {
  Vec3 center{0, 0, 0};
  double radius = 0;
};

/// A Prism is a region that is drawn out along z.
struct Prism {
  Region region{};
  double low = 0;
  double high = 0;
};

/// A Shape is what a hull is made of: points, balls and upright prisms, which have points, too,
/// unless they are round.
struct Shape {
  std::vector<Vec3> points{};
  std::vector<Ball> balls{};
  std::vector<Prism> prisms{};
  bool is_known = true;
  bool is_one_convex = true;  ///< whether it is a lone convex solid

  bool is_empty() const { return points.empty() && balls.empty() && prisms.empty(); }
  bool is_straight() const {
    return balls.empty() && std::none_of(prisms.begin(), prisms.end(),
                                         [](const Prism& prism) { return has_arcs(prism.region); });
  }
  bool has_only_prisms() const { return balls.empty() && !prisms.empty() && free_points == 0; }
  std::size_t free_points = 0;  ///< how many points are of no prism
};

void add_points(Shape& shape, const std::vector<Vec3>& points, const Matrix& matrix) {
  for (const Vec3& point : points) shape.points.push_back(map_point(matrix, point));
  shape.free_points += points.size();
}

/// Says whether a map leaves z upright.
bool is_upright(const Matrix& m) {
  return m[0][2] == 0 && m[1][2] == 0 && m[2][0] == 0 && m[2][1] == 0;
}

void add_prism(Shape& shape, const Prism& prism, const Matrix& matrix) {
  const bool is_round = has_arcs(prism.region);
  if (!is_round) {
    for (const Contour& contour : prism.region) {
      for (const ProfilePoint& p : contour) {
        shape.points.push_back(map_point(matrix, {p.x, p.y, prism.low}));
        shape.points.push_back(map_point(matrix, {p.x, p.y, prism.high}));
        if (!is_upright(matrix)) shape.free_points += 2;
      }
    }
  }
  if (!is_upright(matrix)) {
    shape.is_known = shape.is_known && !is_round;
    return;
  }
  const double a = matrix[2][2] * prism.low + matrix[2][3];
  const double b = matrix[2][2] * prism.high + matrix[2][3];
  shape.prisms.push_back({mapped(prism.region, matrix), std::min(a, b), std::max(a, b)});
}

}  // namespace

/// Reads what hulls are made of.
class HullReader {
 public:
  HullReader(OpenScad& scad, bool facets) : scad_(scad), facets_(facets) {}

  Shape shape(const CsgNode& node) {
    Shape result;
    add(result, node, identity_matrix);
    result.is_one_convex = leaves_ == 1 && is_convex_;
    return result;
  }

 private:
  void add_all(Shape& shape, const CsgNode& node, const Matrix& matrix) {
    for (const CsgNode* const child : children_of(node)) add(shape, *child, matrix);
  }

  void add(Shape& shape, const CsgNode& node, const Matrix& matrix) {
    if (is_group(node) || node.name == "union" || node.name == "hull") {
      if (node.name == "hull" && shape.is_empty()) {
        add_all(shape, node, matrix);
        leaves_ = 1;  // its points are those of one convex solid
        is_convex_ = true;
        return;
      }
      return add_all(shape, node, matrix);
    }
    if (node.name == "multmatrix") {
      const auto own = matrix_of(node);
      if (own && determinant(*own) != 0) add_all(shape, node, product(matrix, *own));
      return;
    }
    ++leaves_;
    if (node.name == "cube") return add_cube(shape, node, matrix);
    if (node.name == "sphere") return add_sphere(shape, node, matrix);
    if (node.name == "cylinder") return add_cylinder(shape, node, matrix);
    if (node.name == "linear_extrude") return add_extrude(shape, node, matrix);
    if (node.name == "polyhedron") {
      is_convex_ = false;
      std::vector<Vec3> points;
      for (const CsgValue& item : node.argument("points").items)
        if (const auto point = numbers_of(item, 3))
          points.emplace_back((*point)[0], (*point)[1], (*point)[2]);
      return add_points(shape, points, matrix);
    }
    shape.is_known = false;
    if (facets_)
      scad_.notes_.lost(node.place, text::format("'{}' within a hull() or minkowski() is not "
                                                 "understood",
                                                 node.name));
  }

  void add_cube(Shape& shape, const CsgNode& node, const Matrix& matrix) const {
    const auto size = size_of(node, 3);
    if (!size) return;
    const double x = (*size)[0], y = (*size)[1], z = (*size)[2];
    const bool center = node.flag("center");
    const double low_x = center ? -x / 2 : 0, low_y = center ? -y / 2 : 0;
    const double low = center ? -z / 2 : 0;
    add_prism(shape, {{rectangle_contour(low_x, low_y, low_x + x, low_y + y)}, low, low + z},
              matrix);
  }

  void add_sphere(Shape& shape, const CsgNode& node, const Matrix& matrix) const {
    const double radius = node.number("r", 1);
    if (!(radius > 0) || !std::isfinite(radius)) return;
    if (facets_ || scad_.is_faceted(node)) {
      const Faces faces = sphere_facets(radius, fragments_of(radius, resolution_of(node)));
      return add_points(shape, faces.points, matrix);
    }
    const auto scale = even_scale(matrix, 3e-6);
    if (!scale) {
      shape.is_known = false;
      return;
    }
    shape.balls.push_back({map_point(matrix, {0, 0, 0}), radius * *scale});
  }

  void add_cylinder(Shape& shape, const CsgNode& node, const Matrix& matrix) const {
    const double height = node.number("h", 1);
    const double r1 = node.number("r1", 1), r2 = node.number("r2", 1);
    if (!(height > 0) || !(r1 >= 0) || !(r2 >= 0) || !std::isfinite(height + r1 + r2)) return;
    const double low = node.flag("center") ? -height / 2 : 0;
    const bool facets = facets_ || scad_.is_faceted(node);
    const int fragments = facets ? fragments_of(std::max(r1, r2), resolution_of(node)) : 0;
    if (r1 == r2)
      return add_prism(shape, {{circle_contour(0, 0, r1, fragments)}, low, low + height}, matrix);
    if (facets)
      return add_points(shape, frustum_facets(low, r1, low + height, r2, fragments).points, matrix);
    shape.is_known = false;
  }

  void add_extrude(Shape& shape, const CsgNode& node, const Matrix& matrix) {
    const double height = node.number("height", 100);
    const auto scale = node.numbers("scale", 2);
    const bool is_plain =
        node.number("twist", 0) == 0 && (!scale || ((*scale)[0] == 1 && (*scale)[1] == 1));
    if (!(height > 0) || !std::isfinite(height)) return;
    if (!is_plain) {
      shape.is_known = false;
      if (facets_) scad_.notes_.lost(node.place, "the hull of what is twisted is not understood");
      return;
    }
    is_convex_ = false;
    const double low = node.flag("center") ? -height / 2 : 0;
    const Region region = scad_.guarded(node, [&] { return united(scad_.regions(node, facets_)); });
    add_prism(shape, {region, low, low + height}, matrix);
  }

  OpenScad& scad_;
  bool facets_;
  int leaves_ = 0;
  bool is_convex_ = true;
};

namespace {

SharedSolid upright(const Region& region, double low, double high) {
  if (region.empty()) return nullptr;
  SharedSolid solid = make_object(
      "Extrusion", {attribute("profile", profile_text(region)), attribute("height", high - low)});
  if (low == 0) return solid;
  return make_changed(solid, {"translate " + vector_text({0, 0, low})});
}

/// Says whether balls are at the corners of an upright box, each once.
bool are_corners(const std::vector<Ball>& balls, const Vec3& low, const Vec3& high) {
  std::set<int> corners;
  for (const Ball& ball : balls) {
    int corner = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double at = ball.center[axis];
      if (at != low[axis] && at != high[axis]) return false;
      if (at == high[axis]) corner |= 1 << axis;
    }
    corners.insert(corner);
  }
  return corners.size() == 8;
}

SharedSolid rounded_box(const Vec3& low, const Vec3& high, double radius) {
  const Vec3 room{radius, radius, radius};
  return make_object("RoundedBox",
                     {attribute("cornerA", low - room), attribute("cornerB", high + room),
                      attribute("radius", radius)});
}

/// Returns the hull of balls, where a script has a word for it.
SharedSolid hull_of_balls(const std::vector<Ball>& balls) {
  const double radius = balls.front().radius;
  const bool are_equal = std::all_of(balls.begin(), balls.end(),
                                     [&](const Ball& ball) { return ball.radius == radius; });
  if (balls.size() == 1) {
    return make_object("Sphere",
                       {attribute("center", balls.front().center), attribute("radius", radius)});
  }
  if (balls.size() == 2 && are_equal) {
    return make_object("Capsule", {attribute("from", balls[0].center),
                                   attribute("to", balls[1].center), attribute("radius", radius)});
  }
  if (balls.size() == 2) {
    return make_object(
        "Tube",
        {attribute("path", list_text({vector_text(balls[0].center), vector_text(balls[1].center)})),
         attribute("radii", list_text({number_text(radius), number_text(balls[1].radius)}))});
  }
  Vec3 low = balls.front().center, high = low;
  for (const Ball& ball : balls) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], ball.center[axis]);
      high[axis] = std::max(high[axis], ball.center[axis]);
    }
  }
  return are_equal && are_corners(balls, low, high) ? rounded_box(low, high, radius) : nullptr;
}

SharedSolid hull_of_prisms(const std::vector<Prism>& prisms) {
  std::vector<Region> regions;
  for (const Prism& prism : prisms) {
    if (prism.low != prisms.front().low || prism.high != prisms.front().high) return nullptr;
    regions.push_back(prism.region);
  }
  return upright(hull_of(regions), prisms.front().low, prisms.front().high);
}

SharedSolid hull_of_points(const std::vector<Vec3>& all) {
  std::set<std::tuple<double, double, double>> kept;
  for (const Vec3& point : all) kept.emplace(point.x, point.y, point.z);
  if (kept.size() < 4) return nullptr;
  if (kept.size() > most_hull_points)
    throw Error(ErrorCode::limit, text::format("it has {} corners, and a Hull at most {}",
                                               kept.size(), most_hull_points));
  std::vector<std::string> points;
  points.reserve(kept.size());
  for (const auto& [x, y, z] : kept) points.push_back(vector_text({x, y, z}));
  return make_object("Hull", {attribute("points", list_text(points))});
}

SharedSolid exact_hull(const Shape& shape) {
  if (!shape.is_known) return nullptr;
  if (shape.has_only_prisms()) {
    try {
      if (SharedSolid solid = hull_of_prisms(shape.prisms)) return solid;
    } catch (const Error&) {
      // Arcs that are no circles have a hull of facets.
    }
  }
  if (shape.is_straight()) return hull_of_points(shape.points);
  return shape.points.empty() && shape.prisms.empty() ? hull_of_balls(shape.balls) : nullptr;
}

/// Returns the box of a shape that is just one, upright.
std::optional<std::pair<Vec3, Vec3>> box_of(const Shape& shape) {
  if (!shape.is_one_convex || !shape.has_only_prisms() || shape.prisms.size() != 1) return {};
  const Prism& prism = shape.prisms.front();
  if (prism.region.size() != 1 || prism.region.front().size() != 4) return {};
  const RegionBounds bounds = bounds_of(prism.region);
  for (const ProfilePoint& p : prism.region.front()) {
    const bool is_corner = p.bulge == 0 && (p.x == bounds.low_x || p.x == bounds.high_x) &&
                           (p.y == bounds.low_y || p.y == bounds.high_y);
    if (!is_corner) return {};
  }
  return std::pair(Vec3(bounds.low_x, bounds.low_y, prism.low),
                   Vec3(bounds.high_x, bounds.high_y, prism.high));
}

bool is_lone_ball(const Shape& shape) {
  return shape.is_known && shape.balls.size() == 1 && shape.points.empty() && shape.prisms.empty();
}

bool is_lone_circle(const Prism& prism) {
  return prism.region.size() == 1 && prism.region.front().size() == 2;
}

/// Adds up two shapes, where the sum is known.
SharedSolid exact_sum(const Shape& a, const Shape& b) {
  if (!a.is_known || !b.is_known) return nullptr;
  if (is_lone_ball(a) && !is_lone_ball(b)) return exact_sum(b, a);
  if (is_lone_ball(b)) {
    const Ball& ball = b.balls.front();
    if (const auto box = box_of(a))
      return rounded_box(box->first + ball.center, box->second + ball.center, ball.radius);
    return nullptr;
  }
  if (!a.has_only_prisms() || !b.has_only_prisms() || a.prisms.size() != 1 || b.prisms.size() != 1)
    return nullptr;
  const Prism& p = a.prisms.front();
  const Prism& q = b.prisms.front();
  if (is_lone_circle(p) && !is_lone_circle(q)) return exact_sum(b, a);
  if (!is_lone_circle(q)) return nullptr;
  const RegionBounds bounds = bounds_of(q.region);
  const auto wide =
      offset_region(p.region, (bounds.high_x - bounds.low_x) / 2, OffsetCorner::round, 0);
  if (!wide) return nullptr;
  Matrix shift = identity_matrix;
  shift[0][3] = (bounds.low_x + bounds.high_x) / 2;
  shift[1][3] = (bounds.low_y + bounds.high_y) / 2;
  return upright(mapped(*wide, shift), p.low + q.low, p.high + q.high);
}

}  // namespace

SharedSolid OpenScad::hull(const CsgNode& node) {
  try {
    const Shape round = HullReader(*this, options_.facets).shape(node);
    if (round.is_known && round.is_empty()) return nullptr;
    if (SharedSolid solid = exact_hull(round)) return solid;
    const Shape straight = options_.facets ? round : HullReader(*this, true).shape(node);
    if (!straight.is_known) return nullptr;
    if (!options_.facets)
      notes_.differs(node.place, "this hull of round solids is made of OpenSCAD's facets");
    return hull_of_points(straight.points);
  } catch (const Error& error) {
    notes_.lost(node.place, text::format("this hull is left out: {}", error.what()));
    return nullptr;
  }
}

SharedSolid OpenScad::minkowski(const CsgNode& node) {
  const std::vector<const CsgNode*> children = children_of(node);
  if (children.size() == 1) return solid(*children.front(), true);
  try {
    if (children.size() == 2) {
      const Shape a = HullReader(*this, options_.facets).shape(*children[0]);
      const Shape b = HullReader(*this, options_.facets).shape(*children[1]);
      if (SharedSolid solid = exact_sum(a, b)) return solid;
    }
    std::vector<Vec3> sums{{0, 0, 0}};
    bool is_round = false;
    for (const CsgNode* const child : children) {
      const Shape shape = HullReader(*this, true).shape(*child);
      is_round = is_round || !HullReader(*this, false).shape(*child).is_straight();
      if (!shape.is_known) return nullptr;
      if (shape.is_empty()) return nullptr;
      if (!shape.is_one_convex) {
        notes_.lost(child->place,
                    "minkowski() is understood of solids that are surely convex: cubes, spheres, "
                    "cylinders and hulls");
        return nullptr;
      }
      std::vector<Vec3> next;
      if (sums.size() * shape.points.size() > 100000)
        throw Error(ErrorCode::limit, "it has too many corners");
      for (const Vec3& sum : sums)
        for (const Vec3& point : shape.points) next.push_back(sum + point);
      sums = std::move(next);
    }
    if (!options_.facets && is_round)
      notes_.differs(node.place, "this minkowski() is made of OpenSCAD's facets");
    return hull_of_points(sums);
  } catch (const Error& error) {
    notes_.lost(node.place, text::format("this minkowski() is left out: {}", error.what()));
    return nullptr;
  }
}

}  // namespace crt::importing
