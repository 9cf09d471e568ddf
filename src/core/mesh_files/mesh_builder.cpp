#include "core/mesh_files/mesh_builder.hpp"

#include <limits>
#include <utility>

#include "core/geometry/mesh/equal_positions.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "crt/error.hpp"
#include "crt/image_limits.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Leaves the first of equal positions. Returns the new numbers of all.
std::vector<std::uint32_t> weld(std::vector<Vec3>& positions) {
  std::vector<std::uint32_t> first = first_equal(positions);
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    if (first[i] != i) {
      first[i] = first[first[i]];  // an earlier one, which has its new number
      continue;
    }
    positions[count] = positions[i];
    first[i] = count++;
  }
  positions.resize(count);
  return first;
}

}  // namespace

void MeshBuilder::add_position(const Vec3& position) {
  if (positions_.size() == std::numeric_limits<std::uint32_t>::max())
    throw RefusedMesh("it has more than 4294967295 vertices");
  // Adding 0 makes 0 of -0.
  positions_.emplace_back(position.x + 0.0, position.y + 0.0, position.z + 0.0);
}

std::vector<std::byte> MeshBuilder::open(const std::string& name) const {
  if (open_) return open_(name);
  throw Error(ErrorCode::io, text::format("there is no file '{}'", name));
}

std::shared_ptr<const Image> MeshBuilder::picture(const std::string& name) {
  if (open_picture_) return open_picture_(name);
  if (!pixels_left_) pixels_left_ = affordable_image_pixels();
  if (*pixels_left_ == 0)
    throw Error(ErrorCode::limit, text::format("there is no memory for the picture '{}'", name));
  auto picture = std::make_shared<const Image>(decode_image(open(name), name, *pixels_left_));
  *pixels_left_ -= picture->pixels().size() / 4;
  return picture;
}

void MeshBuilder::warn(const std::string& message) {
  constexpr std::size_t max_warnings = 20;
  if (warnings_.size() < max_warnings) warnings_.push_back(message);
}

void CornerIndices::add(std::size_t triangle, std::span<const std::uint32_t> of_face,
                        std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  if (of_face.empty()) return;
  indices_.resize(triangle, {no_index, no_index, no_index});
  indices_.push_back({of_face[a], of_face[b], of_face[c]});
}

void CornerIndices::move(std::size_t from, std::size_t to) {
  if (to >= indices_.size()) return;
  indices_[to] =
      from < indices_.size() ? indices_[from] : TriangleIndices{no_index, no_index, no_index};
}

std::vector<TriangleIndices> CornerIndices::take(std::size_t triangles) {
  if (!indices_.empty()) indices_.resize(triangles, {no_index, no_index, no_index});
  return std::exchange(indices_, {});
}

void MeshBuilder::add_triangle(const FaceCorners& face, std::uint32_t a, std::uint32_t b,
                               std::uint32_t c) {
  normals_of_.add(triangles_.size(), face.normals, a, b, c);
  uv_of_.add(triangles_.size(), face.uv, a, b, c);
  if (material_ != no_index) {
    material_of_.resize(triangles_.size(), no_index);
    material_of_.push_back(material_);
  }
  triangles_.push_back({face.positions[a], face.positions[b], face.positions[c]});
}

void MeshBuilder::add_face(const FaceCorners& face) {
  if (face.positions.size() == 3) {
    add_triangle(face, 0, 1, 2);
    return;
  }
  corners_.clear();
  places_.clear();
  for (std::uint32_t i = 0; i < face.positions.size(); ++i) {
    const Vec3& place = positions_[face.positions[i]];
    if (!places_.empty() && places_.back() == place) continue;
    corners_.push_back(i);
    places_.push_back(place);
  }
  while (places_.size() > 1 && places_.front() == places_.back()) {
    places_.pop_back();
    corners_.pop_back();
  }
  if (places_.size() < 3) {
    ++dropped_;
    return;
  }
  for (const auto& [a, b, c] : cutter_.cut(places_))
    add_triangle(face, corners_[a], corners_[b], corners_[c]);
  if (cutter_.steps() > PolygonCutter::most_steps) {
    throw RefusedMesh(
        "cutting its faces into triangles takes too long: they have many corners and are not "
        "convex");
  }
}

/// Leaves out triangles with equal corners.
void MeshBuilder::drop_flat() {
  if (!material_of_.empty()) material_of_.resize(triangles_.size(), no_index);
  std::size_t left = 0;
  for (std::size_t i = 0; i < triangles_.size(); ++i) {
    const auto [a, b, c] = triangles_[i];
    if (a == b || b == c || c == a) continue;
    triangles_[left] = triangles_[i];
    normals_of_.move(i, left);
    uv_of_.move(i, left);
    if (!material_of_.empty()) material_of_[left] = material_of_[i];
    ++left;
  }
  dropped_ += triangles_.size() - left;
  triangles_.resize(left);
}

MeshAttributes MeshBuilder::take_attributes() {
  MeshAttributes attributes;
  attributes.normal_indices = normals_of_.take(triangles_.size());
  if (!attributes.normal_indices.empty()) attributes.normals = std::exchange(normals_, {});
  attributes.uv_indices = uv_of_.take(triangles_.size());
  if (!attributes.uv_indices.empty()) attributes.uv = std::exchange(uv_, {});
  if (material_of_.empty() || materials_.empty()) return attributes;
  material_of_.resize(triangles_.size());
  attributes.materials = std::exchange(materials_, {});
  attributes.material_of_triangle = std::exchange(material_of_, {});
  return attributes;
}

MeshFile MeshBuilder::finish() {
  const std::vector<std::uint32_t> vertex_of = weld(positions_);
  for (TriangleIndices& triangle : triangles_) {
    for (std::uint32_t& corner : triangle) corner = vertex_of[corner];
  }
  drop_flat();
  if (triangles_.empty()) {
    throw RefusedMesh(dropped_ > 0 ? "each of its faces has equal corners" : "it has no faces");
  }
  MeshAttributes attributes = take_attributes();
  return {.positions = std::exchange(positions_, {}),
          .triangles = std::exchange(triangles_, {}),
          .dropped_triangles = std::exchange(dropped_, 0),
          .attributes = std::move(attributes),
          .warnings = std::exchange(warnings_, {})};
}

}  // namespace crt::core
