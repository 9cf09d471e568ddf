// The exact tier takes what a custom shape says for the truth.
#include "core/geometry/custom/custom.hpp"
#include "core/geometry/exact_shape.hpp"

namespace crt::core {

namespace {

class ExactCalledShape final : public ExactShape {
 public:
  explicit ExactCalledShape(const Custom& custom)
      : custom_(custom.shape), shape_(make_shape(custom)) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    return shape_->crossings(ray.near, out);
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    // No polynomial says where the surface is.
    return std::nullopt;
  }

  ExactSurface surface(std::uint32_t face) const override {
    ExactSurface result{.points = {exactly(Vec3(0))}, .numbers = {}};
    for (const double number : identity_of(*custom_, face)) result.numbers.emplace_back(number);
    return result;
  }

  std::size_t bytes() const override { return sizeof *this + shape_->bytes(); }

 private:
  std::shared_ptr<const CustomShape> custom_;
  std::unique_ptr<const Shape> shape_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Custom& custom) {
  return std::make_unique<ExactCalledShape>(custom);
}

}  // namespace crt::core
