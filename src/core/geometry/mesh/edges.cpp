#include "core/geometry/mesh/edges.hpp"

#include <algorithm>
#include <tuple>

#include "core/geometry/mesh/connected.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// An Edge is one use of an edge by a triangle.
struct Edge {
  std::uint32_t low;   ///< the lower number of its corners
  std::uint32_t high;  ///< the higher
  std::uint32_t triangle;
  bool upwards;  ///< whether it runs from the lower to the higher

  friend bool operator<(const Edge& a, const Edge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  }
};

std::vector<Edge> edges_of(std::span<const TriangleIndices> triangles) {
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[i][k];
      const std::uint32_t to = triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), i, from < to});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

/// Counts edges with a fault, and keeps the one whose first triangle comes first.
class FaultyEdges {
 public:
  void add(const Edge& edge) {
    ++count_;
    if (first_ == nullptr || edge.triangle < first_->triangle) first_ = &edge;
  }
  /// Returns what is wrong with how many of `all` edges, or nothing.
  std::string text(std::size_t all, const char* fault, std::span<const Vec3> positions) const {
    if (first_ == nullptr) return "";
    const Vec3& from = positions[first_->low];
    const Vec3& to = positions[first_->high];
    return text::format("{} of its {} edges {}: the first is from ({}, {}, {}) to ({}, {}, {})",
                        count_, all, fault, from.x, from.y, from.z, to.x, to.y, to.z);
  }

 private:
  std::size_t count_ = 0;
  const Edge* first_ = nullptr;
};

/// An Apex is the third corner of a triangle whose two lowest ones are those of an edge.
struct Apex {
  std::uint32_t corner;
  std::uint32_t triangle;
};

/// Appends those of the triangles with an edge that have the corners of another one with a lower
/// number. The edge is that of their two lowest corners, so that each is found once. `apexes` is
/// for its use.
void append_repeated(std::span<const Edge> uses, std::span<const TriangleIndices> triangles,
                     std::vector<Apex>& apexes, std::vector<std::uint32_t>& repeated) {
  const auto apex_of = [&](const Edge& edge) {
    const auto [a, b, c] = triangles[edge.triangle];
    return a ^ b ^ c ^ edge.low ^ edge.high;  // what is left of the three
  };
  constexpr std::size_t usual = 2;
  if (uses.size() < usual) return;
  if (uses.size() == usual && apex_of(uses[0]) != apex_of(uses[1])) return;
  apexes.clear();
  for (const Edge& edge : uses) {
    if (apex_of(edge) > edge.high) apexes.push_back({apex_of(edge), edge.triangle});
  }
  std::stable_sort(apexes.begin(), apexes.end(),
                   [](const Apex& a, const Apex& b) { return a.corner < b.corner; });
  for (std::size_t i = 1; i < apexes.size(); ++i) {
    if (apexes[i].corner == apexes[i - 1].corner) repeated.push_back(apexes[i].triangle);
  }
}

}  // namespace

MeshEdges find_edges(std::span<const Vec3> positions, std::span<const TriangleIndices> triangles) {
  const std::vector<Edge> edges = edges_of(triangles);
  MeshEdges result;
  result.pairs.reserve(edges.size() / 2);
  Connected connected(triangles.size());
  std::size_t count = 0;
  FaultyEdges open;
  FaultyEdges unbalanced;
  std::vector<Apex> apexes;
  for (std::size_t begin = 0; begin < edges.size();) {
    std::size_t end = begin;
    std::size_t upwards = 0;
    const auto is_same = [&](const Edge& edge) {
      return edge.low == edges[begin].low && edge.high == edges[begin].high;
    };
    for (; end < edges.size() && is_same(edges[end]); ++end) upwards += edges[end].upwards ? 1 : 0;
    const std::span<const Edge> uses = std::span(edges).subspan(begin, end - begin);
    if (2 * upwards != uses.size()) unbalanced.add(uses[0]);
    if (uses.size() % 2 != 0) open.add(uses[0]);
    if (uses.size() == 2) result.pairs.push_back({uses[0].triangle, uses[1].triangle});
    for (const Edge& use : uses.subspan(1)) connected.connect(uses[0].triangle, use.triangle);
    append_repeated(uses, triangles, apexes, result.repeated);
    ++count;
    begin = end;
  }
  result.open = open.text(count, "belong to an odd number of triangles", positions);
  result.unbalanced = unbalanced.text(
      count, "run more often in one direction than in the other, and 'nonzero' needs them not to",
      positions);
  // The lowest of a shell comes first, and so has the number of the shell already.
  result.shells.resize(triangles.size());
  std::uint32_t shells = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t lowest = connected.lowest(i);
    result.shells[i] = lowest == i ? shells++ : result.shells[lowest];
  }
  std::sort(result.repeated.begin(), result.repeated.end());
  return result;
}

}  // namespace crt::core
