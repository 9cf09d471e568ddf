// EmbreeTree is a bounding volume hierarchy over boxes, built by Embree. Only the files embree_*
// know of Embree.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "core/geometry/bounds.hpp"
#include "core/ray/ray_packet.hpp"
#include "core/tasks/workers.hpp"

namespace crt::core {

/// A BoxVisitor gets the boxes that a ray may meet.
class BoxVisitor {
 public:
  virtual ~BoxVisitor() = default;

  /// Returns the t beyond which nothing matters, or one below t_min to stop.
  virtual double visit(std::uint32_t box) = 0;
};

/// A PacketVisitor gets the boxes that rays of a packet may meet.
class PacketVisitor {
 public:
  virtual ~PacketVisitor() = default;

  /// Returns for which of these rays the packet's limit has changed. A limit below t_min stops a
  /// ray.
  virtual RayMask visit(std::uint32_t box, RayMask rays) = 0;
};

/// A BoxCaller calls visit(box) for each box.
template <class Visit>
class BoxCaller final : public BoxVisitor {
 public:
  explicit BoxCaller(const Visit& call) : call_(call) {}
  double visit(std::uint32_t box) override { return call_(box); }

 private:
  const Visit& call_;
};

/// A PacketCaller calls visit(box, rays) for each box.
template <class Visit>
class PacketCaller final : public PacketVisitor {
 public:
  explicit PacketCaller(const Visit& call) : call_(call) {}
  RayMask visit(std::uint32_t box, RayMask met) override { return call_(box, met); }

 private:
  const Visit& call_;
};

/// An EmbreeTree gives Embree boxes that are moved and scaled by a power of two to around 1. Embree
/// works in floats, and silently drops what is too large for it. The boxes are also grown by more
/// than all roundings add up to. So Embree decides nothing and only spares tests. The scene's own
/// size and place never matter.
class EmbreeTree {
 public:
  /// Builds the tree over boxes, all of which must be finite. `total` is the box around them. No
  /// ray starts on anything that has a larger coordinate than `farthest`. `stop` may stop the
  /// building.
  EmbreeTree(std::span<const Bounds> boxes, const Bounds& total, double farthest,
             StopCheck* stop = nullptr);
  ~EmbreeTree();
  EmbreeTree(const EmbreeTree&) = delete;
  EmbreeTree& operator=(const EmbreeTree&) = delete;

  /// Returns the bytes of memory that Embree takes.
  std::uint64_t bytes() const;

  /// Visits at least every box that the ray origin + t * direction meets at t_min <= t <= t_max.
  /// The order is roughly from near to far. Without `from_near`, which is faster, it is any order,
  /// where nothing but a stop spares boxes. `direction` may have any length.
  void traverse(const Vec3& origin, const Vec3& direction, double t_min, double t_max,
                bool from_near, BoxVisitor& visitor) const;

  /// Traverses the tree with visit(box) for a visitor.
  template <class Visit>
  void traverse(const Vec3& origin, const Vec3& direction, double t_min, double t_max,
                bool from_near, const Visit& visit) const {
    BoxCaller<Visit> caller(visit);
    traverse(origin, direction, t_min, t_max, from_near, static_cast<BoxVisitor&>(caller));
  }

  /// Visits at least every box that one of some rays of a packet meets, up to their limits.
  void traverse(const RayPacket& packet, RayMask rays, PacketVisitor& visitor) const;
  template <class Visit>
  void traverse(const RayPacket& packet, RayMask rays, const Visit& visit) const {
    PacketCaller<Visit> caller(visit);
    traverse(packet, rays, static_cast<PacketVisitor&>(caller));
  }

 private:
  struct Handles;
  struct Entry;
  template <class RayHits>
  struct Part;

  /// Computes where those of a group's rays that are in `lanes` enter and leave the box around all.
  void enter(const FilterLine<Lanes>& lines, const Lanes& limits, RayMask lanes,
             Entry& entry) const;
  template <class RayHits>
  void traverse_part(const RayPacket& packet, RayMask rays, std::size_t first_ray,
                     PacketVisitor& visitor) const;

  Bounds total_;  ///< grown like the boxes
  Vec3 center_{0, 0, 0};
  double scale_ = 1;  ///< a power of two, by which Embree's boxes are scaled
  std::unique_ptr<const Handles> handles_;
};

}  // namespace crt::core
