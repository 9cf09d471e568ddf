// This file implements the ray queries of the C interface. Rays and hits stay in the caller's
// memory.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
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
static_assert(sizeof(crt_start) == 16 && sizeof(crt::RayStart) == sizeof(crt_start));
static_assert(sizeof(crt_full_hit) == 112 && sizeof(crt::FullHit) == sizeof(crt_full_hit));
static_assert(std::is_standard_layout_v<crt::FullHit> &&
              std::is_trivially_copyable_v<crt::FullHit>);
static_assert(offsetof(crt_full_hit, position) == 8 && offsetof(crt::FullHit, position) == 8);
static_assert(offsetof(crt_full_hit, normal) == 32 && offsetof(crt::FullHit, normal) == 32);
static_assert(offsetof(crt_full_hit, u) == 56 && offsetof(crt::FullHit, u) == 56);
static_assert(offsetof(crt_full_hit, v) == 64 && offsetof(crt::FullHit, v) == 64);
static_assert(offsetof(crt_full_hit, entity_id) == 72 && offsetof(crt::FullHit, entity_id) == 72);
static_assert(offsetof(crt_full_hit, part_id) == 76 && offsetof(crt::FullHit, part_id) == 76);
static_assert(offsetof(crt_full_hit, face) == 80 && offsetof(crt::FullHit, face) == 80);
static_assert(offsetof(crt_full_hit, flags) == 84 && offsetof(crt::FullHit, side) == 84);
static_assert(offsetof(crt_full_hit, user) == 88 && offsetof(crt::FullHit, user) == 88);
static_assert(offsetof(crt_full_hit, start) == 96 && offsetof(crt::FullHit, start) == 96);
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

/// Starts are those of rays, or the ends. There may be none.
class Starts {
 public:
  Starts(const crt_start* starts, std::size_t stride, std::size_t count, const char* argument)
      : places_(reinterpret_cast<const std::byte*>(starts), stride, sizeof(crt_start),
                starts == nullptr ? 0 : count, argument),
        count_(starts == nullptr ? 0 : count),
        argument_(argument) {}

  /// A Piece has those of some rays, or none.
  struct Piece {
    std::array<RayStart, piece_size> starts;
    std::size_t count = 0;

    std::span<const RayStart> all() const { return std::span(starts).first(count); }
  };
  void copy(std::size_t first, std::size_t count, Piece& piece) const {
    piece.count = count_ == 0 ? 0 : count;
    for (std::size_t i = 0; i < piece.count; ++i)
      std::memcpy(&piece.starts[i], places_[first + i], sizeof(RayStart));
  }

  /// Throws if any is not of the scene, and names the first of them.
  void validate_all(const PreparedScene& scene) const {
    Piece piece;
    for (std::size_t first = 0; first < count_; first += piece_size) {
      copy(first, std::min(piece_size, count_ - first), piece);
      const std::size_t index = first_invalid(scene, piece.all());
      if (index == piece.count) continue;
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{}[{}] must be of a hit in the same prepared scene", argument_,
                              first + index),
                  argument_);
    }
  }

 private:
  Places<const std::byte> places_;
  std::size_t count_;
  const char* argument_;
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

crt_status crt_trace(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                     const crt_start* starts, size_t start_stride, size_t count, crt_full_hit* hits,
                     size_t hit_stride) {
  return guarded([&] {
    require(prepared, "prepared");
    const Rays questions(rays, ray_stride, count);
    const Starts begins(starts, start_stride, count, "starts");
    const Places<std::byte> answers(reinterpret_cast<std::byte*>(hits), hit_stride,
                                    sizeof(crt_full_hit), count, "hits");
    begins.validate_all(prepared->value);
    questions.answer_in_place(
        prepared->value, [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
          Starts::Piece of_piece;
          begins.copy(begin, piece.size(), of_piece);
          std::array<crt::FullHit, piece_size> found;
          queries.trace(piece, of_piece.all(), found);
          for (std::size_t i = 0; i < piece.size(); ++i) {
            std::memcpy(answers[begin + i], &found[i], sizeof(crt_full_hit));
          }
        });
  });
}

