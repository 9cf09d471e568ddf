// What facets of a mesh may have beyond their corners: normals for shading, (u, v) and materials.
// Nothing here changes what a ray meets.
// Tests: tests/geometry/facet_attributes_test.cpp
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/mesh/facing.hpp"
#include "core/geometry/shape.hpp"
#include "crt/mesh.hpp"

namespace crt::core {

/// CornerValues are numbers at the corners of facets, which share them.
template <std::size_t size>
struct CornerValues {
  using Value = std::array<float, size>;

  std::vector<Value> values;
  std::vector<TriangleIndices> of_facets;  ///< or no_index; empty if there are no values

  bool empty() const { return of_facets.empty(); }
  /// Returns the value at a corner of a facet, or null if it has none.
  const Value* at(std::uint32_t facet, std::size_t corner) const {
    const std::uint32_t index = of_facets[facet][corner];
    return index == no_index ? nullptr : &values[index];
  }
  std::size_t bytes() const {
    return values.capacity() * sizeof(Value) + of_facets.capacity() * sizeof(TriangleIndices);
  }
};

/// CornerNormals are unit normals, or 0, and behind each the sine of the largest angle between it
/// and the normal of a facet that has it.
using CornerNormals = CornerValues<4>;

/// GivenFacets say which of the triangles that a mesh was made of became its facets.
struct GivenFacets {
  std::span<const TriangleIndices> triangles;  ///< as they were given
  std::span<const std::uint32_t> numbers;      ///< of each facet among these
  bool turned = false;                         ///< the second and third corner changed places
};

/// Throws Error (invalid_argument) for attributes that do not fit so many positions and triangles.
void check_attributes(const MeshAttributes& attributes, std::size_t positions,
                      std::size_t triangles);

class FacetAttributes {
 public:
  /// Takes checked attributes. `pairs` are the facets that alone share an edge.
  FacetAttributes(const MeshAttributes& attributes, const GivenFacets& given,
                  const MeshTriangles& mesh, std::span<const EdgePair> pairs);

  /// Returns whether facets have nothing beyond their corners.
  bool empty() const { return !has_normals() && !has_uv() && !has_materials(); }
  bool has_normals() const { return !normals_.empty(); }
  bool has_uv() const { return !uv_.empty(); }
  bool has_materials() const { return !materials_.empty(); }

  /// Returns the normal for shading where the second and the third corner have such weights. The
  /// corners' normals together are on the side of `facet_normal`.
  ShadingNormal normal(std::uint32_t facet, double u, double v, const Vec3& facet_normal) const;

  /// Puts the (u, v) of a point in the place of the weights of a facet's second and third corner.
  template <class Real>
  void weights_to_uv(std::uint32_t facet, Real& u, Real& v) const;

  const CornerNormals& normals() const { return normals_; }
  const CornerValues<2>& uv() const { return uv_; }

  /// Returns the materials, of which there are none if has_materials() is false.
  std::span<const SharedMaterial> materials() const { return materials_; }
  /// Returns the number of a facet's material, from 1 on, or 0 for the default one.
  std::uint32_t material(std::uint32_t facet) const {
    return materials_of_.empty() ? 1 : materials_of_[facet];
  }

  std::size_t bytes() const;

 private:
  CornerNormals normals_;
  CornerValues<2> uv_;
  std::vector<SharedMaterial> materials_;
  std::vector<std::uint32_t> materials_of_;  ///< facets; empty if all have the first
};

template <class Real>
void FacetAttributes::weights_to_uv(std::uint32_t facet, Real& u, Real& v) const {
  const auto* const a = uv_.at(facet, 0);
  const auto* const b = uv_.at(facet, 1);
  const auto* const c = uv_.at(facet, 2);
  if (a == nullptr || b == nullptr || c == nullptr) return;
  const Real first = 1 - u - v;
  const auto weighted = [&](std::size_t i) -> Real {
    return first * double{(*a)[i]} + u * double{(*b)[i]} + v * double{(*c)[i]};
  };
  const Real new_u = weighted(0);
  v = weighted(1);
  u = new_u;
}

/// Computes normals at the corners of facets: the mean of those facets' normals that meet there and
/// are one round surface, each weighted by its angle there. Facets are one surface across an edge
/// that they alone share if their normals are at most `angle` apart.
///
/// Source: Thuermer and Wuethrich, Computing vertex normals from polygonal facets, 1998.
CornerNormals smooth_normals(const MeshTriangles& mesh, std::span<const EdgePair> pairs,
                             double angle);

/// Finds the angles between normals and those of facets.
void find_largest_angles(const MeshTriangles& mesh, CornerNormals& normals);

}  // namespace crt::core
