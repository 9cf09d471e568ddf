// Faces are cut into triangles by taking off ears.
// Source: Meisters, Polygons have ears, 1975.
// Tests: tests/csg/polyhedron_test.cpp
#include "crt/polyhedron.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

#include "core/geometry/checks.hpp"
#include "core/geometry/exact_sides.hpp"
#include "crt/error.hpp"
#include "crt/mesh.hpp"
#include "text/format.hpp"

namespace crt {

namespace core {

namespace {

using FaceCorners = std::vector<std::uint32_t>;

[[noreturn]] void reject_face(std::size_t face, std::string_view rule) {
  reject("faces", text::format("face {} {}", face, rule));
}

/// A FlatFace is a face as it is seen along the axis that it is most across.
class FlatFace {
 public:
  FlatFace(const Polyhedron& solid, std::size_t number) : number_(number) {
    const FaceCorners& corners = solid.faces[number];
    // By Newell's method: the sum over the edges is twice the area across each axis.
    const Vec3& origin = solid.points[corners[0]];
    Vec3 normal(0, 0, 0);
    double size = 0;
    for (const std::uint32_t corner : corners) {
      const Vec3 off = glm::abs(solid.points[corner] - origin);
      size = std::max({size, off.x, off.y, off.z});
    }
    if (size == 0) reject_face(number, "has no area");
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 a = (solid.points[corners[i]] - origin) / size;
      const Vec3 b = (solid.points[corners[(i + 1) % corners.size()]] - origin) / size;
      normal += glm::cross(a, b);
    }
    int axis = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
    if (normal[axis] == 0) reject_face(number, "has no area");
    const int s = (axis + 1) % 3;
    const int t = (axis + 2) % 3;
    for (const std::uint32_t corner : corners) {
      const Vec3& point = solid.points[corner];
      // It is counterclockwise.
      const Vec3 flat =
          normal[axis] > 0 ? Vec3(point[s], point[t], 0) : Vec3(point[t], point[s], 0);
      places_.push_back({corner, flat});
    }
  }

  void cut(std::vector<TriangleIndices>& triangles) {
    while (places_.size() > 3) {
      const std::size_t ear = find_ear();
      triangles.push_back({before(ear).corner, places_[ear].corner, after(ear).corner});
      places_.erase(places_.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (side_of(places_[2].flat, places_[0].flat, places_[1].flat) < 0) reject_crossing();
    triangles.push_back({places_[0].corner, places_[1].corner, places_[2].corner});
  }

 private:
  struct Place {
    std::uint32_t corner = 0;
    Vec3 flat{0, 0, 0};
  };
  const Place& before(std::size_t i) const {
    return places_[(i + places_.size() - 1) % places_.size()];
  }
  const Place& after(std::size_t i) const { return places_[(i + 1) % places_.size()]; }

  std::size_t find_ear() const {
    for (std::size_t i = 0; i < places_.size(); ++i)
      if (is_ear(i)) return i;
    reject_crossing();
  }
  [[noreturn]] void reject_crossing() const { reject_face(number_, "crosses or touches itself"); }
  /// Returns whether the triangle of a corner and those beside it is in the face.
  bool is_ear(std::size_t i) const {
    const Vec3& a = before(i).flat;
    const Vec3& b = places_[i].flat;
    const Vec3& c = after(i).flat;
    const int turn = side_of(c, a, b);
    // A corner on a straight edge is one that has no area, so that the edge stays as it is.
    if (turn == 0) return glm::dot(b - a, c - b) > 0;
    if (turn < 0) return false;
    return std::ranges::none_of(places_, [&](const Place& other) {
      if (other.flat == a || other.flat == b || other.flat == c) return false;
      return side_of(other.flat, a, b) >= 0 && side_of(other.flat, b, c) >= 0 &&
             side_of(other.flat, c, a) >= 0;
    });
  }

  std::size_t number_;
  std::vector<Place> places_;
};

void check_face(const Polyhedron& solid, std::size_t number) {
  const FaceCorners& face = solid.faces[number];
  if (face.size() < 3) reject_face(number, "must have at least 3 corners");
  if (face.size() > most_corners_of_face)
    throw Error(ErrorCode::limit, text::format("face {} has {} corners; at most {} are possible",
                                               number, face.size(), most_corners_of_face));
  for (const std::uint32_t corner : face) {
    if (corner >= solid.points.size())
      reject_face(number, text::format("has the corner {}, but there are {} points", corner,
                                       solid.points.size()));
  }
  FaceCorners sorted = face;
  std::ranges::sort(sorted);
  if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
    reject_face(number, text::format("has the corner {} twice", *twice));
}

void check_edges(const Polyhedron& solid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> counts;
  for (const FaceCorners& face : solid.faces)
    for (std::size_t i = 0; i < face.size(); ++i)
      ++counts[std::minmax({face[i], face[(i + 1) % face.size()]})];
  for (const auto& [edge, count] : counts) {
    if (count % 2 == 0) continue;
    reject("faces", text::format("must enclose a solid: the edge from point {} to {} belongs to {} "
                                 "of them",
                                 edge.first, edge.second, count));
  }
}

}  // namespace

}  // namespace core

Polyhedron::operator Entity() const {
  if (faces.empty()) core::reject("faces", "must not be empty");
  for (const Vec3& point : points) core::check_coordinates("points", point);
  std::vector<TriangleIndices> triangles;
  for (std::size_t i = 0; i < faces.size(); ++i) core::check_face(*this, i);
  core::check_edges(*this);
  for (std::size_t i = 0; i < faces.size(); ++i) core::FlatFace(*this, i).cut(triangles);
  return Mesh{.triangles = mesh_triangles(points, triangles), .material = material};
}

}  // namespace crt
