#include "core/geometry/mesh/triangles.hpp"

#include <algorithm>
#include <tuple>

#include "core/base/large_pages.hpp"
#include "core/geometry/canonical_plane.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/exact_plane.hpp"
#include "core/geometry/mesh/edges.hpp"
#include "core/geometry/mesh/equal_positions.hpp"
#include "core/geometry/mesh/facet_attributes.hpp"
#include "core/geometry/mesh/self_meetings.hpp"
#include "core/geometry/mesh/shells.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

using namespace core;

namespace {

[[noreturn]] void reject_mesh(const std::string& message, const char* argument) {
  throw Error(ErrorCode::invalid_argument, message, argument);
}

void check_indices(std::span<const TriangleIndices> triangles, std::size_t positions) {
  if (triangles.size() > BvhChild::max_items || positions > 0xffffffffu) {
    reject_mesh(text::format("a mesh has at most {} triangles", BvhChild::max_items), "triangles");
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t index : triangles[i]) {
      if (index < positions) continue;
      reject_mesh(text::format("triangle {} has the index {}, but there are {} positions", i, index,
                               positions),
                  "indices");
    }
  }
}

/// A PlaneKey is the plane of a triangle. Equal planes have equal numbers.
struct PlaneKey {
  CanonicalPlane plane;
  std::uint32_t triangle = 0;

  friend bool operator<(const PlaneKey& a, const PlaneKey& b) {
    return std::tie(a.plane.numbers, a.triangle) < std::tie(b.plane.numbers, b.triangle);
  }
};

PlaneKey plane_key(const Triangle& triangle, std::uint32_t number) {
  const PreciseVec3 normal = precise_normal_of(triangle);
  const Vec3& corner = triangle.a;
  return {CanonicalPlane::of(normal, dot(normal, {corner.x, corner.y, corner.z})), number};
}

}  // namespace

void core::check_mesh(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles,
                      const MeshAttributes* attributes) {
  for (const Vec3& position : positions) check_coordinates("positions", position);
  check_indices(triangles, positions.size());
  if (attributes != nullptr) check_attributes(*attributes, positions.size(), triangles.size());
}

MeshTriangles::MeshTriangles(std::span<const Vec3> positions,
                             std::span<const TriangleIndices> triangles,
                             const MeshAttributes* attributes, std::optional<FillRule> fill,
                             MeshReport report)
    : report_(std::move(report)) {
  check_mesh(positions, triangles, attributes);
  positions_.assign(positions.begin(), positions.end());
  std::vector<TriangleIndices> welded(triangles.begin(), triangles.end());
  std::vector<std::uint32_t> given = weld(welded);
  MeshEdges edges = find_edges(positions_, welded);
  drop_flat(welded, edges, given);
  if (placed_.empty()) {
    reject_mesh("a mesh needs at least one triangle that has an area", "triangles");
  }
  for (const Placed& placed : placed_) {
    Bounds box;
    for (const std::uint32_t index : placed.corners) box.include(positions_[index]);
    bounds_.include(box);
  }
  oriented_ = edges.unbalanced.empty();
  fault_ = edges.open.empty() && fill == FillRule::nonzero ? edges.unbalanced : edges.open;
  report_.fill = fill.value_or(FillRule::even_odd);
  const bool turned = is_closed() && oriented_ && turn_outwards();
  find_planes();
  build_tree();
  if (is_closed() && oriented_) find_facing(fill, edges);
  add_mesh_warnings(*this, edges, report_);
  if (attributes == nullptr) return;
  attributes_ = std::make_unique<const FacetAttributes>(
      *attributes, GivenFacets{triangles, given, turned}, *this, edges.pairs);
  if (attributes_->empty()) attributes_.reset();
}

MeshTriangles::~MeshTriangles() = default;

/// Takes those triangles that have an area, and drops others from what edges say. `given` has what
/// number each was given with, and then has it of each that was taken.
void MeshTriangles::drop_flat(std::span<const TriangleIndices> triangles, MeshEdges& edges,
                              std::vector<std::uint32_t>& given) {
  constexpr std::uint32_t dropped = 0xffffffffu;
  std::vector<std::uint32_t> numbers(triangles.size(), dropped);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [a, b, c] = triangles[i];
    if (!has_area({.a = positions_[a], .b = positions_[b], .c = positions_[c]})) continue;
    numbers[i] = size();
    given[size()] = given[i];
    edges.shells[size()] = edges.shells[i];
    places_.push_back(size());
    placed_.push_back({.corners = triangles[i], .number = size(), .plane = {}});
  }
  given.resize(size());
  edges.shells.resize(size());
  for (EdgePair& pair : edges.pairs) pair = {numbers[pair.one], numbers[pair.other]};
  std::erase_if(edges.pairs,
                [](const EdgePair& pair) { return pair.one == dropped || pair.other == dropped; });
  for (std::uint32_t& triangle : edges.repeated) triangle = numbers[triangle];
  std::erase(edges.repeated, dropped);
}

/// Makes equal corners one, and drops triangles of which two corners are one. What these had for
/// edges are two uses of one edge, and one of no length. Returns the numbers of those that are
/// left.
std::vector<std::uint32_t> MeshTriangles::weld(std::vector<TriangleIndices>& triangles) {
  const std::vector<std::uint32_t> first = first_equal(positions_);
  std::vector<std::uint32_t> left;
  left.reserve(triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    TriangleIndices indices = triangles[i];
    for (std::uint32_t& index : indices) index = first[index];
    const auto [a, b, c] = indices;
    if (a == b || b == c || c == a) continue;
    triangles[left.size()] = indices;
    left.push_back(i);
  }
  triangles.resize(left.size());
  return left;
}

