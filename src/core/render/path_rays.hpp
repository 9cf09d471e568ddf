// The rays that samples follow side by side, and the light that comes along them.
#pragma once

#include <array>
#include <span>

#include "core/render/workspace.hpp"

namespace crt::core {

/// What comes along a camera ray.
struct Sample {
  Lanes channels{0, 0, 0, 1};  ///< red, green and blue, premultiplied with the last: alpha
  /// The weight of rays that were not followed, of the channel that lost most.
  double dropped = 0;
  std::uint64_t identity = 0;  ///< see sample_identity.hpp; 0 if nobody asks for it
};

/// The rays of one round: one for each sample that is not done. They are known by their numbers.
/// Either all of them come from the camera, or none does.
struct PathRays {
  std::size_t count = 0;
  std::size_t waiting = 0;  ///< further rays, on the stacks of all samples
  RayBatch batch;
  std::array<VectorLanes, RayPacket::group_count> weights;  ///< shares of the pixels' light
  std::array<PathState, packet_size> states;
  std::array<SampleWork*, packet_size> works;
  std::array<Sample*, packet_size> samples;

  bool empty() const { return count == 0; }
  RayMask all() const { return RayPacket::all(count); }
  bool are_from_camera() const { return states[0].kind == RayKind::camera; }

  /// Removes all rays that do not wait.
  void clear() {
    count = 0;
    batch.with_starts = 0;
  }
  /// Adds the ray that a sample follows next.
  void add(const PathRay& ray, SampleWork& work, Sample& sample) {
    batch.set(count, ray.origin, ray.direction, ray.start);
    weights[count / lane_count].set(count % lane_count, ray.weight);
    states[count] = ray.path;
    works[count] = &work;
    samples[count] = &sample;
    ++work.rays;
    ++count;
  }
};

/// Light that reaches the camera along some rays of a round.
struct PathLight {
  RayMask rays = 0;
  std::array<VectorLanes, RayPacket::group_count> colors;
};

/// Adds light to the samples of the rays that it comes along.
inline void add(std::span<Sample* const, packet_size> samples, const PathLight& light) {
  RayPacket::for_each_group(light.rays, [&](std::size_t group, RayMask lanes) {
    const auto colors = by_lane(light.colors[group]);
    Sample* const* const first = &samples[group * lane_count];
    if (lanes == RayPacket::group_mask) {  // Most groups are full, and this needs no branches.
      for (std::size_t lane = 0; lane < lane_count; ++lane) first[lane]->channels += colors[lane];
    } else {
      for_each_ray(lanes, [&](std::size_t lane) { first[lane]->channels += colors[lane]; });
    }
  });
}

}  // namespace crt::core
