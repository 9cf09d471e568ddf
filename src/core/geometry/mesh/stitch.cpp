// T-junctions are closed by dividing edges: no vertex moves.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <tuple>
#include <utility>

#include "core/geometry/compact_bvh.hpp"
#include "core/geometry/mesh/repair.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// An OpenEdge belongs to a triangle, and to an odd number of them in all.
struct OpenEdge {
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t triangle;
  std::uint32_t from;

  friend bool operator<(const OpenEdge& a, const OpenEdge& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  }
  bool has_ends_of(const OpenEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<OpenEdge> open_edges(std::span<const TriangleIndices> triangles) {
  std::vector<OpenEdge> edges;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const auto [a, b, c] = triangles[i];
    if (a == b || b == c || c == a) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[i][k];
      const std::uint32_t to = triangles[i][(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), i, from});
    }
  }
  std::sort(edges.begin(), edges.end());
  auto kept = edges.begin();
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(),
                                  [&](const OpenEdge& edge) { return !edge.has_ends_of(*begin); });
    if ((end - begin) % 2 != 0) kept = std::copy(begin, end, kept);
    begin = end;
  }
  edges.erase(kept, edges.end());
  return edges;
}

/// A Stop is a vertex on an edge.
struct Stop {
  double place;  ///< from 0 at its begin to 1 at its end
  std::uint32_t vertex;

  friend bool operator<(const Stop& a, const Stop& b) {
    return std::tie(a.place, a.vertex) < std::tie(b.place, b.vertex);
  }
};

/// A VertexTree finds vertices near a straight line.
class VertexTree {
 public:
  VertexTree(std::span<const Vec3> positions, std::vector<std::uint32_t> vertices, double tolerance)
      : positions_(positions), vertices_(std::move(vertices)), tolerance_(tolerance) {
    std::vector<Bounds> boxes(vertices_.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].include(positions_[vertices_[i]]);
    constexpr std::uint32_t vertices_a_leaf = 4;
    constexpr int one_thread = 1;
    tree_ = CompactBvh(boxes, vertices_a_leaf, one_thread);
    order_ = tree_.take_order();
  }

  /// Returns the vertices on an edge, in order. Those that are as near to its ends do not count.
  std::vector<Stop> stops_on(std::uint32_t from, std::uint32_t to) {
    stops_.clear();
    const Vec3& begin = positions_[from];
    const Vec3& end = positions_[to];
    open_.assign(1, 0);
    while (!open_.empty()) {
      const std::uint32_t node = open_.back();
      open_.pop_back();
      tree_.for_each_child(node, [&](BvhChild child, const Bounds& box) {
        if (!comes_near(box, begin, end)) return;
        if (!child.is_leaf()) {
          open_.push_back(child.index());
          return;
        }
        for (std::uint32_t i = 0; i < child.count(); ++i)
          add_if_on(vertices_[order_[child.index() + i]], begin, end);
      });
    }
    std::sort(stops_.begin(), stops_.end());
    return stops_;
  }

 private:
  /// Returns whether an edge comes as near to a box as the tolerance, or perhaps somewhat farther.
  bool comes_near(const Bounds& box, const Vec3& begin, const Vec3& end) const {
    constexpr double share_for_rounding = 0x1p-40;
    const double size = std::max(largest_component(begin), largest_component(end));
    const double margin = tolerance_ + share_for_rounding * (tolerance_ + size);
    double enter = 0;
    double leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double lower = box.lower[axis] - margin - begin[axis];
      const double upper = box.upper[axis] + margin - begin[axis];
      const double along = end[axis] - begin[axis];
      if (along == 0) {
        if (lower > 0 || upper < 0) return false;
        continue;
      }
      enter = std::max(enter, std::min(lower / along, upper / along));
      leave = std::min(leave, std::max(lower / along, upper / along));
    }
    return enter <= leave;
  }

  void add_if_on(std::uint32_t vertex, const Vec3& begin, const Vec3& end) {
    const double size = largest_component(end - begin);
    const Vec3 along = (end - begin) / size;
    const Vec3 offset = (positions_[vertex] - begin) / size;
    const double place = glm::dot(offset, along) / glm::dot(along, along);
    const auto is_near = [&](const Vec3& other) {
      const Vec3 apart = (offset - other) * (size / tolerance_);
      return glm::dot(apart, apart) <= 1;
    };
    if (!(place > 0 && place < 1) || !is_near(place * along)) return;
    if (!is_near(Vec3(0.0)) && !is_near(along)) stops_.push_back({place, vertex});
  }

  std::span<const Vec3> positions_;
  std::vector<std::uint32_t> vertices_;
  double tolerance_;
  CompactBvh tree_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> open_;
  std::vector<Stop> stops_;
};

Vec3 mixed(const Vec3& a, const Vec3& b, double share) {
  return a + share * (b - a);
}

