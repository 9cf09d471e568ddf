// A box has all points between two corners, coordinate by coordinate. Its six flat faces cut the
// line. A line within a face's plane is outside, as a face has no thickness.
//
// Faces: 0 and 1 are across x at the lower and the upper end, 2 and 3 across y, 4 and 5 across z.
// (u, v) go from 0 to 1 across a face along the growing coordinates: (z, y) on the faces across x,
// (x, z) across y, (x, y) across z.
// Source: Kay, Kajiya, Ray tracing complex scenes, 1986 (slabs).
// Tests: tests/geometry/box_test.cpp
#pragma once

#include <array>

#include "core/geometry/box/enclose.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/geometry/shape.hpp"

namespace crt::core {

class BoxShape final : public ShapeOfPoints<BoxShape> {
 public:
  explicit BoxShape(const Box& box);

  bool is_solid() const override { return true; }
  std::unique_ptr<const PlacedSolid> placed(const Placement& placement) const override;
  bool finds_spans(const Placement& placement) const override { return placement.is_identity(); }
  bool has_quick_spans() const override { return true; }
  void span(const FilterLine<double>& line, const WantedEnds<double>& wanted,
            const FaceStarts<double>* starts, ShapeSpan<double>& span) const override {
    write_span(line, wanted, starts, span);
  }
  void span(const FilterLine<Lanes>& lines, const WantedEnds<Lanes>& wanted,
            const FaceStarts<Lanes>* starts, ShapeSpan<Lanes>& span) const override {
    write_span(lines, wanted, starts, span);
  }
  std::optional<CoreSegment> core_segment() const final;
  Bounds bounds() const override { return {lower_, upper_}; }
  bool crossings(const ObjectRay& ray, CrossingList& out) const override;
  Vec3 anchor(std::uint32_t) const override { return lower_; }
  template <class Real>
  void write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>& direction, std::uint32_t face,
                   bool with_uv, SurfacePointOf<Real>& point) const;
  std::uint32_t face_count() const override { return 6; }
  Surface surface(std::uint32_t face) const override { return faces_[face].surface(); }
  SurfacePieces pieces() const override;
  std::unique_ptr<const FaceFunctions> face_functions() const override;
  std::size_t bytes() const override { return sizeof *this; }

 private:
  static constexpr unsigned all_faces = 0x3f;
  /// Returns the faces, a bit each, through which a ray in free space may enter or leave the box,
  /// as far as plain doubles can decide. There is none if it surely misses.
  unsigned possible_ends(const ObjectRay& ray) const;
  template <class Real>
  void write_span(const FilterLine<Real>& line, const WantedEnds<Real>& wanted,
                  const FaceStarts<Real>* starts, ShapeSpan<Real>& span) const;

  Vec3 lower_;
  Vec3 upper_;
  std::array<PlaneFace, 6> faces_;
};

inline bool is_solid(const Box&) {
  return true;
}
std::unique_ptr<const Shape> make_shape(const Box& box);
std::unique_ptr<const ExactShape> make_exact_shape(const Box& box);

}  // namespace crt::core
