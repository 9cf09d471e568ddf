// Solids that triangles enclose ask which of their planes cut a box, for questions about boxes
// (face_functions.hpp).
#pragma once

#include <array>
#include <optional>

#include "core/geometry/cut_box.hpp"
#include "core/geometry/mesh/facing.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

/// Returns the function of a triangle's plane, above 0 where its normal points. The normal is exact
/// for a plane across an axis, and else of about the length of two sides' product.
HalfSpaceFunction plane_function(const Triangle& triangle);

/// Returns the sign of a plane's function in a box, or 0 if it may have both or is 0.
int side_of(const HalfSpaceFunction& plane, const PointOf<Interval>& box);

/// Says whether a triangle cuts a box: surely not, as what only touches one that is no point, or
/// perhaps, or surely with all that its plane has in the box.
enum class CutByTriangle : std::uint8_t { none, some, all };
CutByTriangle cut_by(const Triangle& triangle, const HalfSpaceFunction& plane,
                     const PointOf<Interval>& box);

Cut cut_by(const HalfSpaceFunction& plane, const Vec3& middle);

/// Lines in this direction are rarely level with edges of a mesh, which takes exact arithmetic.
inline const Vec3 some_direction(0.9371823451, 0.2917652873, 0.1914437692);

/// Returns whether a point is inside, if no error of the crossings of a line through it leaves that
/// open. crossings(ray, list) is as Shape::crossings().
template <class Crossings>
std::optional<bool> is_inside_by_line(const Vec3& point, const Crossings& crossings) {
  const ObjectRay ray{.origin = point, .direction = some_direction};
  CrossingList list;
  bool inside = crossings(ray, list);
  for (const Crossing& crossing : list) {
    if (std::abs(crossing.t) <= crossing.error) return std::nullopt;
    if (crossing.t < 0) inside = crossing.entering;
  }
  return inside;
}

/// NearFacets are the triangles that cut a box. Facets are as HeightFacets or MeshTriangles. The
/// function of a face from their number on is that of the face less that number, turned round.
template <class Facets>
class NearFacets {
 public:
  NearFacets(const Facets& facets, std::uint32_t face_count, const PointOf<Interval>& box)
      : facets_(facets), face_count_(face_count), box_(box) {}

  /// Adds a face if it cuts the box. `facing` is on which side the solid is, if no other triangle
  /// is in the same place. Returns false if there are too many planes.
  bool add(std::uint32_t face, const Triangle& triangle, Facing facing) {
    const HalfSpaceFunction plane = plane_function(triangle);
    const CutByTriangle of_triangle = cut_by(triangle, plane, box_.box());
    if (of_triangle == CutByTriangle::none) return true;
    if (of_triangle == CutByTriangle::all) {
      if (facing == Facing::outwards) known_face_ = face;
      if (facing == Facing::inwards) known_face_ = face + face_count_;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      if (!facets_.are_in_one_plane(faces_[i], face)) continue;
      if (i < cuts_.size() && facets_.are_opposite(faces_[i], face)) cuts_[i].flipped = face;
      return true;
    }
    if (count_ == faces_.size()) return false;
    if (count_ < cuts_.size()) {
      Cut& cut = cuts_[count_];
      cut = cut_by(plane, box_.middle());
      cut.face = face;
      cut.flipped = face + face_count_;
    }
    faces_[count_++] = face;
    return true;
  }

  template <class Crossings>
  void look(const Crossings& crossings, NearFaces& near) {
    if (count_ == 1 && known_face_ != invalid_index)
      return near.say(NearFaces::Kind::where_all_negative, {known_face_});
    near.say(NearFaces::Kind::unknown);
    if (count_ <= cuts_.size()) {
      for (std::size_t i = 0; i < count_; ++i) box_.add(cuts_[i]);
      box_.look([&](const Vec3& point) { return is_inside_by_line(point, crossings); }, near);
    }
    if (near.kind == NearFaces::Kind::unknown)
      near.faces.assign(faces_.begin(), faces_.begin() + static_cast<std::ptrdiff_t>(count_));
  }

 private:
  const Facets& facets_;
  std::uint32_t face_count_;
  CutBox box_;
  std::array<Cut, CutBox::most_cuts> cuts_;
  std::array<std::uint32_t, 16> faces_{};  ///< one for each plane that cuts the box
  std::size_t count_ = 0;
  std::uint32_t known_face_ = invalid_index;  ///< has the solid just where its function is below 0
};

/// Returns the value of a face's function, whose number is as NearFacets has it.
template <class Facets, class Number>
Number value_of_facet(const Facets& facets, std::uint32_t face_count, std::uint32_t face,
                      const PointOf<Number>& point) {
  if (face >= face_count) return -value_of_facet(facets, face_count, face - face_count, point);
  return plane_function(facets.triangle(face)).value(point);
}

}  // namespace crt::core
