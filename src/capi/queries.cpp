// This file implements the ray queries of the C interface. Rays and hits stay in the caller's
// memory.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "capi/ray_arrays.hpp"

// The layout is frozen for ever: programs and arrays of numbers depend on it.
static_assert(sizeof(crt_ray) == 64 && alignof(crt_ray) == alignof(double));
static_assert(offsetof(crt_ray, origin) == 0 && offsetof(crt_ray, direction) == 24);
static_assert(offsetof(crt_ray, t_min) == 48 && offsetof(crt_ray, t_max) == 56);
static_assert(sizeof(crt_hit) == 56 && alignof(crt_hit) == alignof(double));
static_assert(offsetof(crt_hit, t) == 0 && offsetof(crt_hit, normal) == 8);
static_assert(offsetof(crt_hit, u) == 32 && offsetof(crt_hit, v) == 40);
static_assert(offsetof(crt_hit, entity_id) == 48 && offsetof(crt_hit, flags) == 52);
// The C and C++ structs have equal layouts, so that rays and hits can be copied as a whole.
static_assert(sizeof(crt::Ray) == sizeof(crt_ray) && std::is_trivially_copyable_v<crt::Ray>);
static_assert(std::is_standard_layout_v<crt::Ray> && sizeof(crt::Vec3) == sizeof(crt_ray::origin));
static_assert(offsetof(crt::Ray, origin) == offsetof(crt_ray, origin));
static_assert(offsetof(crt::Ray, direction) == offsetof(crt_ray, direction));
static_assert(offsetof(crt::Ray, t_min) == offsetof(crt_ray, t_min));
static_assert(offsetof(crt::Ray, t_max) == offsetof(crt_ray, t_max));
static_assert(sizeof(crt::PlainHit) == sizeof(crt_hit) &&
              std::is_trivially_copyable_v<crt::PlainHit>);
static_assert(std::is_standard_layout_v<crt::PlainHit>);
static_assert(offsetof(crt::PlainHit, t) == offsetof(crt_hit, t));
static_assert(offsetof(crt::PlainHit, normal) == offsetof(crt_hit, normal));
static_assert(offsetof(crt::PlainHit, u) == offsetof(crt_hit, u));
static_assert(offsetof(crt::PlainHit, v) == offsetof(crt_hit, v));
static_assert(offsetof(crt::PlainHit, entity_id) == offsetof(crt_hit, entity_id));
static_assert(offsetof(crt::PlainHit, side) == offsetof(crt_hit, flags));
static_assert(sizeof(crt_hit_part) == 32 && offsetof(crt_hit_part, u) == 16);
static_assert(static_cast<int>(crt::HitSide::entering) == CRT_HIT_ENTERING);
static_assert(static_cast<int>(crt::HitSide::leaving) == CRT_HIT_BACKFACE);

namespace crt::capi {

namespace {

crt_hit to_hit(const Hit& hit) {
  return {.t = hit.t,
          .normal = {hit.normal.x, hit.normal.y, hit.normal.z},
          .u = hit.u,
          .v = hit.v,
          .entity_id = hit.entity_id,
          .flags = hit.entering ? CRT_HIT_ENTERING : CRT_HIT_BACKFACE};
}

crt_hit_part to_part(const HitPart& part) {
  return {.entity_id = part.entity_id,
          .part_id = part.part_id,
          .face = part.face,
          .reserved = 0,
          .u = part.u,
          .v = part.v};
}

}  // namespace

}  // namespace crt::capi

using namespace crt::capi;

