// The two queries that most rays ask, for one ray or a packet of them: the nearest crossing, and whether
// there is any. Cheap tests come first, exact ones where these leave something open.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>

#include "core/math/vector.hpp"
#include "core/scene/embree_tree.hpp"
#include "core/scene/object_query.hpp"
#include "core/scene/outlined_rays.hpp"

namespace crt::core {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// How far along the ray from a hit other crossings may be and yet be at its place, or at the start of a ray
/// that goes on from it, whose origin is rounded. Wide, as the next ray may meet at right angles what
/// this one grazes: it only decides where to look.
double company_width(const WorldRay& ray, double t, double error) {
  constexpr double error_factor = 4;
  constexpr double relative_width = 0x1p-40;
  const double farthest =
      std::fma(std::abs(t), largest_component(ray.direction), largest_component(ray.origin));
  return error_factor * error + relative_width * farthest;
}

class Nearest final : public ObjectQuery<Nearest> {
 public:
  static constexpr bool takes_one = true;
  static constexpr bool any_will_do = false;

  void start(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work, RayHit& best) {
    ObjectQuery::start(accelerator, ray, work);
    best_ = &best;
    best = {};
  }

  bool take(const RayHit& hit) {
    if (!(hit.t < ray().t_max)) return false;
    RayHit& best = *best_;
    if (std::tie(hit.t, hit.t_low, hit.object) < std::tie(best.t, best.t_low, best.object)) {
      const double reach = hit.t + company_width(ray(), hit.t, hit.error);
      const bool has_company = best.t <= reach;
      best = hit;
      best.has_company = has_company;
      set_limit(std::min(limit(), reach));
    } else {
      best.has_company = true;
    }
    return false;
  }

 private:
  RayHit* best_ = nullptr;
};

class Any final : public ObjectQuery<Any> {
 public:
  using ObjectQuery::ObjectQuery;
  static constexpr bool takes_one = true;
  static constexpr bool any_will_do = true;
  bool found = false;

  bool take(const RayHit& hit) {
    if (is_on_way(hit)) settle();
    return false;
  }
  void settle() {
    found = true;
    set_limit(-infinity);
  }
};

/// Takes a ray that starts into a solid which keeps apart to where it leaves that, if it is one: what there
/// is elsewhere it cannot meet before. Else it has asked nothing.
bool leaves_apart(const Accelerator& accelerator, const WorldRay& ray, RayWorkspace& work, RayHit& hit) {
  if (!accelerator.some_keep_apart()) return false;
  const std::uint32_t solid = accelerator.entered_apart(ray.start);
  if (solid == nothing) return false;
  Nearest query;
  query.start(accelerator, ray, work, hit);
  query.test(solid);
  return hit.found() && accelerator.is_in_room(solid, ray, query.limit());
}

/// As a hit there would have it.
double reach_of_plane(const WorldRay& ray, double last) {
  return last + company_width(ray, last, 0);
}

}  // namespace

template <class Kind>
void Accelerator::traverse_filtered(Kind& query) const {
  const WorldRay& ray = query.ray();
  const OutlinedRay outlined(*this, ray);
  const auto is_done = [&] { return query.limit() <= ray.t_min; };
  const auto test = [&](const Outline& outline, std::span<const OutlineAxis> axes) {
    const Judgement judgement = outlined.judge(outline, axes, query.limit());
    if (judgement == Judgement::missed) return;
    if constexpr (Kind::any_will_do) {
      if (judgement == Judgement::met) {
        query.settle();
        return;
      }
    }
    query.test(outline);
  };

  // A plane that is met bounds what else matters; where exactly is only asked if nothing is before it.
  constexpr bool planes_last = !Kind::any_will_do;
  for (const Outline& outline : unbounded_.list) {
    if (is_done()) break;
    if (planes_last && outline.kind == Outline::Kind::plane) {
      double last = 0;
      const Judgement judgement = outlined.judge(outline, unbounded_.axes, query.limit(), last);
      if (judgement == Judgement::met) query.set_limit(std::min(query.limit(), reach_of_plane(ray, last)));
    } else {
      test(outline, unbounded_.axes);
    }
  }
  if (!is_done()) {
    visit_boxes(ray, query.limit(), [&](std::uint32_t box) {
      test(bounded_.list[box], bounded_.axes);
      return query.limit();
    });
  }
  if (!planes_last) return;
  for (const Outline& outline : unbounded_.list) {
    if (outline.kind == Outline::Kind::plane) test(outline, unbounded_.axes);
  }
}

