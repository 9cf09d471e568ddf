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
/// They are those of the line o + s e, whose direction e has a largest component from 1 to 2: a
/// power of two times the ray's. So s is a power of two times t.
///
/// Errors. With b = (origin - o) / e and the step c / e, a plane is met at b + n c for a byte n.
/// Three roundings go into b, two into c, and one is the last. All are relative to |b| + 255 |c| at
/// most. Along an axis to which the line is parallel, or all but, any s is right from where it is
/// between two planes. There 1 / e counts as 2^1000, and the planes are farther apart by a
/// distance. That is more than rounding moves a line which starts on one of them, and more than the
/// line leaves it by: coordinates are below 2^333, and so s is below 2^334 + |o|.
class GridSlabs {
 public:
  /// `origin_error` is as RaySlabs takes it.
  GridSlabs(const Vec3& origin, const Vec3& direction, double origin_error);

  double to_s(double t) const { return t * inverse_scale_; }

  /// Returns which boxes the line meets from s = `begin` to `end`, and writes where it enters them.
  std::uint32_t meet(const GridBoxes& boxes, double begin, double end,
                     std::array<double, GridBoxes::most>& enters) const {
    using Numbers = std::array<double, lane_count>;
    const Lanes first = (lanes_at<Lanes>(boxes.origin_.data()) - origin_) * inverse_;
    const Lanes step = lanes_at<Lanes>(boxes.step_.data()) * inverse_;
    constexpr double most_steps = 256;
    const Lanes error = RaySlabs::slack * (abs(first) + most_steps * abs(step)) + error_;
    alignas(32) Numbers steps;
    alignas(32) Numbers nearest;
    alignas(32) Numbers farthest;
    put_lanes(step, steps, 0);
    put_lanes(first - error, nearest, 0);
    put_lanes(first + error, farthest, 0);
    std::uint32_t met = 0;
    for (std::size_t half = 0; half < GridBoxes::most; half += lane_count) {
      Lanes enter = begin;
      Lanes leave = end;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint8_t* const near = &boxes.corners_[near_[axis]][axis][half];
        const std::uint8_t* const far = &boxes.corners_[1 - near_[axis]][axis][half];
        const Lanes along = steps[axis];
        // NaN, as from infinity less infinity, clips nothing.
        enter = max(enter, multiply_add(lanes_of_bytes(near), along, Lanes(nearest[axis])));
        leave = min(multiply_add(lanes_of_bytes(far), along, Lanes(farthest[axis])), leave);
      }
      put_lanes(enter, enters, half);
      met |= mask_of(enter <= leave) << half;
    }
    return met;
  }

 private:
  // The lane that is not used has numbers with which nothing special happens.
  Lanes origin_;
  Lanes inverse_;
  Lanes error_;  ///< of s
  double inverse_scale_;
  std::array<std::size_t, 3> near_{};  ///< by axis, which corners the line comes to first
};

}  // namespace crt::core
