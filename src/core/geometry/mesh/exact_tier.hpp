// The exact tier finds where a line meets the planes of triangles without rounding.
#pragma once

#include "core/geometry/exact_plane.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/geometry/mesh/met_triangles.hpp"

namespace crt::core {

inline ExactPlane plane_through(const Triangle& triangle) {
  return ExactPlane::through(triangle.a, triangle.b, triangle.c);
}

/// An ExactMeshTier is for what find_met_triangles.hpp calls triangles.
template <class Triangles>
class ExactMeshTier final : public MeshTier {
 public:
  ExactMeshTier(const Triangles& mesh, const ExactRay& ray) : mesh_(mesh), ray_(ray) {}

  bool meet(const Triangle& triangle, Crossing& crossing) const override {
    const ExactPlane::Meeting meeting = plane_through(triangle).meet(ray_);
    crossing.t = meeting.t.hi;
    crossing.t_low = meeting.t.lo;
    crossing.error = meeting.error;
    return meeting.found();
  }

  void place(const DoubleDouble& t, Crossing& crossing) const override {
    crossing = exact_crossing(t, crossing);
  }

  int order(const Crossing& first, const Crossing& second) const override {
    if (mesh_.are_in_one_plane(first.face, second.face)) return 0;
    const ExactPlane first_plane = plane_through(mesh_.corners_of_plane(first.face));
    const ExactPlane second_plane = plane_through(mesh_.corners_of_plane(second.face));
    return core::order(ray_, first_plane, first_plane.meet(ray_), second_plane,
                       second_plane.meet(ray_));
  }

  bool may_be_out_of_order() const override { return false; }

 private:
  const Triangles& mesh_;
  const ExactRay& ray_;
};

}  // namespace crt::core
