// The triangles that a line meets become the crossings of a mesh, in both tiers.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry/mesh/passing_line.hpp"
#include "core/geometry/shape.hpp"
#include "core/geometry/triangle/triangle.hpp"

namespace crt {
class MeshTriangles;
}

namespace crt::core {

/// A MeshTier is what the tiers do differently.
class MeshTier {
 public:
  MeshTier() = default;
  MeshTier(const MeshTier&) = delete;
  MeshTier& operator=(const MeshTier&) = delete;
  virtual ~MeshTier() = default;

  /// Finds t and its error, where the line meets the plane of a triangle. Returns false if t is
  /// beyond all doubles.
  virtual bool meet(const Triangle& triangle, Crossing& crossing) const = 0;
  /// Gives a crossing its t, which is known to about 100 bits, and the error of that.
  virtual void place(const DoubleDouble& t, Crossing& crossing) const = 0;
  /// Returns the sign of the first t less the second, and 0 if they are equal.
  virtual int order(const Crossing& first, const Crossing& second) const = 0;
  /// Returns whether rounding may have put crossings into another order than the true one.
  virtual bool may_be_out_of_order() const = 0;
};

/// A StandardMeshTier meets planes in rounded arithmetic.
class StandardMeshTier final : public MeshTier {
 public:
  explicit StandardMeshTier(const ObjectRay& ray);

  bool meet(const Triangle& triangle, Crossing& crossing) const override;
  void place(const DoubleDouble& t, Crossing& crossing) const override;
  int order(const Crossing& first, const Crossing& second) const override;
  bool may_be_out_of_order() const override { return true; }

 private:
  ObjectRay ray_;  ///< without where it starts
};

/// Returns more than the distance of a crossing's t from where it is, with t_low and the rounding
/// of a sum with it.
inline double reach_of(const Crossing& crossing) {
  return crossing.error + 4 * rounding_of(crossing.t);
}
inline double lowest(const Crossing& crossing) {
  return crossing.t - reach_of(crossing);
}
inline double highest(const Crossing& crossing) {
  return crossing.t + reach_of(crossing);
}

/// Returns whether no other of some crossings can be where this one is, whatever their errors.
bool is_alone(const Crossing& crossing, std::span<const Crossing> all);

/// Returns by how much a winding number grows along some crossings of triangles, which a line
/// enters against their normals.
int turns_of(std::span<const Crossing> crossings);

/// Appends the crossings of a line with a mesh, as Shape::crossings does.
bool append_crossings(const MeshTriangles& mesh, PassingLine& line, const MeshTier& tier,
                      CrossingList& out);

/// Appends the crossings of a ray with a mesh in the standard tier.
bool standard_crossings(const MeshTriangles& mesh, const ObjectRay& ray, CrossingList& out);

/// Appends a crossing for each triangle that a ray's line crosses, in the standard tier: in order,
/// and entering where it is against the normal.
void all_met_triangles(const MeshTriangles& mesh, const ObjectRay& ray, CrossingList& out);

}  // namespace crt::core
