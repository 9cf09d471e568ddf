// Which triangles of a mesh meet others is found, beside the edges and corners that they share.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/compact_bvh.hpp"
#include "core/geometry/mesh/triangles.hpp"

namespace crt::core {

struct MeshCorners;

/// A SelfMeetings finds which triangles are separate: that no other one meets them but in corners
/// and edges that they share, as facing.hpp has it.
class SelfMeetings {
 public:
  explicit SelfMeetings(const MeshTriangles& mesh);

  bool is_separate(std::uint32_t triangle) const {
    return lowest_met_[triangle].load(std::memory_order_relaxed) == none;
  }
  /// Returns the lowest number of a triangle that one may meet and that has other corners, if there
  /// is any.
  std::optional<std::uint32_t> met_by(std::uint32_t triangle) const {
    const std::uint32_t met = lowest_met_[triangle].load(std::memory_order_relaxed);
    return met < repeated ? std::optional(met) : std::nullopt;
  }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  static constexpr std::uint32_t repeated = none - 1;  ///< it meets one with the same corners

  void gather_leaves();
  void test(BvhChild leaf, std::vector<std::uint32_t>& open, std::vector<MeshCorners>& corners);
  void test(const MeshCorners& one, const MeshCorners& other);
  void lower(std::uint32_t triangle, std::uint32_t met);

  const MeshTriangles& mesh_;
  std::vector<BvhChild> leaves_;
  std::vector<std::atomic<std::uint32_t>> lowest_met_;
};

}  // namespace crt::core
