// These solids have flat faces between corners. They are meshes.
#pragma once

#include <crt/entity.hpp>
#include <crt/material.hpp>
#include <crt/vec.hpp>
#include <cstdint>
#include <optional>
#include <vector>

namespace crt {

/// A face of a Polyhedron has at most so many corners, and a Hull at most so many points.
inline constexpr std::size_t most_corners_of_face = 1024;
inline constexpr std::size_t most_hull_points = 1024;  ///< see most_corners_of_face

/// A Polyhedron is the solid that flat faces enclose. A face may have any number of corners, and
/// need not be convex. It becomes triangles between its corners, which are flat if these are in one
/// plane. It is an Entity wherever one is needed.
struct Polyhedron {
  std::vector<Vec3> points{};
  /// Each names the corners of a face by their places in `points`, from 0, in order around it,
  /// whichever way. It does not cross or touch itself. Each edge belongs to two faces, or to an
  /// even number of them.
  std::vector<std::vector<std::uint32_t>> faces{};
  std::optional<SharedMaterial> material{};

  /// Makes the entity. It takes O(n log n) for n corners, and O(n^2) for those of one face. Throws
  /// Error (invalid_argument) naming the face, or the edge, that is wrong, and as mesh_triangles()
  /// does; and Error (limit) for a face with more than most_corners_of_face.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

/// A Hull is the smallest convex solid that holds points. Its corners are exactly some of these,
/// and no point is outside of the plane of a face, whatever rounding does. It is an Entity wherever
/// one is needed.
struct Hull {
  std::vector<Vec3> points{};  ///< at least four that are not in one plane
  std::optional<SharedMaterial> material{};

  /// Makes the entity. It takes O(n^2) for n points. Throws Error (invalid_argument) if the points
  /// are all in one plane, or for one that is not finite or above 1e100, and Error (limit) for more
  /// than most_hull_points.
  operator Entity() const;  // NOLINT(google-explicit-constructor): it is one
};

}  // namespace crt
