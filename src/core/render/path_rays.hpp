// Samples follow these rays side by side, and this light comes along them.
#pragma once

#include <array>
#include <span>

#include "core/render/frame.hpp"

namespace crt::core {

/// A Sample is what comes along a camera ray.
struct Sample {
  /// They are red, green and blue, premultiplied with the last, alpha.
  Lanes channels = lanes_of(0, 0, 0, 1);
  /// The weight of rays that were not followed, of the channel that lost most.
  double dropped = 0;
  std::uint64_t identity = 0;  ///< see sample_identity.hpp; 0 if nobody asks for it
};

/// PathRays are those of one round: one for each sample that is not done. They are known by their
/// numbers. Either all of them come from the camera, or none does.
struct PathRays {
  std::size_t count = 0;
  RayBatch batch;
  std::array<VectorLanes, RayPacket::group_count> weights;  ///< shares of the pixels' light
  std::array<PathState, packet_size> states;
  std::array<SampleWork*, packet_size> works;
  std::array<Sample*, packet_size> samples;

  bool empty() const { return count == 0; }
  RayMask all() const { return RayPacket::all(count); }
  /// Returns those that start within a transparent solid.
  RayMask in_media() const {
    RayMask mask = 0;
    for (std::size_t i = 0; i < count; ++i) {
      mask |= mask_of(states[i].media != MediaLists::empty) << i;
    }
    return mask;
  }
  /// Returns those whose surfaces may send diffuse rays on, of which there may be so many in a row.
  RayMask sending_diffuse(int indirect) const {
    RayMask mask = 0;
    for (std::size_t i = 0; indirect > 0 && i < count; ++i)
      mask |= mask_of(states[i].diffuse_bounces < indirect) << i;
    return mask;
  }
  /// Returns those that have had fewer bounces in mirrors and glass.
  RayMask within_depth(int depth) const {
    RayMask mask = 0;
    for (std::size_t i = 0; i < count; ++i) mask |= mask_of(states[i].bounces < depth) << i;
    return mask;
  }
  /// Returns the densities with which the directions of a group were drawn.
  Lanes densities(std::size_t group) const {
    const PathState* const first = &states[group * lane_count];
    return Lanes([first](auto lane) { return first[lane].density; });
  }
  /// Returns those whose directions were drawn, by surfaces that have taken samples of lights.
  RayMask drawn() const {
    RayMask mask = 0;
    for (std::size_t i = 0; i < count; ++i) mask |= mask_of(states[i].density > 0) << i;
    return mask;
  }
  /// Returns those with such a direction, or that come from such a ray by mirrors and glass.
  RayMask after_scattering() const {
    RayMask mask = 0;
    for (std::size_t i = 0; i < count; ++i) mask |= mask_of(states[i].is_scattered) << i;
    return mask;
  }
  /// Draws the numbers of a decision of a kind for a group, of one of some samples of it: two of
  /// them, or all four.
  template <std::size_t numbers = sequence_dimensions>
  std::array<Lanes, numbers> draw(const Frame& frame, std::size_t group, std::uint32_t kind,
                                  int samples = 1, int sample = 0) const {
    std::array<SampleId, lane_count> ids{};
    std::array<SampleDecision, lane_count> decisions{};
    for (std::size_t lane = 0; lane < lane_count; ++lane) {
      const std::size_t ray = group * lane_count + lane;
      if (ray >= count) break;
      ids[lane] = works[ray]->id;
      ids[lane].index = ids[lane].index * static_cast<std::uint32_t>(samples) +
                        static_cast<std::uint32_t>(sample);
      decisions[lane] = {static_cast<std::uint32_t>(works[ray]->rays), kind};
    }
    const std::uint64_t seed = frame.settings().seed;
    if (!are_from_camera() || samples > 1 || !frame.takes_numbers_of_lens(kind))
      return sample_numbers<numbers>(seed, ids, decisions);
    const auto [u, v] = numbers_of_lens(seed, ids);
    if constexpr (numbers > 2) {
      if (kind == SampleDecision::chosen_light)
        return {u, v, sample_numbers(seed, ids, decisions)[2]};
    }
    return {u, v};
  }
  /// Returns those that come after a diffuse bounce.
  RayMask after_diffuse() const {
    RayMask mask = 0;
    for (std::size_t i = 0; i < count; ++i) mask |= mask_of(states[i].diffuse_bounces > 0) << i;
    return mask;
  }
  bool are_from_camera() const { return states[0].kind == RayKind::camera; }
  /// Returns their kind, by which they may pass objects.
  PassingRays passing() const { return are_from_camera() ? passing_camera : passing_none; }

  /// Adds the ray that a sample follows next.
  [[gnu::always_inline]] void add(const PathRay& ray, SampleWork& work, Sample& sample) {
    batch.set(count, ray.origin, ray.direction, ray.start);
    weights[count / lane_count].set(count % lane_count, ray.weight);
    states[count] = ray.path;
    works[count] = &work;
    samples[count] = &sample;
    ++work.rays;
    ++count;
  }
};

/// A PathLight reaches the camera along some rays of a round.
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
