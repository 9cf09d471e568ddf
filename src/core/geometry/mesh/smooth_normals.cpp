#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <numbers>
#include <numeric>
#include <optional>

#include "core/geometry/mesh/facet_attributes.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "core/math/direction_and_length.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

double angle_between(const Vec3& a, const Vec3& b) {
  return elementary::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

Vec3 normal_of(const MeshTriangles& mesh, std::uint32_t facet) {
  return direction_and_length(rounded(precise_normal_of(mesh.triangle(facet)))).direction;
}

/// A SmoothSurface has the normals of facets, and which of their corners are one. Corner k of facet
/// f has the number 3 f + k.
class SmoothSurface {
 public:
  explicit SmoothSurface(const MeshTriangles& mesh) : mesh_(mesh) {
    first_of_.resize(std::size_t{3} * mesh.size());
    std::iota(first_of_.begin(), first_of_.end(), 0u);
    normals_.reserve(mesh.size());
    for (std::uint32_t facet = 0; facet < mesh.size(); ++facet)
      normals_.push_back(normal_of(mesh, facet));
  }

  /// Makes two facets one surface where they share an edge, if their normals are that near.
  void join(const EdgePair& pair, double angle) {
    const bool are_near = angle >= std::numbers::pi ||
                          angle_between(normals_[pair.one], normals_[pair.other]) <= angle;
    if (!are_near) return;
    const TriangleIndices& one = mesh_.corners(pair.one);
    const TriangleIndices& other = mesh_.corners(pair.other);
    for (std::uint32_t i = 0; i < 3; ++i) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t next_i = (i + 1) % 3;
        const std::uint32_t next_k = (k + 1) % 3;
        if (one[i] != other[next_k] || one[next_i] != other[k]) continue;
        unite(3 * pair.one + i, 3 * pair.other + next_k);
        unite(3 * pair.one + next_i, 3 * pair.other + k);
        return;
      }
    }
  }

  CornerNormals normals() {
    std::vector<Vec3> sums(first_of_.size(), Vec3(0));
    for (std::uint32_t corner = 0; corner < first_of_.size(); ++corner)
      sums[first(corner)] += angle_at(corner) * normals_[corner / 3];
    CornerNormals result;
    result.of_facets.resize(normals_.size());
    // A corner's first one has its number before the others ask for it.
    for (std::uint32_t corner = 0; corner < first_of_.size(); ++corner) {
      std::uint32_t& index = result.of_facets[corner / 3][corner % 3];
      const std::uint32_t of_first = first(corner);
      if (of_first != corner) {
        index = result.of_facets[of_first / 3][of_first % 3];
        continue;
      }
      index = static_cast<std::uint32_t>(result.values.size());
      const Vec3 unit = direction_and_length(sums[corner]).direction;
      result.values.push_back(
          {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z), 0});
    }
    result.values.shrink_to_fit();
    return result;
  }

 private:
  std::uint32_t first(std::uint32_t corner) {
    while (first_of_[corner] != corner) {
      first_of_[corner] = first_of_[first_of_[corner]];
      corner = first_of_[corner];
    }
    return corner;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = first(a);
    b = first(b);
    first_of_[std::max(a, b)] = std::min(a, b);
  }

  /// Returns the angle of a facet at a corner.
  double angle_at(std::uint32_t corner) const {
    const Triangle triangle = mesh_.triangle(corner / 3);
    const std::array<Vec3, 3> corners = {triangle.a, triangle.b, triangle.c};
    const Vec3& here = corners[corner % 3];
    const auto towards = [&](std::uint32_t steps) {
      return direction_and_length(corners[(corner + steps) % 3] - here).direction;
    };
    return angle_between(towards(1), towards(2));
  }

  const MeshTriangles& mesh_;
  std::vector<Vec3> normals_;
  std::vector<std::uint32_t> first_of_;  ///< the corners that are one with each, step by step
};

}  // namespace

CornerNormals smooth_normals(const MeshTriangles& mesh, std::span<const EdgePair> pairs,
                             double angle) {
  SmoothSurface surface(mesh);
  for (const EdgePair& pair : pairs) surface.join(pair, angle);
  return surface.normals();
}

void find_largest_angles(const MeshTriangles& mesh, CornerNormals& normals) {
  for (std::uint32_t facet = 0; facet < normals.of_facets.size(); ++facet) {
    const Vec3 plain = normal_of(mesh, facet);
    std::array<Vec3, 3> of_corners = {Vec3(0), Vec3(0), Vec3(0)};
    for (std::size_t i = 0; i < 3; ++i) {
      if (const auto* const value = normals.at(facet, i))
        of_corners[i] = {(*value)[0], (*value)[1], (*value)[2]};
    }
    const double side = glm::dot(of_corners[0] + of_corners[1] + of_corners[2], plain);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t index = normals.of_facets[facet][i];
      if (index == no_index || of_corners[i] == Vec3(0)) continue;
      const double cosine = glm::dot(of_corners[i], side < 0 ? -plain : plain);
      const double sine = cosine <= 0 ? 1 : glm::length(glm::cross(of_corners[i], plain));
      float& largest = normals.values[index][3];
      largest = std::max(largest, static_cast<float>(std::min(sine, 1.0)));
    }
  }
}

}  // namespace crt::core
