// A bounding volume hierarchy over boxes, by Embree: the only place that knows of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "core/geometry/bounds.hpp"

namespace crt::core {

/// Embree works in floats and silently drops what is too large for it. So it gets the boxes moved
/// and scaled by a power of two to around 1, and grown by more than all roundings on the way: it
/// decides nothing, it only spares tests. The scene's own size and place never matter.
class EmbreeTree {
 public:
  /// All boxes must be finite; `total` is the box around them.
  EmbreeTree(std::span<const Bounds> boxes, const Bounds& total);
  ~EmbreeTree();
  EmbreeTree(const EmbreeTree&) = delete;
  EmbreeTree& operator=(const EmbreeTree&) = delete;

  /// Is called with the index of a box that the ray may meet, and returns the t beyond which
  /// nothing matters any more (below t_min: stop).
  using Visit = std::function<double(std::uint32_t box)>;

  /// Visits, roughly from near to far, at least every box that the ray origin + t * direction meets
  /// at t_min <= t <= t_max. `direction` may have any length.
  void traverse(const Vec3& origin, const Vec3& direction, double t_min, double t_max,
                const Visit& visit) const;

 private:
  struct Handles;

  Bounds total_;  ///< grown like the boxes
  Vec3 center_{0, 0, 0};
  double scale_ = 1;  ///< a power of two: of the boxes that Embree gets
  std::unique_ptr<const Handles> handles_;
};

}  // namespace crt::core
