// Rays, their starts and their answers lie in memory of the caller, which need not be aligned.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "capi/structs.hpp"
#include "crt/query.hpp"
#include "text/format.hpp"

namespace crt::capi {

/// Knows where each of many structs begins in memory of the caller, which need not be aligned.
template <class Byte>
class Places {
 public:
  /// A `stride` of 0 means one after the other. Throws for memory that cannot exist.
  Places(Byte* first, std::size_t stride, std::size_t size, std::size_t count, const char* argument)
      : first_(first), stride_(stride == 0 ? size : stride) {
    if (count > 0) require(first, argument);
    if (stride_ < size) {
      reject(argument, text::format("are {} bytes apart, but each has {}", stride_, size));
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

inline Ray to_ray(const std::byte* place) {
  Ray ray;
  std::memcpy(&ray, place, sizeof ray);
  return ray;
}

/// Copies points out of the caller's memory. Throws for one that is not finite, and names its
/// index.
inline std::vector<Vec3> to_points(const double* points, std::size_t stride, std::size_t count) {
  const Places<const std::byte> places(reinterpret_cast<const std::byte*>(points), stride,
                                       sizeof(Vec3), count, "points");
  std::vector<Vec3> copies(count);
  for (std::size_t i = 0; i < count; ++i) {
    Vec3& point = copies[i];
    std::memcpy(&point, places[i], sizeof point);
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z))
      reject(text::format("points[{}]", i), "must be finite");
  }
  return copies;
}

/// This is the number of rays that are asked at a time, and copied out of the caller's memory if
/// need be.
inline constexpr std::size_t piece_size = 512;

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
    const auto check = [&](std::size_t first, std::size_t last) {
      for_pieces(first, last, [&](std::size_t begin, std::span<const Ray> rays) {
        if (begin > first_wrong) return;
        const std::size_t index = first_invalid(rays);
        if (index == rays.size()) return;
        std::size_t known = first_wrong;
        while (begin + index < known && !first_wrong.compare_exchange_weak(known, begin + index)) {
        }
      });
    };
    if (count_ <= piece_size) {
      check(0, count_);
    } else {
      query_in_parallel(scene, count_, [&](RayQueries&, std::size_t first, std::size_t last) {
        check(first, last);
      });
    }
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
      throw Error(error.code(), text::format("rays[{}]: {}", index, error.what()), "rays");
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
                  text::format("{}[{}] must be of a hit in the same prepared scene", argument_,
                               first + index),
                  argument_);
    }
  }

 private:
  Places<const std::byte> places_;
  std::size_t count_;
  const char* argument_;
};

}  // namespace crt::capi