crt_status crt_intersect(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                         size_t count, crt_hit* hits, size_t hit_stride) {
  return guarded([&] {
    require(prepared, "prepared");
    const Rays questions(rays, ray_stride, count);
    const Places<std::byte> answers(reinterpret_cast<std::byte*>(hits), hit_stride, sizeof(crt_hit),
                                    count, "hits");
    questions.answer_in_place(prepared->value,
                              [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
                                if (answers.are_array_of<crt::PlainHit>()) {
                                  auto* place = reinterpret_cast<crt::PlainHit*>(answers[begin]);
                                  queries.intersect(piece, std::span(place, piece.size()));
                                  return;
                                }
                                std::array<crt::PlainHit, piece_size> found;
                                queries.intersect(piece, found);
                                for (std::size_t i = 0; i < piece.size(); ++i) {
                                  std::memcpy(answers[begin + i], &found[i], sizeof(crt_hit));
                                }
                              });
  });
}

crt_status crt_distances(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                         size_t count, double* distances, uint32_t* entity_ids) {
  return guarded([&] {
    require(prepared, "prepared");
    const Rays questions(rays, ray_stride, count);
    if (count > 0) require(distances, "distances");
    const auto t = std::make_unique_for_overwrite<double[]>(count);
    const auto ids =
        std::make_unique_for_overwrite<std::uint32_t[]>(entity_ids != nullptr ? count : 0);
    questions.answer(prepared->value, [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
      const std::size_t asked_ids = entity_ids != nullptr ? piece.size() : 0;
      queries.distances(piece, std::span(&t[begin], piece.size()),
                        std::span(ids.get() + begin, asked_ids));
    });
    std::copy_n(t.get(), count, distances);
    if (entity_ids != nullptr) std::copy_n(ids.get(), count, entity_ids);
  });
}

crt_status crt_occluded(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                        size_t count, uint8_t* occluded) {
  return guarded([&] {
    require(prepared, "prepared");
    const Rays questions(rays, ray_stride, count);
    if (count > 0) require(occluded, "occluded");
    const auto answers = std::make_unique_for_overwrite<bool[]>(count);
    questions.answer(prepared->value, [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
      queries.occluded(piece, std::span(&answers[begin], piece.size()));
    });
    std::transform(answers.get(), answers.get() + count, occluded,
                   [](bool hit) { return hit ? 1 : 0; });
  });
}

crt_status crt_crossings(crt_prepared* prepared, const crt_ray* ray, crt_hit* hits, size_t capacity,
                         size_t* count) {
  return guarded([&] {
    require(prepared, "prepared");
    require(ray, "ray");
    if (capacity > 0) require(hits, "hits");
    require(count, "count");
    const std::vector<crt::Hit> found =
        crt::crossings(prepared->value, to_ray(reinterpret_cast<const std::byte*>(ray)));
    for (std::size_t i = 0; i < found.size() && i < capacity; ++i) hits[i] = to_hit(found[i]);
    *count = found.size();
  });
}

crt_status crt_hit_parts(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                         size_t count, crt_hit_part* parts, size_t part_stride) {
  return guarded([&] {
    require(prepared, "prepared");
    const Rays questions(rays, ray_stride, count);
    const Places<std::byte> answers(reinterpret_cast<std::byte*>(parts), part_stride,
                                    sizeof(crt_hit_part), count, "parts");
    questions.answer_in_place(prepared->value,
                              [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
                                std::array<crt::HitPart, piece_size> found;
                                queries.parts(piece, found);
                                for (std::size_t i = 0; i < piece.size(); ++i) {
                                  const crt_hit_part part = to_part(found[i]);
                                  std::memcpy(answers[begin + i], &part, sizeof part);
                                }
                              });
  });
}

crt_status crt_camera_rays(crt_prepared* prepared, const double* xy, size_t count, crt_ray* rays,
                           size_t ray_stride) {
  return guarded([&] {
    require(prepared, "prepared");
    if (count == 0) return;
    require(xy, "xy");
    const Places<std::byte> answers(reinterpret_cast<std::byte*>(rays), ray_stride, sizeof(crt_ray),
                                    count, "rays");
    std::vector<std::array<double, 2>> places(count);
    std::memcpy(places.data(), xy, count * sizeof places[0]);
    std::vector<crt::Ray> found(count);
    crt::camera_rays(prepared->value, places, found);
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(answers[i], &found[i], sizeof(crt_ray));
    }
  });
}
