// Rays as the cheap tests take them, one or a packet: which objects they leave open.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/scene/accelerator.hpp"
#include "core/scene/certain_end.hpp"
#include "core/scene/ray_packet.hpp"

namespace crt::core {

/// What a cheap test may say of an object.
enum class Judgement { open, missed, met };

/// One ray and the cheap tests.
class OutlinedRay {
 public:
  OutlinedRay(const Accelerator& accelerator, const WorldRay& ray)
      : start_surface_(ray.start.surface),
        start_side_(ray.start.side),
        left_object_(accelerator.left_for_good(ray.start)) {
    const Vec3& d = ray.direction;
    line_.origin = {ray.origin.x, ray.origin.y, ray.origin.z};
    line_.direction = {d.x, d.y, d.z};
    line_.squared_speed = glm::dot(d, d);
    line_.inverse_squared_speed = 1 / line_.squared_speed;
    line_.inverse_speed = std::sqrt(line_.inverse_squared_speed);
    line_.begin = ray.t_min;
    line_.start_error = ray.start.t_error;
    line_.certain_from = farthest_start(ray);
    line_.certain_to = finite_end(certain_end(ray));
  }

  const OutlineLine<double>& line() const { return line_; }

  Judgement judge(const Outline& outline, std::span<const OutlineAxis> axes, double limit) const {
    double last;
    return judge(outline, axes, limit, last);
  }

  /// `last` is set for a plane that is met, to a t not before that.
  Judgement judge(const Outline& outline, std::span<const OutlineAxis> axes, double limit,
                  double& last) const {
    if (outline.object == left_object_) return Judgement::missed;
    if (outline.kind == Outline::Kind::unknown) return Judgement::open;
    // Of that surface it is known otherwise where the ray meets it.
    if (outline.surface == start_surface_) {
      const bool has_left = outline.kind == Outline::Kind::torus && start_side_ == Side::outside &&
                            leaves_torus(outline, axes[outline.detail], line_);
      return has_left ? Judgement::missed : Judgement::open;
    }
    const auto verdict = judge_outline(outline, axes, line_, limit, last);
    if (verdict.missed) return Judgement::missed;
    return verdict.met ? Judgement::met : Judgement::open;
  }

 private:
  OutlineLine<double> line_;
  std::uint32_t start_surface_;
  Side start_side_;
  std::uint32_t left_object_;
};

/// A packet and the cheap tests.
class OutlinedPacket {
 public:
  explicit OutlinedPacket(const RayPacket& packet) : packet_(packet) {}

  /// Those that start on a surface.
  RayMask starting_on(std::uint32_t surface) const {
    return packet_.on_surface == 0 ? 0 : rays_with(packet_.start_surfaces, surface);
  }

  Verdict<RayMask> judge(const Outline& outline, std::span<const OutlineAxis> axes, RayMask rays) const {
    std::array<Lanes, RayPacket::group_count> last;
    return judge(outline, axes, rays, last);
  }

  Verdict<RayMask> judge(const Outline& outline, std::span<const OutlineAxis> axes, RayMask rays,
                         std::array<Lanes, RayPacket::group_count>& last) const {
    Verdict<RayMask> verdict{};
    if (outline.kind != Outline::Kind::unknown) {
      for (std::size_t group = 0; group < RayPacket::group_count; ++group) {
        const std::size_t first = group * lane_count;
        if (RayPacket::lanes(rays, group) == 0) continue;
        const OutlineLine<Lanes>& lines = packet_.groups[group];
        const Lanes& limits = packet_.limits[group];
        const Verdict<LaneMask> of_lanes = judge_outline(outline, axes, lines, limits, last[group]);
        verdict.missed |= mask_of(of_lanes.missed) << first;
        verdict.met |= mask_of(of_lanes.met) << first;
      }
      if ((rays & packet_.on_surface) != 0) {
        const RayMask open = rays_with(packet_.start_surfaces, outline.surface);
        verdict.missed &= ~open;
        verdict.met &= ~open;
        const RayMask outwards = open & rays & packet_.outwards;
        if (outline.kind == Outline::Kind::torus && outwards != 0)
          verdict.missed |= outwards & leaving(outline, axes[outline.detail], outwards);
      }
    }
    if ((rays & packet_.left_some) != 0) verdict.missed |= rays_with(packet_.left_objects, outline.object);
    verdict.missed &= rays;
    verdict.met &= rays & ~verdict.missed;
    return verdict;
  }

 private:
  /// Those that leave a torus for good, of rays that start on it.
  RayMask leaving(const Outline& torus, const OutlineAxis& axis, RayMask rays) const {
    RayMask result = 0;
    for (std::size_t group = 0; group < RayPacket::group_count; ++group) {
      const std::size_t first = group * lane_count;
      if (RayPacket::lanes(rays, group) == 0) continue;
      result |= mask_of(leaves_torus(torus, axis, packet_.groups[group])) << first;
    }
    return result;
  }

  const RayPacket& packet_;
};

}  // namespace crt::core
