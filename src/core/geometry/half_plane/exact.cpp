// Half planes of the exact tier decide on which side of their edge the line meets their plane.
#include "core/geometry/exact_flat.hpp"
#include "core/geometry/half_plane/half_plane.hpp"

namespace crt::core {
namespace {

/// For a point in the plane, the direction gives the same side as its component across the normal.
class ExactHalfPlaneShape final : public ExactFlatShape {
 public:
  explicit ExactHalfPlaneShape(const HalfPlane& half_plane)
      : ExactFlatShape(ExactPlane(half_plane.normal, half_plane.position)),
        direction_(half_plane.direction),
        scaled_direction_(scaled_to_one(half_plane.direction)) {}

  std::size_t bytes() const override { return sizeof *this + plane().more_bytes(); }

 private:
  bool contains(const ExactRay& ray, const Meeting& meeting) const override {
    const NearPoint point = near_point(ray, meeting);
    const double inward = glm::dot(point.offset, scaled_direction_);
    constexpr double largest_sum = 6;  // for three components below 2
    if (std::abs(inward) > largest_sum * point.error) return inward > 0;
    const ExactPoint exact = exact_meeting(ray, meeting);
    return dot(exact.offset, exactly(direction_)).sign() >= 0;
  }

  Vec3 direction_;
  Vec3 scaled_direction_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const HalfPlane& half_plane) {
  return std::make_unique<ExactHalfPlaneShape>(half_plane);
}

}  // namespace crt::core
