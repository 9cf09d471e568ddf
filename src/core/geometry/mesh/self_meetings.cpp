#include "core/geometry/mesh/self_meetings.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "core/geometry/triangle/triangle.hpp"
#include "core/math/vector.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

/// A MeshCorners is a triangle as pairs are tested.
struct MeshCorners {
  std::uint32_t number;
  MeshTriangles::PlaneOf plane;
  TriangleIndices indices;
  std::array<Vec3, 3> places;
  Bounds box;

  MeshCorners(const MeshTriangles& mesh, const MeshTriangles::Placed& placed)
      : number(placed.number), plane(placed.plane), indices(placed.corners) {
    const auto [a, b, c, material] = mesh.corners_of(placed);
    places = {a, b, c};
    for (const Vec3& place : places) box.include(place);
  }
};

namespace {

/// Returns whether some vector has a positive product with all offsets. It is looked for by adding
/// the offset that it is most against, time and again (Rosenblatt, The perceptron, 1958).
bool point_one_way(std::span<Vec3> offsets) {
  Vec3 along(0.0);
  for (Vec3& offset : offsets) {
    offset /= largest_component(offset);
    along += offset;
  }
  constexpr int most_steps = 40;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3* worst = nullptr;
    double least = 0;
    for (const Vec3& offset : offsets) {
      const double product = glm::dot(offset, along);
      if (worst == nullptr || product < least) {
        worst = &offset;
        least = product;
      }
    }
    constexpr double roundings = 32;  // those of the offsets, their division and three products
    if (least > roundings * unit_roundoff * largest_component(along)) return true;
    along += *worst;
  }
  return false;
}

enum class SelfMeeting { none, unproven, same_corners };

/// Returns whether two triangles may meet elsewhere than in corners and edges that they share.
SelfMeeting meeting_of(const MeshCorners& one, const MeshCorners& other) {
  const auto unless = [](bool is_separate) {
    return is_separate ? SelfMeeting::none : SelfMeeting::unproven;
  };
  if (!one.box.touches(other.box)) return SelfMeeting::none;
  std::array<bool, 3> one_shares{};
  std::array<bool, 3> other_shares{};
  int shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (one.indices[i] != other.indices[k]) continue;
      one_shares[i] = other_shares[k] = true;
      ++shared;
    }
  }
  if (shared == 3) return SelfMeeting::same_corners;
  const auto free_corner = [](const std::array<bool, 3>& shares) {
    return static_cast<std::size_t>(std::find(shares.begin(), shares.end(), false) -
                                    shares.begin());
  };
  if (shared == 2) {
    if (one.plane.first != other.plane.first) return SelfMeeting::none;
    const bool same_direction = one.indices[(free_corner(one_shares) + 1) % 3] ==
                                other.indices[(free_corner(other_shares) + 1) % 3];
    return unless((one.plane.turned == other.plane.turned) != same_direction);
  }
  std::array<Vec3, 9> offsets;
  std::size_t count = 0;
  if (shared == 0) {
    for (const Vec3& from : one.places) {
      for (const Vec3& to : other.places) offsets[count++] = to - from;
    }
  } else {
    const auto place = std::find(one_shares.begin(), one_shares.end(), true) - one_shares.begin();
    const Vec3& corner = one.places[static_cast<std::size_t>(place)];
    for (std::size_t i = 0; i < 3; ++i) {
      if (!one_shares[i]) offsets[count++] = corner - one.places[i];
      if (!other_shares[i]) offsets[count++] = other.places[i] - corner;
    }
  }
  return unless(point_one_way(std::span(offsets).first(count)));
}

}  // namespace

SelfMeetings::SelfMeetings(const MeshTriangles& mesh) : mesh_(mesh), lowest_met_(mesh.size()) {
  for (std::atomic<std::uint32_t>& met : lowest_met_) met.store(none, std::memory_order_relaxed);
  gather_leaves();
  constexpr std::size_t leaves_a_task = 1024;
  for_ranges(leaves_.size(), leaves_a_task, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> open;
    std::vector<MeshCorners> corners;
    for (std::size_t i = begin; i < end; ++i) test(leaves_[i], open, corners);
  });
}

void SelfMeetings::gather_leaves() {
  std::vector<std::uint32_t> open{0};
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    mesh_.tree().for_each_child(node, [&](BvhChild child, const Bounds&) {
      if (child.is_leaf()) {
        leaves_.push_back(child);
      } else {
        open.push_back(child.index());
      }
    });
  }
}

/// Tests the triangles of a leaf against each other and those of the leaves after it.
void SelfMeetings::test(BvhChild leaf, std::vector<std::uint32_t>& open,
                        std::vector<MeshCorners>& corners) {
  const auto triangles_of = [this](BvhChild some) {
    return mesh_.placed().subspan(some.index(), some.count());
  };
  corners.clear();
  Bounds box;
  for (const MeshTriangles::Placed& placed : triangles_of(leaf)) {
    corners.emplace_back(mesh_, placed);
    box.include(corners.back().box);
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t k = i + 1; k < corners.size(); ++k) test(corners[i], corners[k]);
  }
  open.push_back(0);
  while (!open.empty()) {
    const std::uint32_t node = open.back();
    open.pop_back();
    mesh_.tree().for_each_touching(node, box, [&](BvhChild child) {
      if (!child.is_leaf()) {
        open.push_back(child.index());
      } else if (child.index() > leaf.index()) {
        for (const MeshTriangles::Placed& placed : triangles_of(child)) {
          const MeshCorners other(mesh_, placed);
          for (const MeshCorners& one : corners) test(one, other);
        }
      }
    });
  }
}

void SelfMeetings::test(const MeshCorners& one, const MeshCorners& other) {
  const SelfMeeting meeting = meeting_of(one, other);
  if (meeting == SelfMeeting::none) return;
  const bool is_repeated = meeting == SelfMeeting::same_corners;
  lower(one.number, is_repeated ? repeated : other.number);
  lower(other.number, is_repeated ? repeated : one.number);
}

/// Lowers the number of what a triangle meets. The order in which threads do so does not matter.
void SelfMeetings::lower(std::uint32_t triangle, std::uint32_t met) {
  std::atomic<std::uint32_t>& lowest = lowest_met_[triangle];
  std::uint32_t before = lowest.load(std::memory_order_relaxed);
  while (met < before && !lowest.compare_exchange_weak(before, met, std::memory_order_relaxed)) {
  }
}

}  // namespace crt::core
