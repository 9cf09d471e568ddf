// A BoxTree is a hierarchy over the boxes of a scene, of which an edited scene keeps what it can.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/accel/embree_tree.hpp"

namespace crt::core {

/// A BoxTree is one of Embree's trees, or two after an edit: that of an earlier scene, some of
/// whose boxes are left out, and one of the boxes that were added since. These have the numbers
/// after all of the first.
class BoxTree {
 public:
  BoxTree() = default;
  /// Builds a tree over boxes as EmbreeTree does. No coordinate of any scene that it will be kept
  /// for may be larger than `farthest`.
  BoxTree(std::span<const Bounds> boxes, const Bounds& total, double farthest, StopCheck* stop);
  /// Keeps the first tree of an earlier one, but for some of its boxes. Adds a tree over others,
  /// which may be none. `total` is the box around these.
  BoxTree(const BoxTree& earlier, std::vector<bool> left_out, std::span<const Bounds> added,
          const Bounds& total, double farthest, StopCheck* stop);

  bool empty() const { return first_ == nullptr; }
  /// Returns how many boxes the first tree has, with those that are left out.
  std::size_t first_count() const { return first_count_; }
  /// Returns the largest coordinate that the first tree may be kept for.
  double farthest() const { return farthest_; }
  /// Returns the bytes of memory that it takes.
  std::uint64_t bytes() const;

  // These do what those of EmbreeTree do.

  void traverse(const Vec3& origin, const Vec3& direction, double t_min, double t_max,
                bool from_near, BoxVisitor& visitor) const {
    if (!is_edited_) return first_->traverse(origin, direction, t_min, t_max, from_near, visitor);
    traverse_both(origin, direction, t_min, t_max, from_near, visitor);
  }
  void traverse(const RayPacket& packet, RayMask rays, PacketVisitor& visitor) const {
    if (!is_edited_) return first_->traverse(packet, rays, visitor);
    traverse_both(packet, rays, visitor);
  }

 private:
  void traverse_both(const Vec3& origin, const Vec3& direction, double t_min, double t_max,
                     bool from_near, BoxVisitor& visitor) const;
  void traverse_both(const RayPacket& packet, RayMask rays, PacketVisitor& visitor) const;

  std::shared_ptr<const EmbreeTree> first_;
  std::size_t first_count_ = 0;
  double farthest_ = 0;
  bool is_edited_ = false;
  std::vector<bool> left_out_;  ///< boxes of the first tree
  std::unique_ptr<const EmbreeTree> added_;
};

}  // namespace crt::core
