// Discs of the exact tier compare the distance from the centre with the radius.
#include "core/geometry/disc/disc.hpp"
#include "core/geometry/exact_flat.hpp"

namespace crt::core {
namespace {

class ExactDiscShape final : public ExactFlatShape {
 public:
  explicit ExactDiscShape(const Disc& disc)
      : ExactFlatShape(ExactPlane(disc.normal, disc.center)), radius_(disc.radius) {}

  std::size_t bytes() const override { return sizeof *this + plane().more_bytes(); }

 private:
  bool contains(const ExactRay& ray, const Meeting& meeting) const override {
    const NearPoint point = near_point(ray, meeting);
    const double distance = glm::length(point.offset / radius_);
    const double margin = 1 - distance;
    if (std::abs(margin) > filter_rounding * (1 + distance) + 2 * (point.error / radius_))
      return margin > 0;
    const ExactPoint exact = exact_meeting(ray, meeting);
    return (dot(exact.offset, exact.offset) - square(exact.weight * Dyadic(radius_))).sign() <= 0;
  }

  double radius_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Disc& disc) {
  return std::make_unique<ExactDiscShape>(disc);
}

}  // namespace crt::core
