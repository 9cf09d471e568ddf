// Embree's callbacks get these structs from the code that starts a traversal of the tree.
#pragma once

#include <array>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <vector>

#include "core/accel/embree_compat.hpp"
#include "core/accel/embree_device.hpp"
#include "core/accel/embree_floats.hpp"
#include "core/accel/embree_tree.hpp"

namespace crt::core {

inline constexpr float float_infinity = std::numeric_limits<float>::infinity();

/// Embree takes no ray that starts farther away, in units in which the half extent of all is
/// below 1. A ray that is so far away where it should enter the box around all meets nothing, but
/// rounding may put it there.
inline constexpr double farthest_place = 0x1p60;

/// An AnyTraversal is what the callbacks get from Embree. The context is the first member, so that
/// the two have one address.
struct AnyTraversal {
  enum class Kind { of_ray, of_packet };

  EmbreeContext context;
  Kind kind = Kind::of_ray;
};

/// A Traversal is what is known of a ray in the tree.
struct Traversal {
  AnyTraversal any;
  BoxVisitor* visitor = nullptr;
  double t_start = 0;  ///< t where Embree's ray starts
  double scale = 1;    ///< Embree's t for each unit of t
  std::exception_ptr failure;

  /// Returns Embree's end of the ray for the caller's.
  float far_end(double t) const { return round_up_length((t - t_start) * scale); }
};

/// A PacketTraversal is what is known of a packet in the tree.
struct PacketTraversal {
  AnyTraversal any{.context = {}, .kind = AnyTraversal::Kind::of_packet};
  PacketVisitor* visitor = nullptr;
  const RayPacket* packet = nullptr;
  std::array<Lanes, RayPacket::group_count> t_start{};
  double scale = 1;
  std::exception_ptr failure{};

  FloatLanes far_ends(std::size_t group) const {
    const Lanes& start = t_start[group];
    const Lanes& limit = packet->limits[group];
    const FloatLanes most =
        to_floats(select(limit < start, lanes_of(-infinity), lanes_of(infinity)));
    return min(round_up_length((limit - start) * scale), most);
  }
};

struct EmbreeTree::Handles {
  std::shared_ptr<EmbreeDevice> device;
  RTCScene scene = nullptr;
  std::vector<RTCBounds> boxes;   ///< until Embree has built its tree
  std::int64_t embree_bytes = 0;  ///< of memory that Embree takes for the tree
  bool takes_sixteen = false;     ///< rays at once, without taking them one by one

  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }
};

void bounds_callback(const RTCBoundsFunctionArguments* arguments);
void intersect_callback(const RTCIntersectFunctionNArguments* arguments);
void occluded_callback(const RTCOccludedFunctionNArguments* arguments);

}  // namespace crt::core