RayHit Accelerator::nearest(const WorldRay& ray, RayWorkspace& work) const {
  RayHit best;
  if (leaves_apart(*this, ray, work, best)) return best;
  Nearest query;
  query.start(*this, ray, work, best);
  traverse_filtered(query);
  if (best.has_company) best = gather_company(ray, best, work);
  return best;
}

bool Accelerator::any(const WorldRay& ray, RayWorkspace& work) const {
  Any query(*this, ray, work);
  traverse_filtered(query);
  return query.found;
}

RayHit Accelerator::gather_company(const WorldRay& ray, const RayHit& nearest, RayWorkspace& work) const {
  WorldRay piece = ray;
  piece.t_max =
      std::min(ray.t_max, std::nextafter(nearest.t + company_width(ray, nearest.t, nearest.error), infinity));
  std::vector<RayHit>& here = work.here;
  std::vector<RayHit>& near = work.near;
  here.clear();
  near.clear();
  all(piece, nullptr, near, work);
  std::sort(near.begin(), near.end(), [](const RayHit& a, const RayHit& b) {
    return std::tie(a.object, a.t, a.t_low) < std::tie(b.object, b.t, b.t_low);
  });
  const auto split = std::stable_partition(
      near.begin(), near.end(), [&](const RayHit& crossing) { return same_place(crossing, nearest); });
  here.assign(near.begin(), split);
  near.erase(near.begin(), split);
  if (here.empty()) return nearest;
  RayHit first = here.front();
  first.has_company = here.size() + near.size() > 1;
  return first;
}

void Accelerator::fill_packet(std::span<const WorldRay> rays, RayPacket& packet) const {
  packet.count = rays.size();
  packet.outwards = 0;
  // By component first, so that vectors are loaded and not put together lane by lane.
  enum Column { origin_x, direction_x = 3, begin = 6, certain_from, certain_to, limit, column_count };
  alignas(sizeof(Lanes)) std::array<std::array<double, packet_size>, column_count> columns;
  for (std::size_t i = 0; i < packet_size; ++i) {
    // What is beyond the last ray is made like it, so that no lane holds nonsense.
    const WorldRay& ray = rays[std::min(i, rays.size() - 1)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      columns[origin_x + axis][i] = ray.origin[static_cast<int>(axis)];
      columns[direction_x + axis][i] = ray.direction[static_cast<int>(axis)];
    }
    columns[begin][i] = ray.t_min;
    columns[certain_from][i] = farthest_start(ray);
    columns[certain_to][i] = std::min(certain_end(ray), largest_end);
    columns[limit][i] = ray.t_max;
    packet.start_surfaces[i] = ray.start.surface;
    packet.left_objects[i] = left_for_good(ray.start);
    packet.outwards |= static_cast<RayMask>(ray.start.side == Side::outside) << i;
  }
  for (std::size_t group = 0; group < RayPacket::group_count; ++group) {
    const auto lanes = [&](std::size_t column) {
      Lanes result;
      std::memcpy(&result, &columns[column][group * lane_count], sizeof result);
      return result;
    };
    OutlineLine<Lanes>& lines = packet.groups[group];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lines.origin[axis] = lanes(origin_x + axis);
      lines.direction[axis] = lanes(direction_x + axis);
    }
    lines.squared_speed = dot(lines.direction, lines.direction);
    lines.inverse_squared_speed = 1.0 / lines.squared_speed;
    lines.inverse_speed = sqrt(lines.inverse_squared_speed);
    lines.begin = lanes(begin);
    lines.certain_from = lanes(certain_from);
    lines.certain_to = lanes(certain_to);
    packet.limits[group] = lanes(limit);
  }
}

