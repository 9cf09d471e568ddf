// Readers of mesh files put together here what they read.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh_files/polygon.hpp"
#include "crt/entity.hpp"
#include "crt/mesh_file.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// Components of normals, and u and v, are at most this in magnitude.
inline constexpr double largest_normal = 1e100;
inline constexpr double largest_uv = 1e30;

/// FaceCorners are the corners of a face as a file has them: numbers of what was added. There are
/// as many normals and (u, v) as positions, or none. Each of them may be no_index.
struct FaceCorners {
  std::span<const std::uint32_t> positions;
  std::span<const std::uint32_t> uv{};
  std::span<const std::uint32_t> normals{};
};

/// CornerIndices name something for the corners of triangles, once there is any.
class CornerIndices {
 public:
  /// Adds those of the corners a, b and c of a face for the triangle with this number.
  void add(std::size_t triangle, std::span<const std::uint32_t> of_face, std::uint32_t a,
           std::uint32_t b, std::uint32_t c);
  /// Keeps those of the triangle `from` for the triangle `to`, which is not behind it.
  void move(std::size_t from, std::size_t to);
  /// Returns one for each of so many triangles, or nothing if there is none.
  std::vector<TriangleIndices> take(std::size_t triangles);

 private:
  std::vector<TriangleIndices> indices_;
};

/// A MeshBuilder takes positions and faces of a file, and gives the mesh whose equal vertices are
/// one.
class MeshBuilder {
 public:
  /// Files that the mesh file names are opened by `open`, if it is there, and pictures by
  /// `open_picture`, or else by `open`, too.
  explicit MeshBuilder(OpenMeshPart open = {}, OpenMeshPicture open_picture = {})
      : open_(std::move(open)), open_picture_(std::move(open_picture)) {}

  /// Adds a position with checked coordinates. It has the number of positions before it. Throws
  /// RefusedMesh if there are too many.
  void add_position(const Vec3& position);
  std::size_t position_count() const { return positions_.size(); }

  /// Adds a normal with checked components. One of 0 says nothing.
  void add_normal(const Vec3& normal) { normals_.push_back(normal); }
  std::size_t normal_count() const { return normals_.size(); }
  /// Adds checked (u, v).
  void add_uv(double u, double v) { uv_.push_back({u, v}); }
  std::size_t uv_count() const { return uv_.size(); }

  /// Returns the content of a file that this one names. Throws Error if it cannot be had.
  std::vector<std::byte> open(const std::string& name) const;
  /// Returns a picture that this file names. Throws Error if it cannot be had, and if all pictures
  /// together are too large.
  std::shared_ptr<const Image> picture(const std::string& name);
  /// Says in one line what of the file had to be left out.
  void warn(const std::string& message);

  /// Gives the faces that follow the material of this number, or none for no_index.
  void set_material(std::uint32_t number) { material_ = number; }
  /// Sets the materials that the faces' numbers name.
  void set_materials(std::vector<SharedMaterial> materials) { materials_ = std::move(materials); }

  /// Adds a face with at least three corners. Neighbouring corners at one place count once. Throws
  /// RefusedMesh if finding its triangles takes too long.
  void add_face(const FaceCorners& face);
  void add_face(std::span<const std::uint32_t> positions) {
    add_face(FaceCorners{.positions = positions});
  }
  std::size_t triangle_count() const { return triangles_.size(); }

  /// Returns the mesh and leaves nothing here. Throws RefusedMesh if it has no triangle.
  MeshFile finish();

 private:
  std::vector<Vec3> positions_;
  std::vector<TriangleIndices> triangles_;
  std::uint64_t dropped_ = 0;
  std::vector<Vec3> normals_;
  std::vector<std::array<double, 2>> uv_;
  CornerIndices normals_of_;
  CornerIndices uv_of_;
  std::vector<SharedMaterial> materials_;
  std::vector<std::uint32_t> material_of_;  ///< empty until a face has any
  std::uint32_t material_ = no_index;
  std::vector<std::string> warnings_;
  OpenMeshPart open_;
  OpenMeshPicture open_picture_;
  std::optional<std::uint64_t> pixels_left_;  ///< of pictures; known once there is one

  void add_triangle(const FaceCorners& face, std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void drop_flat();
  MeshAttributes take_attributes();

  PolygonCutter cutter_;
  std::vector<std::uint32_t> corners_;  ///< of a polygon that are left, by their number in it
  std::vector<Vec3> places_;
};

}  // namespace crt::core
