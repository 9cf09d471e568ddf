// The driver takes rays through the stages: cull, filter, solve, commit. It is written once, over
// the number of rays that travel together and over what is asked of them.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/intersect/object_tests.hpp"

namespace crt::core {

namespace {

/// An ExactTests calls call(object) for each object, without a conservative test. Nothing changes
/// the limit of its ray.
template <class Test>
struct ExactTests {
  static constexpr bool from_near = false;

  const WorldRay& ray;
  RaySteps& steps;
  const Test& call;

  RayMask active() const { return mask_of(!(ray.t_max <= ray.t_min)); }
  RayMask test(const BoundingProxy& proxy, RayMask /*ray*/) {
    steps.step();
    call(proxy.object);
    return 0;
  }
};

/// Returns an exit whose error is the reach of its place, by which ends of several objects are
/// compared.
RayHit end_at_place(const CompiledScene& scene, const WorldRay& ray, RayHit exit) {
  if (exit.found()) exit.error = reach_of_place(scene, ray, exit);
  return exit;
}

}  // namespace

template <bool FromNear, class Visit>
[[gnu::always_inline]] inline void Accelerator::visit_boxes(const SingleRay& ray, RayMask,
                                                            const Visit& visit) const {
  if (tree_.empty()) return;
  const auto visit_box = [&](std::uint32_t box) {
    visit(box, 1);
    return ray.limits[0];
  };
  const WorldRay& source = ray.source;
  if (has_flat_box_list() && FlatBoxList::takes(ray, 1) != 0) {
    flat_box_list_.traverse(ray, visit_box);
  } else {
    BoxCaller caller(visit_box);
    tree_.traverse(source.origin, source.direction, source.t_min, ray.limits[0], FromNear, caller);
  }
}

template <bool FromNear, class Visit>
void Accelerator::visit_boxes(const RayPacket& packet, RayMask rays, const Visit& visit) const {
  if (tree_.empty()) return;
  const RayMask in_row = has_flat_box_list() ? FlatBoxList::takes(packet, rays) : 0;
  if (in_row != 0) flat_box_list_.traverse<FromNear>(packet, in_row, visit);
  if (rays == in_row) return;
  PacketCaller<Visit> caller(visit);
  tree_.traverse(packet, rays & ~in_row, caller);
}

template <class Real, class Tests>
[[gnu::always_inline]] inline void Accelerator::traverse(const RayPacketOf<Real>& packet,
                                                         Tests& tests) const {
  // A plane that is met bounds what else matters. Where exactly is only asked if nothing is before
  // it.
  constexpr bool planes_last = Tests::from_near;
  for (const BoundingProxy& proxy : unbounded_.list) {
    if (tests.active() == 0) return;
    if constexpr (planes_last) {
      if (proxy.is_met_with_solid()) {
        tests.limit_by(proxy);
        continue;
      }
    }
    tests.test(proxy, tests.active());
  }
  if (const RayMask pending = tests.active(); pending != 0) {
    visit_boxes<Tests::from_near>(packet, pending, [&](std::uint32_t box, RayMask rays) {
      return tests.test(bounded_.list[box], rays);
    });
  }
  if (!planes_last) return;
  for (const BoundingProxy& proxy : unbounded_.list) {
    if (proxy.is_met_with_solid()) tests.test(proxy, tests.active());
  }
}

template <class Real, class Asked>
[[gnu::always_inline]] inline RayMask Accelerator::follow(const Rays<Real>& rays,
                                                          const Starts<Real>& starts, RayMask some,
                                                          const Asked& asked,
                                                          RayWorkspace& work) const {
  RayPacketOf<Real> packet(rays, starts, some);
  ObjectTests<Real, Asked> tests(*this, packet, some, asked, work);
  traverse(packet, tests);
  return tests.active();
}

template <class Test>
void Accelerator::test_all(const WorldRay& ray, RayWorkspace& work, const Test& test) const {
  const PacketStartsOf<1> unused;
  const SingleRay packet(ray, unused, 1);
  work.csg.steps.begin_ray();
  ExactTests<Test> tests{ray, work.csg.steps, test};
  traverse(packet, tests);
}

template <class Test>
void Accelerator::test_around(const WorldRay& ray, RayWorkspace& work, const Test& test) const {
  // What holds the start has a box around it, so the ray need not be followed any farther.
  WorldRay here = ray;
  here.t_min = 0;
  here.t_max = std::numeric_limits<double>::min();
  test_all(here, work, test);
}

PacketStartsOf<1> Accelerator::noted_starts(const WorldRay& ray, RayMask) const {
  const StartPoint& start = ray.start;
  PacketStartsOf<1> starts;
  if (start.leaf == invalid_index) return starts;
  starts.surfaces[0] = start.surface;
  starts.leaves[0] = start.leaf;
  starts.left_objects[0] = left_for_good(start);
  starts.on_surface = 1;
  starts.outwards = mask_of(start.side == Side::outside);
  starts.left_some = mask_of(starts.left_objects[0] != invalid_index);
  return starts;
}

PacketStarts Accelerator::noted_starts(const RayBatch& rays, RayMask some) const {
  PacketStarts starts;
  // Neighbours start on the same face more often than not.
  StartPoint face;
  std::uint32_t left = invalid_index;
  RayMask on_face = 0;
  const auto add_face = [&] {
    if (face.leaf == invalid_index) return;
    starts.on_surface |= on_face;
    if (face.side == Side::outside) starts.outwards |= on_face;
    if (left != invalid_index) starts.left_some |= on_face;
  };
  for_each_ray(some & rays.with_starts, [&](std::size_t i) {
    const StartPoint& start = rays.starts[i];
    if (!start.is_to_same_side(face)) {
      add_face();
      face = start;
      left = left_for_good(start);
      on_face = 0;
    }
    on_face |= RayMask{1} << i;
    starts.surfaces[i] = start.surface;
    starts.leaves[i] = start.leaf;
    starts.left_objects[i] = left;
  });
  add_face();
  return starts;
}

template <class Real>
void Accelerator::find_nearest(const Rays<Real>& rays, RayMask some, std::span<RayHit> hits,
                               RayWorkspace& work, PassingRays kind) const {
  follow<Real>(rays, noted_starts(rays, some), some, AskNearest{hits, kind}, work);
  for_each_ray(some, [&](std::size_t i) {
    if (hits[i].has_coincident) hits[i] = gather_coincident(rays.ray(i), hits[i], kind, work);
  });
}

template <class Real>
RayMask Accelerator::leave_by_tests(const BoundingProxy& solid, const Rays<Real>& rays,
                                    RayMask some, std::span<RayHit> hits,
                                    RayWorkspace& work) const {
  const Starts<Real> starts = noted_starts(rays, some);
  RayPacketOf<Real> packet(rays, starts, some);
  const AskNearest asked{hits};
  ObjectTests<Real, AskNearest> tests(*this, packet, some, asked, work);
  tests.test(solid, some);
  const Bounds margin = box_around(solid.object);
  RayMask done = 0;
  for_each_ray(some, [&](std::size_t i) {
    const WorldRay& ray = rays.ray(i);
    const PlainRay<double> line = plain_ray(ray);
    const bool leaves = hits[i].found() && is_within(margin, line, ray.t_min) &&
                        is_within(margin, line, packet.limit(i));
    if (!leaves) hits[i] = {};
    done |= mask_of(leaves) << i;
  });
  return done;
}
template RayMask Accelerator::leave_by_tests<double>(const BoundingProxy&, const Rays<double>&,
                                                     RayMask, std::span<RayHit>,
                                                     RayWorkspace&) const;
template RayMask Accelerator::leave_by_tests<Lanes>(const BoundingProxy&, const Rays<Lanes>&,
                                                    RayMask, std::span<RayHit>,
                                                    RayWorkspace&) const;

RayHit Accelerator::nearest(const WorldRay& ray, RayWorkspace& work, PassingRays kind) const {
  RayHit hit;
  if (isolated_.empty() || leave_isolated(ray, hit, work) == 0)
    find_nearest<double>(ray, 1, {&hit, 1}, work, kind);
  return hit;
}

bool Accelerator::any(const WorldRay& ray, RayWorkspace& work, PassingRays kind) const {
  return follow<double>(ray, noted_starts(ray), 1, AskAny{kind}, work) == 0;
}

void Accelerator::all(const WorldRay& ray, std::vector<RayHit>& out, RayWorkspace& work) const {
  All query(*this, ray, work, nullptr, out);
  test_all(ray, work, [&](std::uint32_t object) { query.test(object); });
}

void Accelerator::containing_solids(const WorldRay& ray, std::vector<RayHit>& out,
                                    RayWorkspace& work) const {
  test_around(ray, work, [&](std::uint32_t object) {
    ExitQuery query(*this, ray, work);
    query.test(object);
    if (!query.result.inside) return;
    out.push_back(end_at_place(compiled_, ray, query.result.exit));
    if (!out.back().found())
      out.back() = {.object = object, .leaf = this->object(object).first_leaf};
  });
}

ContainingSolid Accelerator::innermost(const Vec3& point, RayWorkspace& work) const {
  // Along this direction the order of solids is found. It runs along no face that people make.
  const WorldRay line{.origin = point, .direction = {0.7390851, 0.5671433, 0.3628943}};
  ContainingSolid innermost;
  double nearest = infinity;
  test_around(line, work, [&](std::uint32_t object) {
    Located query(*this, line, work);
    query.test(object);
    if (query.leaf == invalid_index) return;
    const bool is_inner = innermost.object == invalid_index || query.leaves_at < nearest ||
                          (query.leaves_at == nearest && object > innermost.object);
    if (!is_inner) return;
    innermost = {object, query.leaf};
    nearest = query.leaves_at;
  });
  return innermost;
}

SolidExit Accelerator::find_exit(const WorldRay& ray, std::uint32_t object,
                                 RayWorkspace& work) const {
  work.csg.steps.begin_ray();
  ExitQuery query(*this, ray, work);
  query.test(object);
  query.result.exit = end_at_place(compiled_, ray, query.result.exit);
  return query.result;
}

bool Accelerator::pay_together(const RayBatch& rays, RayMask some, Packets packets) const {
  if (packets == Packets::always) return some != 0;
  // A flat list of boxes is looked at for any rays as for those of like directions.
  return has_flat_box_list() ? std::popcount(some) >= fewest_together : go_together(rays, some);
}

void Accelerator::nearest_each(const RayBatch& rays, RayMask some,
                               std::span<RayHit, packet_size> hits, Packets packets,
                               RayWorkspace& work, PassingRays kind) const {
  for_each_ray(some, [&](std::size_t i) { hits[i] = {}; });
  const RayMask pending = some & ~leave_isolated(rays, some, hits, work);
  if (pay_together(rays, pending, packets))
    return find_nearest<Lanes>(rays, pending, hits, work, kind);
  for_each_ray(pending, [&](std::size_t i) {
    find_nearest<double>(rays.ray(i), 1, hits.subspan(i, 1), work, kind);
  });
}

RayMask Accelerator::any_each(const RayBatch& rays, const PacketStarts& starts, RayMask some,
                              Packets packets, RayWorkspace& work, PassingRays kind) const {
  if (pay_together(rays, some, packets))
    return some & ~follow<Lanes>(rays, starts, some, AskAny{kind}, work);
  RayMask found = 0;
  for_each_ray(some, [&](std::size_t i) { found |= mask_of(any(rays.ray(i), work, kind)) << i; });
  return found;
}

LightPaths Accelerator::paths_to_light(const RayBatch& rays, const PacketStarts& starts,
                                       RayMask some, const Opacity& opacity, Packets packets,
                                       RayWorkspace& work, PassingRays kind) const {
  for_each_ray(some, [&](std::size_t i) { work.on_paths[i].clear(); });
  const std::span found(work.on_paths);
  RayMask reaching = 0;
  if (pay_together(rays, some, packets)) {
    const AskLight asked{{kind}, opacity, found};
    reaching = follow<Lanes>(rays, starts, some, asked, work);
  } else {
    for_each_ray(some, [&](std::size_t i) {
      const WorldRay ray = rays.ray(i);
      const AskLight asked{{kind}, opacity, found.subspan(i, 1)};
      reaching |= follow<double>(ray, noted_starts(ray), 1, asked, work) << i;
    });
  }
  LightPaths paths{.blocked = some & ~reaching};
  for_each_ray(reaching, [&](std::size_t i) { paths.filtered |= mask_of(!found[i].empty()) << i; });
  return paths;
}

RayHit Accelerator::gather_coincident(const WorldRay& ray, const RayHit& nearest, PassingRays kind,
                                      RayWorkspace& work) const {
  WorldRay piece = ray;
  piece.t_max = std::min(
      ray.t_max, std::nextafter(nearest.t + coincidence_tolerance(ray, nearest.t, nearest.error),
                                std::numeric_limits<double>::infinity()));
  std::vector<RayHit>& here = work.here;
  std::vector<RayHit>& near = work.near;
  here.clear();
  near.clear();
  all(piece, near, work);
  if ((kind & kinds_that_pass_) != 0) {
    std::erase_if(near, [&](const RayHit& hit) {
      return (compiled_.objects[hit.object].passed_by & kind) != 0;
    });
  }
  sort(ray, near, work);
  RayHit first = near.empty() ? nearest : near.front();
  const auto is_there = [&](const RayHit& crossing) { return have_one_t(crossing, first); };
  std::sort(near.begin(), near.end(), [](const RayHit& a, const RayHit& b) {
    return std::tie(a.object, a.t, a.t_low) < std::tie(b.object, b.t, b.t_low);
  });
  const auto split = std::stable_partition(near.begin(), near.end(), is_there);
  here.assign(near.begin(), split);
  near.erase(near.begin(), split);
  if (here.empty()) return nearest;
  first = here.front();
  const double reach = first.t + tolerance_at_start(ray, first.t, first.error);
  std::erase_if(near, [&](const RayHit& crossing) { return crossing.t > reach; });
  first.has_coincident = here.size() + near.size() > 1;
  return first;
}

}  // namespace crt::core
