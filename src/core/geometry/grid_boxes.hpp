// Boxes on a grid of their own take a byte a coordinate, and a line meets eight at a time.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "core/geometry/bounds.hpp"
#include "core/geometry/ray_slabs.hpp"
#include "core/simd/bits.hpp"

namespace crt::core {

/// GridBoxes are up to eight boxes side by side. Their corners are whole steps from an origin,
/// rounded outwards. It takes a quarter of the memory of the boxes in double.
/// Source: Ylitalo, Karras, Laine, Efficient incoherent ray traversal on GPUs through compressed
/// wide BVHs, 2017.
class GridBoxes {
 public:
  static constexpr std::size_t most = 8;

  GridBoxes() = default;
  explicit GridBoxes(std::span<const Bounds> boxes);

  /// Returns a box, a little larger than what it was made of.
  Bounds box(std::size_t index) const;
  /// Returns which boxes touch another one, and perhaps some that all but touch it.
  std::uint32_t touching(const Bounds& other) const;

  friend bool operator==(const GridBoxes&, const GridBoxes&) = default;

 private:
  friend class GridSlabs;
  using Bytes = std::array<std::uint8_t, most>;
  static constexpr std::size_t lower = 0;
  static constexpr std::size_t upper = 1;

  std::array<double, 3> step_{};    ///< by axis, powers of two
  std::array<double, 3> origin_{};  ///< by axis
  /// These are the numbers of steps to the lower and the upper corners, by axis.
  std::array<std::array<Bytes, 3>, 2> corners_{};
};

/// GridSlabs are what of a line does not change from GridBoxes to GridBoxes.
///
/// They are those of the line o + s e u, where u is a power of two that is about the size of what
/// all boxes are in, and the largest component of e is from 1 to 2. So s is t times a power of two.
///
/// A plane is met at b + n c for a byte n, where b = (origin - o) / (e u) and c is the step by the
/// same divisor. These are doubles. What is added up for eight boxes at once are floats, relative
/// to where the line comes to all of them. So little is lost, however far o is away.
///
/// Errors. Three roundings go into b, two into c, one into the difference from where the line comes
/// in. All are relative to |b| + 255 |c| and that place. In floats the sum has two roundings, and
/// its parts one each, relative to what is added up.
///
/// Along an axis to which the line is parallel, or all but, any s is right from where it is between
/// two planes. There e counts as 2^-40, and the planes are farther apart by a distance. That is
/// more than rounding moves a line which starts on one of them, and more than the line leaves it by
/// until it is past all boxes. So b is below all s at which the line meets a box, and b + n c
/// above.
class GridSlabs {
 public:
  /// Takes the bounds of all boxes. `origin_error` is as RaySlabs takes it.
  GridSlabs(const Vec3& origin, const Vec3& direction, double origin_error, const Bounds& bounds);

  double to_s(double t) const { return t * direction_scale_ * inverse_unit_; }

  /// An Approach is a line that comes to some boxes at about s = `from`. They are tested the more
  /// exactly, the nearer that is to where it comes to the first.
  struct Approach {
    const GridSlabs& slabs;
    double from;
  };
  /// Returns the line as it comes to boxes at about s = `from`, which is not finite if unknown.
  Approach approach(double from) const { return {*this, std::isfinite(from) ? from : 0}; }

  /// An Entries says where a line comes to each of the boxes that it meets, or before.
  class Entries {
   public:
    double operator[](std::size_t box) const { return from_ + double{relative_[box]}; }

   private:
    friend class GridSlabs;
    double from_;
    alignas(32) std::array<float, GridBoxes::most> relative_;
  };

  /// Returns which boxes the line meets from s = `begin` to `end`, and writes where it enters them.
  /// `from` is as an Approach has it.
  std::uint32_t meet(const GridBoxes& boxes, double from, double begin, double end,
                     Entries& entries) const {
    constexpr double most_steps = 256;
    constexpr double slack = RaySlabs::slack;
    constexpr double float_slack = 0x1p-21;
    const Lanes first = (lanes_at<Lanes>(boxes.origin_.data()) - origin_) * inverse_;
    const Lanes step = lanes_at<Lanes>(boxes.step_.data()) * inverse_;
    const Lanes size = most_steps * abs(step);
    const Lanes relative = select(is_parallel_, first, first - from);
    const Lanes error = slack * (abs(first) + size + std::abs(from)) + error_ +
                        float_slack * (abs(relative) + size);
    const FloatLanes steps = to_floats(step);
    const FloatLanes nearest = to_floats(relative - error);
    const FloatLanes farthest = to_floats(relative + error);
    const auto widened = [&](double place, double sign) {
      const double distance = place - from;
      return static_cast<float>(distance +
                                sign * (float_slack * std::abs(distance) + slack * std::abs(from)));
    };
    FloatOctet enter = widened(begin, -1);
    FloatOctet leave = widened(end, 1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint8_t* const near = boxes.corners_[near_[axis]][axis].data();
      const std::uint8_t* const far = boxes.corners_[1 - near_[axis]][axis].data();
      const FloatOctet along = static_cast<float>(steps[axis]);
      const auto at = [&](const std::uint8_t* bytes, const FloatLanes& place) {
        return multiply_add(octet_of_bytes(bytes), along,
                            FloatOctet(static_cast<float>(place[axis])));
      };
      enter = max(enter, at(near, nearest));
      leave = min(leave, at(far, farthest));
    }
    entries.from_ = from - slack * std::abs(from);
    enter.copy_to(entries.relative_.data(), stdx::vector_aligned);
    return mask_of(enter <= leave);
  }

 private:
  // The lane that is not used counts as parallel, and nothing is read from it.
  Lanes origin_;
  Lanes inverse_;
  Lanes error_;  ///< of s
  LaneMask is_parallel_;
  double direction_scale_;
  double inverse_unit_;
  std::array<std::size_t, 3> near_{};  ///< by axis, which corners the line comes to first
};

}  // namespace crt::core
