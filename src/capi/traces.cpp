// This file implements what the C interface has for programs that trace rays themselves: hits that
// rays continue from, and in what points are.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "capi/ray_arrays.hpp"
#include "text/format.hpp"

// The layout is frozen for ever, and equal in C and C++.
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

using namespace crt::capi;

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
    questions.answer_in_place(prepared->value,
                              [&](crt::RayQueries& queries, std::size_t begin, auto piece) {
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
      throw crt::Error(
          crt::ErrorCode::limit,
          crt::text::format("there are {} crossings, but capacity is {}", total, capacity),
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
    const std::vector<crt::Vec3> questions = to_points(points, stride, count);
    if (count > 0) require(entity_ids, "entity_ids");
    std::vector<crt::Location> answers(count);
    crt::query_in_parallel(prepared->value, count,
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
