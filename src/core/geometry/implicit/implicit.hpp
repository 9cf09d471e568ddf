// An implicit solid is where a field f is at most 0, within a box.
//
// Where a line enters and leaves the box is what a Box says, at that one's bits. In between, where
// f changes its sign is enclosed in interval arithmetic (field_search.hpp). What is inside at an
// end of that part crosses the box there. What no proof separates from an end is at the end.
//
// Faces: 0 is f = 0. 1 and 2 are across x at the lower and the upper end, 3 and 4 across y, 5 and 6
// across z: those of a Box, each 1 more.
// Tests: tests/geometry/implicit_test.cpp
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "core/geometry/implicit/field_program.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

/// The first face of an implicit solid is the field's, and those of its box follow.
inline constexpr std::uint32_t first_box_face = 1;

class ImplicitShape final : public ShapeOfSinglePoints {
 public:
  explicit ImplicitShape(const Implicit& implicit);

  bool is_solid() const override { return true; }
  bool is_convex() const override { return false; }
  Bounds bounds() const override { return box_->bounds(); }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t) const override { return box_->anchor(0); }
  SurfacePoint point_on(const Vec3& offset, const Vec3& direction, std::uint32_t face,
                        bool with_uv) const override;
  void points_on(const VectorLanes& offsets, const VectorLanes& directions, std::uint32_t some,
                 std::uint32_t face, bool with_uv, SurfacePointLanes& points) const override;
  std::uint32_t face_count() const override { return first_box_face + box_->face_count(); }
  Surface surface(std::uint32_t face) const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  /// Returns only its own bytes and those of the program, which others may share.
  std::size_t bytes() const override { return sizeof *this + box_->bytes() + program_->bytes(); }

 private:
  struct Slope {
    double value = 0;
    Vec3 gradient{0, 0, 0};
  };
  /// Returns f and its gradient, which is 0 where there is none.
  Slope slope_at(const Vec3& place) const;

  std::unique_ptr<const Shape> box_;
  std::shared_ptr<const FieldProgram> program_;
  Surface surface_;  ///< of face 0
};

/// A FieldRay is a ray that meets a field, in either tier.
struct FieldRay {
  const ObjectRay& ray;
  bool is_exact = false;
  /// Each component of origin and direction has at most this error.
  double origin_error = 0;
  double direction_error = 0;
};

/// Returns the ray as the box of an implicit solid sees it. A start on the field means nothing
/// there.
ObjectRay as_box_sees(const ObjectRay& ray);

/// Puts the crossings of an implicit solid, as Shape::crossings() has them, in the place of those
/// of its box. They are in the list from `first` on, with the ray that the box sees.
bool replace_by_field_crossings(const FieldProgram& program, const FieldRay& field_ray,
                                std::size_t first, CrossingList& out);

void validate(const Implicit& implicit);
inline bool is_solid(const Implicit&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Implicit& implicit);
std::unique_ptr<const ExactShape> make_exact_shape(const Implicit& implicit);

}  // namespace crt::core