template <class Kind>
void Accelerator::traverse_filtered(RayPacket& packet, RayMask going, std::span<Kind> queries) const {
  const OutlinedPacket outlined(packet);
  const auto settle = [&](std::size_t ray) {
    packet.set_limit(ray, queries[ray].limit());
    if (queries[ray].limit() <= queries[ray].ray().t_min) going &= ~(RayMask{1} << ray);
  };
  /// Returns the rays whose limits it changed.
  const auto test = [&](const Outline& outline, std::span<const OutlineAxis> axes, RayMask rays) {
    const Verdict<RayMask> verdict = outlined.judge(outline, axes, rays);
    RayMask changed = 0;
    RayMask open = rays & ~verdict.missed;
    if constexpr (Kind::any_will_do) {
      open &= ~verdict.met;
      for_each_ray(verdict.met, [&](std::size_t ray) {
        queries[ray].settle();
        settle(ray);
      });
      changed = verdict.met;
    }
    for_each_ray(open, [&](std::size_t ray) {
      const double before = queries[ray].limit();
      queries[ray].test(outline);
      if (queries[ray].limit() == before) return;
      settle(ray);
      changed |= RayMask{1} << ray;
    });
    return changed;
  };

  constexpr bool planes_last = !Kind::any_will_do;
  for (const Outline& outline : unbounded_.list) {
    if (going == 0) break;
    if (planes_last && outline.kind == Outline::Kind::plane) {
      std::array<Lanes, RayPacket::group_count> last;
      for_each_ray(outlined.judge(outline, unbounded_.axes, going, last).met, [&](std::size_t ray) {
        const double reach =
            reach_of_plane(queries[ray].ray(), last[ray / lane_count][static_cast<int>(ray % lane_count)]);
        queries[ray].set_limit(std::min(queries[ray].limit(), reach));
        settle(ray);
      });
    } else {
      test(outline, unbounded_.axes, going);
    }
  }
  if (tree_ && going != 0) {
    if (std::optional<Shaft> shaft = Shaft::around(packet, bounded_box_)) {
      shaft_tree_.traverse(*shaft, [&](std::uint32_t box) {
        if (test(bounded_.list[box], bounded_.axes, going) != 0) shaft->set_limits(packet);
      });
    } else {
      tree_->traverse(packet, going, [&](std::uint32_t box, RayMask rays) {
        return test(bounded_.list[box], bounded_.axes, rays);
      });
    }
  }
  if (!planes_last) return;
  for (const Outline& outline : unbounded_.list) {
    if (outline.kind == Outline::Kind::plane) test(outline, unbounded_.axes, going);
  }
}

void Accelerator::nearest(std::span<const WorldRay> rays, std::span<RayHit> hits, RayWorkspace& work) const {
  RayMask open = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (!leaves_apart(*this, rays[i], work, hits[i])) open |= RayMask{1} << i;
  }
  if (open != 0) {
    RayPacket packet;
    fill_packet(rays, packet);
    std::array<Nearest, packet_size> queries;
    for_each_ray(open, [&](std::size_t i) { queries[i].start(*this, rays[i], work, hits[i]); });
    traverse_filtered(packet, open, std::span<Nearest>(queries));
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (hits[i].has_company) hits[i] = gather_company(rays[i], hits[i], work);
  }
  expect_surface_points(hits.first(rays.size()));
}

RayMask Accelerator::any(std::span<const WorldRay> rays, RayWorkspace& work) const {
  if (rays.empty()) return 0;
  RayPacket packet;
  fill_packet(rays, packet);
  std::array<Any, packet_size> queries;
  for (std::size_t i = 0; i < rays.size(); ++i) queries[i].start(*this, rays[i], work);
  traverse_filtered(packet, packet.all(), std::span<Any>(queries));
  RayMask found = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) found |= static_cast<RayMask>(queries[i].found) << i;
  return found;
}

}  // namespace crt::core