std::array<double, 2> mixed(const std::array<double, 2>& a, const std::array<double, 2>& b,
                            double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

/// Appends what is between two of a list, and returns its number there.
template <class Value>
std::uint32_t between(std::vector<Value>& values, std::uint32_t from, std::uint32_t to,
                      double share) {
  if (from == no_index || to == no_index) return no_index;
  values.push_back(mixed(values[from], values[to], share));
  return static_cast<std::uint32_t>(values.size() - 1);
}

/// A Divider divides one triangle of a mesh, with its attributes.
class Divider {
 public:
  Divider(RepairedMesh& mesh, std::uint32_t triangle) : mesh_(mesh), pieces_{triangle} {}

  /// Divides an edge from one vertex to another at a share of its length.
  void divide(std::uint32_t from, std::uint32_t to, std::uint32_t vertex, double share) {
    for (std::size_t i = pieces_.size(); i-- > 0;) {
      for (std::size_t k = 0; k < 3; ++k) {
        const TriangleIndices& corners = mesh_.triangles[pieces_[i]];
        if (corners[k] != from || corners[(k + 1) % 3] != to) continue;
        divide_piece(pieces_[i], k, vertex, share);
        return;
      }
    }
  }

 private:
  /// Divides the edge that begins at a corner. Its first part stays where it is.
  void divide_piece(std::uint32_t piece, std::size_t corner, std::uint32_t vertex, double share) {
    const auto put = [&](std::vector<TriangleIndices>& list, std::uint32_t number) {
      TriangleIndices rest = list[piece];
      rest[corner] = number;
      list[piece][(corner + 1) % 3] = number;
      list.push_back(rest);
    };
    MeshAttributes& given = mesh_.attributes;
    const auto middle_of = [&](const std::vector<TriangleIndices>& indices, auto& values) {
      const TriangleIndices& of_corners = indices[piece];
      return between(values, of_corners[corner], of_corners[(corner + 1) % 3], share);
    };
    if (!given.normal_indices.empty())
      put(given.normal_indices, middle_of(given.normal_indices, given.normals));
    if (!given.uv_indices.empty()) put(given.uv_indices, middle_of(given.uv_indices, given.uv));
    if (!given.material_of_triangle.empty()) {
      const std::uint32_t material = given.material_of_triangle[piece];
      given.material_of_triangle.push_back(material);
    }
    pieces_.push_back(static_cast<std::uint32_t>(mesh_.triangles.size()));
    put(mesh_.triangles, vertex);
  }

  RepairedMesh& mesh_;
  std::vector<std::uint32_t> pieces_;
};

/// Returns the vertices of edges, each once.
std::vector<std::uint32_t> ends_of(std::span<const OpenEdge> edges) {
  std::vector<std::uint32_t> vertices;
  for (const OpenEdge& edge : edges) vertices.insert(vertices.end(), {edge.low, edge.high});
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

std::uint64_t stitch(RepairedMesh& mesh, double tolerance) {
  // Of T-junctions there are far fewer. Only edges that lie on one another by the thousand have as
  // many, each with the vertices of all others on it.
  const std::uint64_t max_divisions = 16 * mesh.triangles.size() + (1u << 16u);
  std::vector<OpenEdge> edges = open_edges(mesh.triangles);
  if (edges.empty()) return 0;
  VertexTree tree(mesh.positions, ends_of(edges), tolerance);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const OpenEdge& a, const OpenEdge& b) { return a.triangle < b.triangle; });
  std::uint64_t divisions = 0;
  for (auto edge = edges.begin(); edge != edges.end();) {
    const std::uint32_t triangle = edge->triangle;
    const TriangleIndices own = mesh.triangles[triangle];
    Divider divider(mesh, triangle);
    for (; edge != edges.end() && edge->triangle == triangle; ++edge) {
      std::vector<Stop> stops = tree.stops_on(edge->low, edge->high);
      std::erase_if(stops, [&](const Stop& stop) {
        return std::find(own.begin(), own.end(), stop.vertex) != own.end();
      });
      divisions += stops.size();
      if (divisions > max_divisions) {
        throw Error(
            ErrorCode::limit,
            text::format("stitch finds more than {} vertices on edges: too many edges lie on "
                         "one another",
                         max_divisions),
            "stitch");
      }
      const bool is_upwards = edge->from == edge->low;
      const std::uint32_t to = is_upwards ? edge->high : edge->low;
      if (!is_upwards) {
        std::reverse(stops.begin(), stops.end());
        for (Stop& stop : stops) stop.place = 1 - stop.place;
      }
      std::uint32_t from = edge->from;
      double begin = 0;
      for (const Stop& stop : stops) {
        divider.divide(from, to, stop.vertex, (stop.place - begin) / (1 - begin));
        from = stop.vertex;
        begin = stop.place;
      }
    }
  }
  return divisions;
}

}  // namespace crt::core
