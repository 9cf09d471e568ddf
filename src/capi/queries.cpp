// This file implements the ray queries of the C interface. Rays and hits stay in the caller's
// memory.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "capi/structs.hpp"
#include "crt/query.hpp"

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

/// Knows where each of many structs begins in memory of the caller, which need not be aligned.
template <class Byte>
class Places {
 public:
  /// A `stride` of 0 means one after the other. Throws for memory that cannot exist.
  Places(Byte* first, std::size_t stride, std::size_t size, std::size_t count, const char* argument)
      : first_(first), stride_(stride == 0 ? size : stride) {
    if (count > 0) require(first, argument);
    if (stride_ < size) {
      reject(argument, fmt::format("are {} bytes apart, but each has {}", stride_, size));
    }
    if (count > std::numeric_limits<std::size_t>::max() / 2 / stride_) {
      reject(argument, "are more than memory can hold");
    }
  }

  Byte* operator[](std::size_t index) const { return first_ + index * stride_; }

  /// Says whether they form an array of T without gaps, aligned as T must be.
  template <class T>
  bool are_array_of() const {
    return stride_ == sizeof(T) && reinterpret_cast<std::uintptr_t>(first_) % alignof(T) == 0;
  }

 private:
  Byte* first_;
  std::size_t stride_;
};

Ray to_ray(const std::byte* place) {
  Ray ray;
  std::memcpy(&ray, place, sizeof ray);
  return ray;
}

/// This is the number of rays that are asked at a time, and copied out of the caller's memory if
/// need be.
constexpr std::size_t piece_size = 512;

class Rays {
 public:
  Rays(const crt_ray* rays, std::size_t stride, std::size_t count)
      : places_(reinterpret_cast<const std::byte*>(rays), stride, sizeof(crt_ray), count, "rays"),
        count_(count) {}

  /// Calls ask(begin, rays) for piece after piece of the rays first ... last - 1.
  template <class Ask>
  void for_pieces(std::size_t first, std::size_t last, const Ask& ask) const {
    const bool in_place = places_.are_array_of<Ray>();
    std::vector<Ray> copies(in_place ? 0 : std::min(piece_size, last - first));
    for (std::size_t begin = first; begin < last; begin += piece_size) {
      const std::size_t count = std::min(piece_size, last - begin);
      if (in_place) {
        ask(begin, std::span(reinterpret_cast<const Ray*>(places_[begin]), count));
        continue;
      }
      for (std::size_t i = 0; i < count; ++i)
        std::memcpy(&copies[i], places_[begin + i], sizeof(Ray));
      ask(begin, std::span<const Ray>(copies).first(count));
    }
  }

  /// Throws if any ray is invalid, and names the first of them.
  void validate_all(const PreparedScene& scene) const {
    std::atomic<std::size_t> first_wrong = count_;
    query_in_parallel(scene, count_, [&](RayQueries&, std::size_t first, std::size_t last) {
      for_pieces(first, last, [&](std::size_t begin, std::span<const Ray> rays) {
        if (begin > first_wrong) return;
        const std::size_t index = first_invalid(rays);
        if (index == rays.size()) return;
        std::size_t known = first_wrong;
        while (begin + index < known && !first_wrong.compare_exchange_weak(known, begin + index)) {
        }
      });
    });
    if (first_wrong < count_) throw_error_of(first_wrong);
  }

  /// Checks all rays. Then it calls ask(queries, begin, rays) for pieces of them, whose answers may
  /// take the rays' places.
  template <class Ask>
  void answer_in_place(const PreparedScene& scene, const Ask& ask) const {
    validate_all(scene);
    ask_all(scene, ask);
  }

  /// Calls ask(queries, begin, rays) for pieces of all of them, some before others have been
  /// checked. The caller may use the answers only after this returns without having thrown. This
  /// saves a pass over all rays for the check.
  template <class Ask>
  void answer(const PreparedScene& scene, const Ask& ask) const {
    try {
      ask_all(scene, ask);
    } catch (const Error&) {
      validate_all(scene);  // finds which of them is the first
      throw;
    }
  }

 private:
  template <class Ask>
  void ask_all(const PreparedScene& scene, const Ask& ask) const {
    query_in_parallel(scene, count_, [&](RayQueries& queries, std::size_t first, std::size_t last) {
      for_pieces(first, last,
                 [&](std::size_t begin, std::span<const Ray> rays) { ask(queries, begin, rays); });
    });
  }

  [[noreturn]] void throw_error_of(std::size_t index) const {
    try {
      validate(to_ray(places_[index]));
    } catch (const Error& error) {
      throw Error(error.code(), fmt::format("rays[{}]: {}", index, error.what()), "rays");
    }
    throw Error(ErrorCode::invalid_argument, "rays changed while they were asked", "rays");
  }

  Places<const std::byte> places_;
  std::size_t count_;
};

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
