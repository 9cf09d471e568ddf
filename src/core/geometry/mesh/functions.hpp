// The functions of a mesh's faces, for questions about boxes (face_functions.hpp): those of the
// triangles' planes.
#pragma once

#include <memory>

#include "core/geometry/mesh/near_facets.hpp"
#include "core/geometry/mesh/triangles.hpp"

namespace crt::core {

struct MeshFunctions {
  std::shared_ptr<const MeshTriangles> triangles;

  static constexpr int max_crossings(std::uint32_t) { return 1; }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    return value_of_facet(*triangles, triangles->size(), face, point);
  }
};

}  // namespace crt::core
