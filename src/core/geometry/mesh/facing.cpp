#include "core/geometry/mesh/facing.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

#include "core/geometry/mesh/met_triangles.hpp"
#include "core/geometry/mesh/triangles.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "core/math/vector.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

/// A Corners is a triangle as pairs are tested.
struct Corners {
  std::uint32_t number;
  MeshTriangles::PlaneOf plane;
  TriangleIndices indices;
  std::array<Vec3, 3> places;
  Bounds box;

  Corners(const MeshTriangles& mesh, const MeshTriangles::Placed& placed)
      : number(placed.number), plane(placed.plane), indices(placed.corners) {
    const auto [a, b, c, material] = mesh.corners_of(placed);
    places = {a, b, c};
    for (const Vec3& place : places) box.include(place);
  }
};

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

/// Returns whether two triangles meet nowhere but in corners and edges that they share.
bool are_separate(const Corners& one, const Corners& other) {
  if (!one.box.touches(other.box)) return true;
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
  if (shared == 3) return false;
  const auto free_corner = [](const std::array<bool, 3>& shares) {
    return static_cast<std::size_t>(std::find(shares.begin(), shares.end(), false) -
                                    shares.begin());
  };
  if (shared == 2) {
    if (one.plane.first != other.plane.first) return true;
    const bool same_direction = one.indices[(free_corner(one_shares) + 1) % 3] ==
                                other.indices[(free_corner(other_shares) + 1) % 3];
    return (one.plane.turned == other.plane.turned) != same_direction;
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
  return point_one_way(std::span(offsets).first(count));
}

/// A SelfMeetings finds which triangles are separate.
class SelfMeetings {
 public:
  explicit SelfMeetings(const MeshTriangles& mesh) : mesh_(mesh), meets_(mesh.size()) {
    gather_leaves();
    constexpr std::size_t leaves_a_task = 1024;
    for_ranges(leaves_.size(), leaves_a_task, {}, [&](std::size_t begin, std::size_t end) {
      std::vector<std::uint32_t> open;
      std::vector<Corners> corners;
      for (std::size_t i = begin; i < end; ++i) test(leaves_[i], open, corners);
    });
  }

  bool is_separate(std::uint32_t triangle) const {
    return !meets_[triangle].load(std::memory_order_relaxed);
  }

 private:
  void gather_leaves() {
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

  std::span<const MeshTriangles::Placed> triangles_of(BvhChild leaf) const {
    return mesh_.placed().subspan(leaf.index(), leaf.count());
  }

  /// Tests the triangles of a leaf against each other and those of the leaves after it.
  void test(BvhChild leaf, std::vector<std::uint32_t>& open, std::vector<Corners>& corners) {
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
            const Corners other(mesh_, placed);
            for (const Corners& one : corners) test(one, other);
          }
        }
      });
    }
  }

  void test(const Corners& one, const Corners& other) {
    if (are_separate(one, other)) return;
    meets_[one.number].store(true, std::memory_order_relaxed);
    meets_[other.number].store(true, std::memory_order_relaxed);
  }

  const MeshTriangles& mesh_;
  std::vector<BvhChild> leaves_;
  std::vector<std::atomic<bool>> meets_;
};

/// A Connected says which triangles are connected: each has the lowest number of those it is
/// connected with (Galler, Fischer, An improved equivalence algorithm, 1964).
class Connected {
 public:
  explicit Connected(std::uint32_t count) : above_(count) {
    std::iota(above_.begin(), above_.end(), 0u);
  }

  std::uint32_t lowest(std::uint32_t item) {
    while (above_[item] != item) item = above_[item] = above_[above_[item]];
    return item;
  }
  void connect(std::uint32_t one, std::uint32_t other) {
    one = lowest(one);
    other = lowest(other);
    above_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<std::uint32_t> above_;
};

/// Finds how a separate triangle faces, by a line through its middle.
Facing facing_of(const MeshTriangles& mesh, std::uint32_t triangle, CrossingList& crossings) {
  const auto [a, b, c, material] = mesh.triangle(triangle);
  const ObjectRay ray{.origin = a / 3.0 + b / 3.0 + c / 3.0,
                      .direction = -rounded(precise_normal_of(mesh.triangle(triangle)))};
  crossings.clear();
  standard_crossings(mesh, ray, crossings);
  const auto found =
      std::find_if(crossings.begin(), crossings.end(),
                   [&](const Crossing& crossing) { return crossing.face == triangle; });
  if (found == crossings.end() || !is_alone(*found, crossings)) return Facing::unknown;
  return found->entering ? Facing::outwards : Facing::inwards;
}

}  // namespace

std::vector<Facing> find_facing(const MeshTriangles& mesh, std::span<const EdgePair> pairs) {
  const SelfMeetings meetings(mesh);
  Connected connected(mesh.size());
  for (const EdgePair& pair : pairs) {
    if (meetings.is_separate(pair.one) && meetings.is_separate(pair.other)) {
      connected.connect(pair.one, pair.other);
    }
  }
  std::vector<Facing> facings(mesh.size(), Facing::unknown);
  std::vector<std::uint8_t> tries(mesh.size());
  CrossingList crossings;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    constexpr std::uint8_t most_tries = 8;  // as a line may meet another triangle right there
    const std::uint32_t lowest = connected.lowest(i);
    if (!meetings.is_separate(i) || facings[lowest] != Facing::unknown) continue;
    if (tries[lowest]++ < most_tries) facings[lowest] = facing_of(mesh, i, crossings);
  }
  for (std::uint32_t i = 0; i < mesh.size(); ++i) facings[i] = facings[connected.lowest(i)];
  return facings;
}

}  // namespace crt::core
