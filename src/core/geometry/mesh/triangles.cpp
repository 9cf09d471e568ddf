#include "core/geometry/mesh/triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/geometry/canonical_plane.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/exact_plane.hpp"
#include "core/geometry/mesh/equal_positions.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"

namespace crt {

using namespace core;

namespace {

[[noreturn]] void reject_mesh(const std::string& message, const char* argument) {
  throw Error(ErrorCode::invalid_argument, message, argument);
}

void check_indices(std::span<const TriangleIndices> triangles, std::size_t positions) {
  if (triangles.size() > Bvh::most_items || positions > 0xffffffffu) {
    reject_mesh(fmt::format("a mesh has at most {} triangles", Bvh::most_items), "triangles");
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t index : triangles[i]) {
      if (index < positions) continue;
      reject_mesh(fmt::format("triangle {} has the index {}, but there are {} positions", i, index,
                              positions),
                  "indices");
    }
  }
}

/// An Edge is one use of an edge by a triangle.
struct Edge {
  std::uint32_t low;   ///< the lower number of its corners
  std::uint32_t high;  ///< the higher
  std::uint32_t triangle;
  bool upwards;  ///< whether it runs from the lower to the higher

  friend bool operator<(const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  }
};

std::vector<Edge> edges_of(std::span<const TriangleIndices> triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[i][k];
      const std::uint32_t to = triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// A PlaneKey is the plane of a triangle. Equal planes have equal numbers.
struct PlaneKey {
  CanonicalPlane plane;
  std::uint32_t triangle = 0;

  friend bool operator<(const PlaneKey& a, const PlaneKey& b) {
    return std::tie(a.plane.numbers, a.triangle) < std::tie(b.plane.numbers, b.triangle);
  }
};

PlaneKey plane_key(const Triangle& triangle, std::uint32_t number) {
  const PreciseVec3 normal = precise_normal_of(triangle);
  const Vec3& corner = triangle.a;
  return {CanonicalPlane::of(normal, dot(normal, {corner.x, corner.y, corner.z})), number};
}

/// Returns whether a triangle lies in the plane of another, without rounding.
bool is_in_plane(const Triangle& triangle, const Triangle& of_plane) {
  const Vec3* const corners[] = {&triangle.a, &triangle.b, &triangle.c};
  const auto shares_coordinate = [&](int axis) {
    const double place = of_plane.a[axis];
    return of_plane.b[axis] == place && of_plane.c[axis] == place &&
           std::all_of(std::begin(corners), std::end(corners),
                       [&](const Vec3* corner) { return (*corner)[axis] == place; });
  };
  if (shares_coordinate(0) || shares_coordinate(1) || shares_coordinate(2)) return true;
  const DyadicVector origin = exactly(of_plane.a);
  const DyadicVector normal = exact_normal(of_plane.a, of_plane.b, of_plane.c);
  return std::all_of(std::begin(corners), std::end(corners), [&](const Vec3* corner) {
    return *corner == of_plane.a || *corner == of_plane.b || *corner == of_plane.c ||
           dot(normal, exactly(*corner) - origin).sign() == 0;
  });
}

}  // namespace

MeshTriangles::MeshTriangles(std::span<const Vec3> positions,
                             std::span<const TriangleIndices> triangles) {
  for (const Vec3& position : positions) check_coordinates("positions", position);
  check_indices(triangles, positions.size());
  positions_.assign(positions.begin(), positions.end());
  std::vector<TriangleIndices> welded(triangles.begin(), triangles.end());
  weld(welded);
  find_open_edges(welded);
  for (const TriangleIndices& indices : welded) {
    const auto [a, b, c] = indices;
    if (has_area({.a = positions_[a], .b = positions_[b], .c = positions_[c]})) {
      triangles_.push_back(indices);
    }
  }
  if (triangles_.empty()) {
    reject_mesh("a mesh needs at least one triangle that has an area", "triangles");
  }
  for (const TriangleIndices& indices : triangles_) {
    for (const std::uint32_t index : indices) bounds_.include(positions_[index]);
  }
  if (is_closed() && oriented_) turn_outwards();
  find_planes();
  build_tree();
}

/// Makes equal corners one, and drops triangles of which two corners are one. What these had for
/// edges are two uses of one edge, and one of no length.
void MeshTriangles::weld(std::vector<TriangleIndices>& triangles) {
  const std::vector<std::uint32_t> first = first_equal(positions_);
  for (TriangleIndices& indices : triangles) {
    for (std::uint32_t& index : indices) index = first[index];
  }
  std::erase_if(triangles, [](const TriangleIndices& indices) {
    const auto [a, b, c] = indices;
    return a == b || b == c || c == a;
  });
}

void MeshTriangles::find_open_edges(std::span<const TriangleIndices> triangles) {
  const std::vector<Edge> edges = edges_of(triangles);
  std::size_t count = 0;
  std::size_t open = 0;
  const Edge* first_open = nullptr;
  oriented_ = true;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    std::size_t upwards = 0;
    const auto is_same = [&](const Edge& edge) {
      return edge.low == edges[begin].low && edge.high == edges[begin].high;
    };
    for (; end < edges.size() && is_same(edges[end]); ++end) upwards += edges[end].upwards ? 1 : 0;
    const std::size_t uses = end - begin;
    oriented_ = oriented_ && 2 * upwards == uses;
    ++count;
    if (uses % 2 != 0) {
      ++open;
      if (first_open == nullptr || edges[begin].triangle < first_open->triangle) {
        first_open = &edges[begin];
      }
    }
    begin = end;
  }
  if (first_open == nullptr) return;
  const Vec3& from = positions_[first_open->low];
  const Vec3& to = positions_[first_open->high];
  fault_ = fmt::format(
      "{} of its {} edges belong to an odd number of triangles: the first is from ({}, {}, {}) to "
      "({}, {}, {})",
      open, count, from.x, from.y, from.z, to.x, to.y, to.z);
}

