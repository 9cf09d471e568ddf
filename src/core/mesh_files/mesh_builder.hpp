// Readers of mesh files put together here what they read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh_files/polygon.hpp"
#include "crt/entity.hpp"
#include "crt/mesh_file.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A MeshBuilder takes positions and faces of a file, and gives the mesh whose equal vertices are
/// one.
class MeshBuilder {
 public:
  /// Adds a position with checked coordinates. It has the number of positions before it. Throws
  /// RefusedMesh if there are too many.
  void add_position(const Vec3& position);
  std::size_t position_count() const { return positions_.size(); }

  /// Adds a face whose corners are numbers of positions that were added. There are at least three.
  /// Neighbouring corners at one place count once. Throws RefusedMesh if finding its triangles
  /// takes too long.
  void add_face(std::span<const std::uint32_t> corners);
  std::size_t triangle_count() const { return triangles_.size(); }

  /// Returns the mesh and leaves nothing here. Throws RefusedMesh if it has no triangle.
  MeshFile finish();

 private:
  std::vector<Vec3> positions_;
  std::vector<TriangleIndices> triangles_;
  std::uint64_t dropped_ = 0;

  PolygonCutter cutter_;
  std::vector<std::uint32_t> corners_;
  std::vector<Vec3> places_;
};

}  // namespace crt::core