crt_status crt_blocked(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                       const crt_start* starts, const crt_start* ends, size_t start_stride,
                       size_t count, uint8_t* blocked) {
  return guarded([&] {
    require(prepared, "prepared");
    const Rays questions(rays, ray_stride, count);
    const Starts begins(starts, start_stride, count, "starts");
    const Starts finishes(ends, start_stride, count, "ends");
    if (count > 0) require(blocked, "blocked");
    begins.validate_all(prepared->value);
    finishes.validate_all(prepared->value);
    const auto answers = std::make_unique_for_overwrite<bool[]>(count);
    questions.answer(prepared->value, [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
      Starts::Piece first;
      Starts::Piece last;
      begins.copy(begin, piece.size(), first);
      finishes.copy(begin, piece.size(), last);
      queries.blocked(piece, first.all(), last.all(), std::span(&answers[begin], piece.size()));
    });
    std::transform(answers.get(), answers.get() + count, blocked,
                   [](bool hit) { return hit ? 1 : 0; });
  });
}

crt_status crt_trace_all(crt_prepared* prepared, const crt_ray* rays, size_t ray_stride,
                         const crt_start* starts, size_t start_stride, size_t count,
                         crt_full_hit* hits, size_t capacity, size_t* first) {
  return guarded([&] {
    require(prepared, "prepared");
    const Rays questions(rays, ray_stride, count);
    const Starts begins(starts, start_stride, count, "starts");
    if (capacity > 0) require(hits, "hits");
    require(first, "first");
    begins.validate_all(prepared->value);
    std::vector<std::vector<crt::FullHit>> found(count);
    questions.answer(prepared->value, [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
      Starts::Piece of_piece;
      begins.copy(begin, piece.size(), of_piece);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const crt::RayStart start = of_piece.count == 0 ? crt::RayStart{} : of_piece.starts[i];
        queries.trace_all(piece[i], start, found[begin + i]);
      }
    });
    std::size_t total = 0;
    for (const auto& of_ray : found) total += of_ray.size();
    if (total > capacity) {
      first[count] = total;
      throw crt::Error(crt::ErrorCode::limit,
                       fmt::format("there are {} crossings, but capacity is {}", total, capacity),
                       "capacity");
    }
    std::size_t place = 0;
    for (std::size_t i = 0; i < count; ++i) {
      first[i] = place;
      if (!found[i].empty())
        std::memcpy(hits + place, found[i].data(), found[i].size() * sizeof(crt_full_hit));
      place += found[i].size();
    }
    first[count] = place;
  });
}

crt_status crt_locate(crt_prepared* prepared, const double* points, size_t stride, size_t count,
                      uint32_t* entity_ids, uint32_t* part_ids, uint64_t* users) {
  return guarded([&] {
    require(prepared, "prepared");
    const Places<const std::byte> places(reinterpret_cast<const std::byte*>(points), stride,
                                         sizeof(crt::Vec3), count, "points");
    if (count > 0) require(entity_ids, "entity_ids");
    std::vector<crt::Vec3> questions(count);
    for (std::size_t i = 0; i < count; ++i) {
      crt::Vec3& point = questions[i];
      std::memcpy(&point, places[i], sizeof point);
      if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
        reject(fmt::format("points[{}]", i), "must be finite");
    }
    std::vector<crt::Location> answers(count);
    crt::query_in_parallel(
        prepared->value, count,
        [&](crt::RayQueries& queries, std::size_t first, std::size_t last) {
          queries.locate(std::span(questions).subspan(first, last - first),
                         std::span(answers).subspan(first, last - first));
        });
    for (std::size_t i = 0; i < count; ++i) {
      entity_ids[i] = answers[i].entity_id;
      if (part_ids != nullptr) part_ids[i] = answers[i].part_id;
      if (users != nullptr) users[i] = answers[i].user;
    }
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