/// Turns all triangles round if their normals point into the solid.
void MeshTriangles::turn_outwards() {
  const Vec3 middle = 0.5 * bounds_.lower + 0.5 * bounds_.upper;
  const double extent = power_of_two_below(largest_component(bounds_.upper - bounds_.lower));
  double volume = 0;
  for (std::uint32_t i = 0; i < size(); ++i) {
    const Triangle corners = triangle(i);
    const auto relative = [&](const Vec3& corner) { return (corner - middle) / extent; };
    volume += glm::dot(relative(corners.a), glm::cross(relative(corners.b), relative(corners.c)));
  }
  if (volume >= 0) return;
  for (TriangleIndices& indices : triangles_) std::swap(indices[1], indices[2]);
}

void MeshTriangles::find_planes() {
  std::vector<PlaneKey> keys;
  keys.reserve(triangles_.size());
  for (std::uint32_t i = 0; i < size(); ++i) keys.push_back(plane_key(triangle(i), i));
  std::sort(keys.begin(), keys.end());
  planes_.resize(triangles_.size());
  std::vector<const PlaneKey*> firsts;  // of the planes with the same key
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const PlaneKey& key = keys[i];
    if (i == 0 || key.plane.numbers != keys[i - 1].plane.numbers) firsts.clear();
    const auto found = std::find_if(firsts.begin(), firsts.end(), [&](const PlaneKey* first) {
      return is_in_plane(triangle(key.triangle), triangle(first->triangle));
    });
    const PlaneKey& first = found != firsts.end() ? **found : key;
    if (found == firsts.end()) firsts.push_back(&key);
    planes_[key.triangle] = {.first = first.triangle & 0x7fffffffu,
                             .turned = key.plane.flipped != first.plane.flipped};
  }
}

void MeshTriangles::build_tree() {
  std::vector<Bounds> boxes(triangles_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const std::uint32_t index : triangles_[i]) boxes[i].include(positions_[index]);
  }
  constexpr std::uint32_t triangles_a_leaf = 4;
  constexpr int one_thread = 1;
  tree_ = Bvh(boxes, triangles_a_leaf, one_thread);
}

std::size_t MeshTriangles::bytes() const {
  return sizeof *this + positions_.capacity() * sizeof(Vec3) +
         triangles_.capacity() * sizeof(TriangleIndices) + planes_.capacity() * sizeof(PlaneOf) +
         tree_.bytes();
}

}  // namespace crt
