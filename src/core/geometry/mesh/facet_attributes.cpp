#include "core/geometry/mesh/facet_attributes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/geometry/mesh/triangles.hpp"
#include "core/math/direction_and_length.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

[[noreturn]] void reject_attribute(const char* field, const std::string& rule) {
  const bool is_of_item = rule.starts_with('[');
  throw Error(ErrorCode::invalid_argument, field + (is_of_item ? rule : ' ' + rule), field);
}

/// Checks indices that name one of `count` values for each corner of each triangle.
void check_corner_indices(const char* field, const char* values,
                          std::span<const TriangleIndices> indices, std::size_t count,
                          std::size_t positions, std::size_t triangles) {
  if (indices.empty()) {
    if (count == 0 || count == positions) return;
    reject_attribute(values, text::format("has {} items; without {} it must have one for each of "
                                          "the {} positions",
                                          count, field, positions));
  }
  if (indices.size() != triangles) {
    reject_attribute(field, text::format("has {} items; it must have one for each of the {} "
                                         "triangles",
                                         indices.size(), triangles));
  }
  for (std::size_t i = 0; i < indices.size(); ++i) {
    for (const std::uint32_t index : indices[i]) {
      if (index < count || index == no_index) continue;
      reject_attribute(field, text::format("[{}] has the index {}, but there are {} {}", i, index,
                                           count, values));
    }
  }
}

void check_materials(const MeshAttributes& attributes, std::size_t triangles) {
  const std::vector<std::uint32_t>& numbers = attributes.material_of_triangle;
  if (numbers.empty()) return;
  if (numbers.size() != triangles) {
    reject_attribute("material_of_triangle",
                     text::format("has {} items; it must have one for each of the {} triangles",
                                  numbers.size(), triangles));
  }
  const std::size_t count = attributes.materials.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < count || numbers[i] == no_index) continue;
    reject_attribute("material_of_triangle",
                     text::format("[{}] is {}, but there are {} materials", i, numbers[i], count));
  }
}

/// Makes the indices of facets of those of the triangles that they were given as.
std::vector<TriangleIndices> indices_of_facets(std::span<const TriangleIndices> indices,
                                               const GivenFacets& given) {
  const std::span<const TriangleIndices> all = indices.empty() ? given.triangles : indices;
  std::vector<TriangleIndices> result;
  result.reserve(given.numbers.size());
  for (const std::uint32_t number : given.numbers) {
    result.push_back(all[number]);
    if (given.turned) std::swap(result.back()[1], result.back()[2]);
  }
  return result;
}

CornerNormals given_normals(const MeshAttributes& attributes, const GivenFacets& given) {
  CornerNormals result;
  if (attributes.normals.empty()) return result;
  result.values.reserve(attributes.normals.size());
  for (const Vec3& normal : attributes.normals) {
    const Vec3 unit = direction_and_length(normal).direction;
    result.values.push_back(
        {static_cast<float>(unit.x), static_cast<float>(unit.y), static_cast<float>(unit.z), 0});
  }
  result.of_facets = indices_of_facets(attributes.normal_indices, given);
  return result;
}

CornerValues<2> given_uv(const MeshAttributes& attributes, const GivenFacets& given) {
  CornerValues<2> result;
  if (attributes.uv.empty()) return result;
  result.values.reserve(attributes.uv.size());
  for (const auto& [u, v] : attributes.uv)
    result.values.push_back({static_cast<float>(u), static_cast<float>(v)});
  result.of_facets = indices_of_facets(attributes.uv_indices, given);
  return result;
}

}  // namespace

void check_attributes(const MeshAttributes& attributes, std::size_t positions,
                      std::size_t triangles) {
  for (std::size_t i = 0; i < attributes.normals.size(); ++i) {
    const Vec3& normal = attributes.normals[i];
    if (std::isfinite(normal.x) && std::isfinite(normal.y) && std::isfinite(normal.z)) continue;
    reject_attribute("normals", text::format("[{}] is not finite", i));
  }
  constexpr double largest_uv = 1e30;
  for (std::size_t i = 0; i < attributes.uv.size(); ++i) {
    const auto& [u, v] = attributes.uv[i];
    if (std::abs(u) <= largest_uv && std::abs(v) <= largest_uv) continue;
    reject_attribute("uv", text::format("[{}] is not finite or above 1e30 in magnitude", i));
  }
  check_corner_indices("normal_indices", "normals", attributes.normal_indices,
                       attributes.normals.size(), positions, triangles);
  check_corner_indices("uv_indices", "uv", attributes.uv_indices, attributes.uv.size(), positions,
                       triangles);
  check_materials(attributes, triangles);
  if (attributes.smooth && !(*attributes.smooth >= 0 && *attributes.smooth <= std::numbers::pi))
    reject_attribute("smooth", "must be an angle in [0, pi]");
}

FacetAttributes::FacetAttributes(const MeshAttributes& attributes, const GivenFacets& given,
                                 const MeshTriangles& mesh, std::span<const EdgePair> pairs)
    : uv_(given_uv(attributes, given)), materials_(attributes.materials) {
  if (!attributes.smooth) {
    normals_ = given_normals(attributes, given);
  } else if (*attributes.smooth > 0) {
    normals_ = smooth_normals(mesh, pairs, *attributes.smooth);
  }
  find_largest_angles(mesh, normals_);
  if (materials_.empty() || attributes.material_of_triangle.empty()) return;
  materials_of_.reserve(given.numbers.size());
  for (const std::uint32_t number : given.numbers) {
    const std::uint32_t material = attributes.material_of_triangle[number];
    materials_of_.push_back(material == no_index ? 0 : material + 1);
  }
}

ShadingNormal FacetAttributes::normal(std::uint32_t facet, double u, double v,
                                      const Vec3& facet_normal) const {
  const std::array<double, 3> weights = {1 - u - v, u, v};
  std::array<Vec3, 3> normals;
  double horizon = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const auto* const value = normals_.at(facet, i);
    normals[i] = value == nullptr ? Vec3(0) : Vec3((*value)[0], (*value)[1], (*value)[2]);
    if (value != nullptr) horizon += weights[i] * double{(*value)[3]};
  }
  const double side = glm::dot(normals[0] + normals[1] + normals[2], facet_normal);
  const double sign = side < 0 ? -1 : 1;
  Vec3 sum(0);
  for (std::size_t i = 0; i < normals.size(); ++i)
    sum += weights[i] * (normals[i] == Vec3(0) ? facet_normal : sign * normals[i]);
  const auto [direction, length] = direction_and_length(sum);
  if (direction == Vec3(0)) return {facet_normal};
  return {direction, std::min(1.0, horizon / length)};
}

std::size_t FacetAttributes::bytes() const {
  return sizeof *this + normals_.bytes() + uv_.bytes() +
         materials_.capacity() * sizeof(SharedMaterial) +
         materials_of_.capacity() * sizeof(std::uint32_t);
}

}  // namespace crt::core
