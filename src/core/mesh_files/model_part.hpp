// A model part of a 3MF file: 3MF Consortium, Core Specification 1.3.0, and the paths of the
// Production Extension 1.1.2.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/mesh_files/zip_archive.hpp"
#include "crt/entity.hpp"
#include "crt/vec.hpp"

namespace crt::core {

/// A ModelTransform moves what is placed: rows of the matrix that a row (x, y, z, 1) is multiplied
/// by.
struct ModelTransform {
  std::array<Vec3, 4> rows{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 0}};

  Vec3 operator()(const Vec3& position) const;
  /// Returns whether it makes of a left hand a right one.
  bool mirrors() const;
};

/// A PlacedObject is an object of a part with its place.
struct PlacedObject {
  std::string path;  ///< of another part; empty for the same
  std::int64_t id = 0;
  std::optional<ModelTransform> transform;
};

/// A ModelObject is a mesh or is made of other objects.
struct ModelObject {
  std::vector<Vec3> positions;
  std::vector<TriangleIndices> triangles;
  std::vector<PlacedObject> components;
};

struct ModelPart {
  std::map<std::int64_t, ModelObject> objects;
  std::vector<PlacedObject> build;
};

/// Reads a part of the archive. Throws RefusedMesh.
ModelPart read_model_part(ZipArchive& archive, const ZipEntry& entry);

}  // namespace crt::core
