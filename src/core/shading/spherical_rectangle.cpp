#include "core/shading/spherical_rectangle.hpp"

#include <numbers>

#include "core/math/quick_angle.hpp"
#include "core/shading/quick_sine.hpp"

namespace crt::core {

namespace {

/// A Turn is an angle by its cosine and sine. A rectangle's are from 0 to half a turn.
struct Turn {
  Lanes cosine;
  Lanes sine;
};

Turn turn_of(const Lanes& cosine) {
  return {.cosine = cosine, .sine = sqrt(max(Lanes{}, (1.0 - cosine) * (1.0 + cosine)))};
}

Turn sum(const Turn& a, const Turn& b) {
  return {.cosine = a.cosine * b.cosine - a.sine * b.sine,
          .sine = a.sine * b.cosine + a.cosine * b.sine};
}

/// Returns how much more than half a turn an angle between none and a whole one is.
Lanes beyond_half(const Turn& turn) {
  return quick_atan2<Lanes>(-turn.sine, -turn.cosine);
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
  const Lanes to_first_edge = sqrt(squared + y0_ * y0_);
  const std::array<Lanes, 4> normals = {-y0_ / to_first_edge, x1_ / sqrt(squared + x1_ * x1_),
                                        y1_ / sqrt(squared + y1_ * y1_),
                                        -x0_ / sqrt(squared + x0_ * x0_)};
  // The angles between the planes are more than two half turns by the solid angle.
  std::array<Turn, 4> turns;
  for (std::size_t i = 0; i < 4; ++i) turns[i] = turn_of(-normals[i] * normals[(i + 1) % 4]);
  const Turn first = sum(turns[0], turns[1]);
  const Turn last = sum(turns[2], turns[3]);
  solid_angles_ = beyond_half(first) + beyond_half(last);
  b0_ = normals[0];
  b1_ = normals[2];
  w0_ = -z_ / to_first_edge;
  cosine_of_k_ = last.cosine;
  sine_of_k_ = -last.sine;
}

VectorLanes SphericalRectangle::sample(const LightNumbers& numbers) const {
  const auto [sine, cosine] = quick_sine_and_cosine(numbers.u * solid_angles_);
  const Lanes d = sine * cosine_of_k_ + cosine * sine_of_k_;
  const Lanes n = (cosine * cosine_of_k_ - sine * sine_of_k_) * b0_ - b1_;
  // The source's f is n / d, and its c is d / sqrt(n^2 + b0^2 d^2) with the sign of n.
  const Lanes level = sqrt(max((n - d * w0_) * (n + d * w0_), lanes_of(0x1p-80)));
  const Lanes x = clamp(select(n > 0.0, -d, d) * z_ / level, x0_, x1_);
  const Lanes squared = x * x + z_ * z_;
  const Lanes lowest = y0_ / sqrt(squared + y0_ * y0_);
  const Lanes highest = y1_ / sqrt(squared + y1_ * y1_);
  const Lanes h = lowest + numbers.v * (highest - lowest);
  const Lanes y =
      clamp(h * sqrt(squared / max(lanes_of(0x1p-80), (1.0 - h) * (1.0 + h))), y0_, y1_);
  return x * lanes_of(frame_.x) + y * lanes_of(frame_.y) + (z_ * z_sign_) * lanes_of(frame_.z);
}

}  // namespace crt::core
