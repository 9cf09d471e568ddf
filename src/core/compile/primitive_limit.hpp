// The number of primitives in a scene is limited, so that preparing it does not take all memory of
// the machine.
#pragma once

#include <cstdint>

#include "core/compile/instancing.hpp"
#include "crt/settings.hpp"

namespace crt::core {

/// Returns the bytes that a primitive may take while it is prepared. For a million boxes 1.3 kB
/// were measured, and for solids in a tree 2.6 kB. A sphere by itself takes 0.5 kB.
inline constexpr std::uint64_t bytes_to_prepare(Precision precision) {
  return precision == Precision::exact ? 2700 : 1350;
}

/// This is what an instance of something shared may take.
inline constexpr std::uint64_t bytes_of_instance = 512;

/// A PrimitiveLimit says how many primitives a scene may have. An instance counts as one.
class PrimitiveLimit {
 public:
  /// Faces, leaves and nodes have numbers of 32 bits, and a primitive may have some of each.
  static constexpr std::uint64_t max_numbered = std::uint64_t{1} << 25;

  /// Sets no limit.
  PrimitiveLimit() = default;
  /// If `most` is 0, the limit is what there is memory for.
  PrimitiveLimit(Precision precision, std::uint64_t most)
      : is_limited_(true), precision_(precision), most_(most) {}

  /// Throws Error (limit) if that is too many.
  void check(const Instancing::Count& count) const;

 private:
  bool is_limited_ = false;
  Precision precision_ = Precision::standard;
  std::uint64_t most_ = 0;
};

}  // namespace crt::core
