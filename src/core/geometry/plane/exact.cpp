// Planes of the exact tier are half-spaces with an exact boundary.
#include "core/geometry/exact_flat.hpp"
#include "core/geometry/plane/plane.hpp"

namespace crt::core {
namespace {

class ExactPlaneShape final : public ExactShape {
 public:
  explicit ExactPlaneShape(const Plane& plane) : plane_(plane.normal, plane.position) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    if (ray.near.start.face == 0) {
      const bool entering = ray.near.start.side == Side::inside;
      if (plane_.side(ray) == 0) return entering;
      out.push_back({.entering = entering});
      return !entering;
    }
    const ExactPlane::Meeting meeting = plane_.meet(ray);
    if (!meeting.found()) return meeting.behind;
    out.push_back(meeting.crossing());
    return meeting.side > 0;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    return place_on(plane_, ray, crossing);
  }

  ExactSurface surface(std::uint32_t /*face*/) const override {
    return {.is_plane = true, .points = {}, .numbers = plane_.numbers()};
  }

  std::size_t bytes() const override { return sizeof *this + plane_.more_bytes(); }

 private:
  ExactPlane plane_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Plane& plane) {
  return std::make_unique<ExactPlaneShape>(plane);
}

}  // namespace crt::core
