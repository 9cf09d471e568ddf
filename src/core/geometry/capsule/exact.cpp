// The capsule of the exact tier puts together the spans that the exact cylinder and spheres have in
// common with a line. No span is rounded, so it is certain which of the parts is met first. Where
// the line comes into the cylinder through its side, that is the capsule's entry. Where it comes
// through a cap it is within the cap's rim, and so within the sphere about the cap's middle, which
// it has met before. The same goes for exits.
// Tests: tests/geometry/exact_capsule_test.cpp
#include <limits>

#include "core/geometry/capsule/capsule.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

constexpr std::uint32_t side_face = CapsuleShape::side_face;

class ExactCapsuleShape final : public ExactShape {
 public:
  explicit ExactCapsuleShape(const Capsule& capsule)
      : parts_{make_exact_shape(
                   Cylinder{.from = capsule.from, .to = capsule.to, .radius = capsule.radius}),
               make_exact_shape(Sphere{.center = capsule.from, .radius = capsule.radius}),
               make_exact_shape(Sphere{.center = capsule.to, .radius = capsule.radius})},
        radius_(capsule.radius) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    if (ray.near.start.face != invalid_index) return crossings_from_surface(ray, out);
    CapsuleSpan whole = span(ray, out);
    if (!whole.found) return false;
    if (ray.near.is_first_wanted(whole.enter)) {
      out.push_back(whole.enter);
      return false;
    }
    if (whole.leave.face == invalid_index) {
      // A part left out where it ends, as it begins so late, but the capsule begins before it.
      ObjectRay near = ray.near;
      near.first_wanted_after = std::numeric_limits<double>::infinity();
      whole.leave = span(ray.seen_as(near), out).leave;
    }
    append(whole, out);
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    ObjectRay near = ray.near;
    near.start = start_on_part(near.start, crossing.face);
    Crossing of_part = crossing;
    of_part.face = 0;
    return parts_[crossing.face]->place(ray.seen_as(near), of_part);
  }

  ExactSurface surface(std::uint32_t face) const override { return parts_[face]->surface(0); }

  std::size_t bytes() const override {
    std::size_t bytes = sizeof *this;
    for (const auto& part : parts_) bytes += part->bytes();
    return bytes;
  }

 private:
  CapsuleSpan span_of(std::uint32_t part, const ExactRay& ray, CrossingList& out) const {
    const std::size_t size = out.size();
    parts_[part]->crossings(ray, out);
    return take_span(out, size, part);
  }

  /// Returns the span of a line that starts on none of the surfaces. `out` has room for what the
  /// parts append, and is left as it was.
  CapsuleSpan span(const ExactRay& ray, CrossingList& out) const {
    CapsuleSpan whole = span_of(side_face, ray, out);
    if (!whole.found) return outer(ray, span_of(1, ray, out), span_of(2, ray, out));
    const auto move_behind_cap = [&](Crossing CapsuleSpan::*end) {
      const std::uint32_t cap = (whole.*end).face;
      if (cap == side_face || cap == invalid_index) return;
      const CapsuleSpan half = span_of(cap, ray, out);
      if (half.found) whole.*end = half.*end;
    };
    move_behind_cap(&CapsuleSpan::enter);
    move_behind_cap(&CapsuleSpan::leave);
    return whole;
  }

  /// Returns the larger of two spans of a line that is nowhere in the cylinder. It is so on one
  /// side of both seams, where one of the spheres has all that the other has.
  CapsuleSpan outer(const ExactRay& ray, const CapsuleSpan& a, const CapsuleSpan& b) const {
    if (!a.found || !b.found) return a.found ? a : b;
    if (std::abs(a.enter.t - b.enter.t) > a.enter.error + b.enter.error) {
      return a.enter.t < b.enter.t ? a : b;
    }
    std::optional<RealRoot> enter_a = place(ray, a.enter);
    std::optional<RealRoot> enter_b = place(ray, b.enter);
    return enter_a && enter_b && order(*enter_a, *enter_b) > 0 ? b : a;
  }

  /// Finds the crossings of a ray that starts on one of the surfaces. Its origin is rounded, so
  /// that the parts need not agree next to a seam.
  bool crossings_from_surface(const ExactRay& ray, CrossingList& out) const {
    const FaceStart& start = ray.near.start;
    std::array<CapsuleSpan, 3> spans;
    ObjectRay near = ray.near;
    near.first_wanted_after = std::numeric_limits<double>::infinity();
    for (std::uint32_t part = 0; part < parts_.size(); ++part) {
      near.start = start_on_part(start, part);
      spans[part] = span_of(part, ray.seen_as(near), out);
    }
    CapsuleSpan whole = united(spans);
    if (start.on_face) {
      begin_at_start(start, unit_roundoff * (radius_ / largest_component(near.direction)), whole);
    }
    append(whole, out);
    return false;
  }

  std::array<std::unique_ptr<const ExactShape>, 3> parts_;
  double radius_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Capsule& capsule) {
  return std::make_unique<ExactCapsuleShape>(capsule);
}

}  // namespace crt::core
