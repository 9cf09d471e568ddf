// The functions of a height field's faces, for questions about boxes (face_functions.hpp): those of
// the planes of its facets.
#pragma once

#include <memory>

#include "core/geometry/height_field/facets.hpp"
#include "core/geometry/mesh/near_facets.hpp"

namespace crt::core {

struct HeightFieldFunctions {
  std::shared_ptr<const HeightFacets> facets;

  static constexpr int max_crossings(std::uint32_t) { return 1; }
  void look(const PointOf<Interval>& box, NearFaces& near) const;
  template <class Number>
  Number value(std::uint32_t face, const PointOf<Number>& point) const {
    return value_of_facet(*facets, facets->face_count(), face, point);
  }

 private:
  void look_at_surface(const PointOf<Interval>& box, NearFaces& near) const;
};

}  // namespace crt::core
