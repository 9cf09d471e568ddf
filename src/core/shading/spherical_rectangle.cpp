#include "core/shading/spherical_rectangle.hpp"

#include <numbers>

#include "core/math/quick_angle.hpp"
#include "core/shading/quick_sine.hpp"

namespace crt::core {

namespace {

/// Returns the angles with these cosines.
Lanes angle_of(const Lanes& cosine) {
  const Lanes squared_sine = max(Lanes{}, (1.0 - cosine) * (1.0 + cosine));
  return quick_atan2<Lanes>(sqrt(squared_sine), cosine);
}

}  // namespace

SphericalRectangle::SphericalRectangle(const RectangleFrame& frame, const VectorLanes& corner)
    : frame_(frame),
      x0_(dot(corner, lanes_of(frame.x))),
      x1_(x0_ + frame.width),
      y0_(dot(corner, lanes_of(frame.y))),
      y1_(y0_ + frame.height),
      z_(dot(corner, lanes_of(frame.z))) {
  z_sign_ = select(z_ > 0.0, lanes_of(-1), lanes_of(1));
  z_ *= z_sign_;
  // These are the z of the normals of the planes through the edges.
  const Lanes squared = z_ * z_;
  const std::array<Lanes, 4> normals = {
      -y0_ / sqrt(squared + y0_ * y0_), x1_ / sqrt(squared + x1_ * x1_),
      y1_ / sqrt(squared + y1_ * y1_), -x0_ / sqrt(squared + x0_ * x0_)};
  std::array<Lanes, 4> angles;
  for (std::size_t i = 0; i < 4; ++i) angles[i] = angle_of(-normals[i] * normals[(i + 1) % 4]);
  b0_ = normals[0];
  b1_ = normals[2];
  k_ = 2 * std::numbers::pi - angles[2] - angles[3];
  solid_angles_ = angles[0] + angles[1] - k_;
}

VectorLanes SphericalRectangle::sample(const LightNumbers& numbers) const {
  const auto [sine, cosine] = quick_sine_and_cosine(numbers.u * solid_angles_ + k_);
  const Lanes f = (cosine * b0_ - b1_) / sine;
  const Lanes size = 1.0 / sqrt(f * f + b0_ * b0_);
  const Lanes c = clamp(select(f > 0.0, size, -size), lanes_of(-1), lanes_of(1));
  const Lanes level = max(sqrt((1.0 - c) * (1.0 + c)), lanes_of(0x1p-40));
  const Lanes x = clamp(-c * z_ / level, x0_, x1_);
  const Lanes squared = x * x + z_ * z_;
  const Lanes lowest = y0_ / sqrt(squared + y0_ * y0_);
  const Lanes highest = y1_ / sqrt(squared + y1_ * y1_);
  const Lanes h = lowest + numbers.v * (highest - lowest);
  const Lanes y =
      clamp(h * sqrt(squared) / sqrt(max(lanes_of(0x1p-80), (1.0 - h) * (1.0 + h))), y0_, y1_);
  return x * lanes_of(frame_.x) + y * lanes_of(frame_.y) + (z_ * z_sign_) * lanes_of(frame_.z);
}

}  // namespace crt::core