/// Turns all triangles round if their normals point into the solid. Returns whether it did.
bool MeshTriangles::turn_outwards() {
  const Vec3 middle = 0.5 * bounds_.lower + 0.5 * bounds_.upper;
  const double extent = power_of_two_below(largest_component(bounds_.upper - bounds_.lower));
  double volume = 0;
  for (std::uint32_t i = 0; i < size(); ++i) {
    const Triangle corners = triangle(i);
    const auto relative = [&](const Vec3& corner) { return (corner - middle) / extent; };
    volume += glm::dot(relative(corners.a), glm::cross(relative(corners.b), relative(corners.c)));
  }
  if (volume >= 0) return false;
  for (Placed& placed : placed_) std::swap(placed.corners[1], placed.corners[2]);
  return true;
}

void MeshTriangles::find_planes() {
  std::vector<PlaneKey> keys;
  keys.reserve(size());
  for (std::uint32_t i = 0; i < size(); ++i) keys.push_back(plane_key(triangle(i), i));
  std::sort(keys.begin(), keys.end());
  std::vector<const PlaneKey*> firsts;  // of the planes with the same key
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const PlaneKey& key = keys[i];
    if (i == 0 || key.plane.numbers != keys[i - 1].plane.numbers) firsts.clear();
    const auto found = std::find_if(firsts.begin(), firsts.end(), [&](const PlaneKey* first) {
      return is_in_plane(triangle(key.triangle), triangle(first->triangle));
    });
    const PlaneKey& first = found != firsts.end() ? **found : key;
    if (found == firsts.end()) firsts.push_back(&key);
    placed_[places_[key.triangle]].plane = {.first = first.triangle & 0x1fffffffu,
                                            .turned = key.plane.flipped != first.plane.flipped};
  }
}

void MeshTriangles::build_tree() {
  std::vector<Bounds> boxes(placed_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const std::uint32_t index : placed_[i].corners) boxes[i].include(positions_[index]);
  }
  constexpr std::uint32_t triangles_a_leaf = lane_count;
  constexpr int one_thread = 1;
  tree_ = CompactBvh(boxes, triangles_a_leaf, one_thread);
  sort_along_tree(tree_.take_order());
}

/// Puts triangles and their corners where they follow one another as a line comes to them.
void MeshTriangles::sort_along_tree(std::span<const std::uint32_t> order) {
  constexpr std::uint32_t unknown = 0xffffffffu;
  std::vector<std::uint32_t> moved(positions_.size(), unknown);
  std::vector<Vec3> positions;
  std::vector<Placed> sorted;
  sorted.reserve(placed_.size());
  ask_for_large_pages(sorted.data(), sorted.capacity() * sizeof(Placed));
  for (const std::uint32_t number : order) {
    places_[number] = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(placed_[number]);
    for (std::uint32_t& index : sorted.back().corners) {
      std::uint32_t& place = moved[index];
      if (place == unknown) {
        place = static_cast<std::uint32_t>(positions.size());
        positions.push_back(positions_[index]);
      }
      index = place;
    }
  }
  positions.emplace_back(0.0);
  positions_ = std::vector<Vec3>();
  positions_.reserve(positions.size());
  ask_for_large_pages(positions_.data(), positions_.capacity() * sizeof(Vec3));
  positions_.assign(positions.begin(), positions.end());
  placed_ = std::move(sorted);
}

void MeshTriangles::find_facing(std::optional<FillRule> fill, const MeshEdges& edges) {
  const SelfMeetings meetings(*this);
  const Fronts fronts = find_fronts(*this, meetings, edges.pairs);
  if (!fill && are_turned_outwards(*this, fronts, edges.shells)) report_.fill = FillRule::nonzero;
  bool all_known = true;
  for (Placed& placed : placed_) {
    const Facing facing = facing_by(fronts[placed.number], report_.fill);
    placed.plane.facing = static_cast<std::uint32_t>(facing) & 3u;
    all_known = all_known && (facing == Facing::outwards || facing == Facing::inwards);
  }
  find_overlaps(*this, meetings, fronts, edges.shells, report_);
  counts_windings_ = report_.fill == FillRule::nonzero && !all_known;
}

TriangleLanes MeshTriangles::placed_corners(std::uint32_t first, std::uint32_t count) const {
  const auto corners = [&](std::size_t corner) {
    const auto row = [&](std::uint32_t lane) {
      const TriangleIndices& indices = placed_[first + std::min(lane, count - 1)].corners;
      return lanes_at<Lanes>(&positions_[indices[corner]].x);
    };
    const std::array<Lanes, lane_count> columns = transposed({row(0), row(1), row(2), row(3)});
    return VectorLanes{columns[0], columns[1], columns[2]};
  };
  return {corners(0), corners(1), corners(2)};
}

std::size_t MeshTriangles::bytes() const {
  return sizeof *this + positions_.capacity() * sizeof(Vec3) + placed_.capacity() * sizeof(Placed) +
         places_.capacity() * sizeof(std::uint32_t) + tree_.bytes() +
         (attributes_ ? attributes_->bytes() : 0);
}

}  // namespace crt
