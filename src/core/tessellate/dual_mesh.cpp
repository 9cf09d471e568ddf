#include "core/tessellate/dual_mesh.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "core/tasks/parallel.hpp"
#include "core/tessellate/closed_triangles.hpp"
#include "core/tessellate/surface_place.hpp"

namespace crt::core {

namespace {

struct PlaceHash {
  std::size_t operator()(const Vec3& place) const {
    std::uint64_t hash = 0;
    for (int axis = 0; axis < 3; ++axis) {
      hash ^= std::bit_cast<std::uint64_t>(place[axis]);
      hash *= 0x9e3779b97f4a7c15U;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

/// A SurfaceEdge is one that the surface crosses.
struct SurfaceEdge {
  GridEdge grid;
  bool starts_inside = false;
  Vec3 crossing{0, 0, 0};
};

class DualMeshMaker {
 public:
  DualMeshMaker(const CellSolid& solid, const CellPartition& partition, MeasureClock& clock)
      : solid_(solid), partition_(partition), clock_(clock) {}

  DualMesh make() {
    find_edges();
    find_crossings();
    place_vertices();
    for (const SurfaceEdge& edge : edges_) add_polygon(edge);
    close(mesh_.vertices, mesh_.triangles, mesh_.tangled);
    for (const DualVertex& vertex : mesh_.vertices)
      if (!vertex.is_plain) mesh_.tangled.push_back(vertex.cell);
    return std::move(mesh_);
  }

 private:
  static constexpr std::size_t items_of_task = 64;

  const PartitionNode& node(std::uint32_t cell) const { return partition_.node(cell); }

  /// A GridCorner is an end of edges.
  struct GridCorner {
    Vec3 place{0, 0, 0};
    std::uint32_t cell = 0;
    bool is_known = false;
    bool is_inside = false;
  };

  /// Finds the edges whose ends are on different sides of the surface.
  void find_edges() {
    std::unordered_map<Vec3, std::uint32_t, PlaceHash> numbers;
    std::vector<GridCorner> corners;
    const auto number_of = [&](const Vec3& place, std::uint32_t cell) {
      const auto [found, is_new] =
          numbers.emplace(place, static_cast<std::uint32_t>(corners.size()));
      if (is_new) corners.push_back({.place = place, .cell = cell});
      return found->second;
    };
    struct Ends {
      GridEdge edge;
      std::uint32_t from;
      std::uint32_t to;
    };
    std::vector<Ends> open;
    partition_.for_each_edge([&](const GridEdge& edge) {
      const Ends ends{edge, number_of(edge.from, edge.cells[0]),
                      number_of(edge.end(), edge.cells[0])};
      // A cell of which all is known says what its corners are.
      bool is_known = false;
      for (const std::uint32_t cell : edge.cells) {
        if (node(cell).look.is_open()) continue;
        is_known = true;
        const bool is_full = node(cell).look.kind == CellLook::Kind::full;
        for (const std::uint32_t end : {ends.from, ends.to}) {
          corners[end].is_known = true;
          corners[end].is_inside = corners[end].is_inside || is_full;
        }
      }
      if (!is_known) open.push_back(ends);
    });
    for_ranges(corners.size(), items_of_task, clock_.workers(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   GridCorner& corner = corners[i];
                   if (corner.is_known) continue;
                   const CellLook look =
                       solid_.look({{corner.place, corner.place}, node(corner.cell).look.program});
                   corner.is_inside = look.kind == CellLook::Kind::full;
                 }
               });
    for (const Ends& ends : open) {
      const bool starts = corners[ends.from].is_inside;
      if (starts != corners[ends.to].is_inside)
        edges_.push_back({.grid = ends.edge, .starts_inside = starts});
    }
  }

  void find_crossings() {
    for_ranges(edges_.size(), items_of_task, clock_.workers(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   SurfaceEdge& edge = edges_[i];
                   const SurfacePlaces places(solid_, node(plainest_cell(edge.grid)));
                   const Vec3 to = edge.grid.end();
                   edge.crossing = edge.starts_inside ? places.between(edge.grid.from, to)
                                                      : places.between(to, edge.grid.from);
                 }
               });
  }
  /// Returns the cell at an edge that knows its faces, and has the fewest.
  std::uint32_t plainest_cell(const GridEdge& edge) const {
    std::uint32_t best = edge.cells[0];
    const auto rank = [&](std::uint32_t cell) {
      const CellLook& look = node(cell).look;
      return look.kind == CellLook::Kind::crossed ? look.faces.size() : CellLook::max_faces + 1;
    };
    for (const std::uint32_t cell : edge.cells)
      if (rank(cell) < rank(best)) best = cell;
    return best;
  }

  void place_vertices() {
    // The crossings of each cell, in the order of the edges.
    std::vector<std::pair<std::uint32_t, Vec3>> uses;
    for (const SurfaceEdge& edge : edges_) {
      for (std::size_t i = 0; i < 4; ++i) {
        const auto before = edge.grid.cells.begin() + static_cast<std::ptrdiff_t>(i);
        if (std::find(edge.grid.cells.begin(), before, edge.grid.cells[i]) == before)
          uses.emplace_back(edge.grid.cells[i], edge.crossing);
      }
    }
    std::sort(uses.begin(), uses.end(), [](const auto& a, const auto& b) {
      const auto key = [](const auto& use) {
        return std::tuple(use.first, use.second.x, use.second.y, use.second.z);
      };
      return key(a) < key(b);
    });
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < uses.size(); ++i)
      if (i == 0 || uses[i].first != uses[i - 1].first) starts.push_back(i);
    vertex_of_cell_.assign(partition_.node_count(), invalid_index);
    mesh_.vertices.resize(starts.size());
    for (std::size_t v = 0; v < starts.size(); ++v)
      vertex_of_cell_[uses[starts[v]].first] = static_cast<std::uint32_t>(v);
    starts.push_back(uses.size());
    for_ranges(mesh_.vertices.size(), items_of_task, clock_.workers(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t v = begin; v < end; ++v) {
                   std::vector<Vec3> crossings;
                   crossings.reserve(starts[v + 1] - starts[v]);
                   for (std::size_t i = starts[v]; i < starts[v + 1]; ++i)
                     crossings.push_back(uses[i].second);
                   mesh_.vertices[v] = vertex(uses[starts[v]].first, crossings);
                 }
               });
  }

  DualVertex vertex(std::uint32_t cell, std::span<const Vec3> crossings) const {
    const SurfacePlaces places(solid_, node(cell));
    Vec3 mean(0, 0, 0);
    for (const Vec3& crossing : crossings) mean += crossing / static_cast<double>(crossings.size());
    const auto is_nearer = [&](const Vec3& a, const Vec3& b) {
      return glm::length(a - mean) < glm::length(b - mean);
    };
    DualVertex result{.place = *std::min_element(crossings.begin(), crossings.end(), is_nearer),
                      .cell = cell};
    std::vector<Vec3> normals;
    std::vector<std::size_t> faces;
    for (const Vec3& crossing : crossings) {
      const std::vector<FacePull> pulls = places.pulls_at(crossing);
      double distance = infinity;
      const FacePull* const pull = places.nearest(pulls, distance);
      if (pull == nullptr) continue;
      normals.push_back(pull->normal);
      if (std::find(faces.begin(), faces.end(), pull->face) == faces.end())
        faces.push_back(pull->face);
    }
    const auto surfaces = std::ranges::count_if(node(cell).look.faces, &CellFace::is_surface);
    result.is_partial = faces.size() < static_cast<std::size_t>(surfaces);
    if (faces.empty()) {
      // So little is known only of cells that are small, or of what cannot be helped.
    } else if (places.meet(faces, mean)) {
      result.place = mean;
    } else {
      result.is_plain = false;
      if (find_place(places, faces, mean)) result.place = mean;
    }
    const std::vector<FacePull> pulls = places.pulls_at(result.place);
    std::vector<Vec3> here;
    for (const FacePull& pull : pulls)
      if (std::find(faces.begin(), faces.end(), pull.face) != faces.end())
        here.push_back(pull.normal);
    find_sharpness(here, result);
    normals.insert(normals.end(), here.begin(), here.end());
    if (!normals.empty()) result.outwards = common_direction(normals);
    return result;
  }

  /// Says whether faces with some normals make an edge or a corner.
  static void find_sharpness(std::span<const Vec3> normals, DualVertex& vertex) {
    constexpr double smooth = 0.02;
    for (const Vec3& a : normals) {
      for (const Vec3& b : normals) {
        const Vec3 along = glm::cross(a, b);
        const double sine = glm::length(along);
        if (sine <= smooth || vertex.sharpness == 3) continue;
        if (vertex.sharpness == 1) vertex.edge = along / sine;
        const double off = glm::length(glm::cross(vertex.edge, along / sine));
        vertex.sharpness = off > smooth ? 3 : 2;
      }
    }
  }

  /// Moves a place onto two of some faces that meet in the cell, or onto one. Returns false if none
  /// is there.
  static bool find_place(const SurfacePlaces& places, std::span<const std::size_t> faces,
                         Vec3& place) {
    for (std::size_t i = 0; i < faces.size(); ++i) {
      for (std::size_t j = i + 1; j < faces.size(); ++j)
        if (places.meet_on_the_way(std::array{faces[i], faces[j]}, place)) return true;
    }
    return std::ranges::any_of(
        faces, [&](std::size_t face) { return places.meet(std::span(&face, 1), place); });
  }

  void add_polygon(const SurfaceEdge& edge) {
    std::array<std::uint32_t, 4> corners{};
    std::size_t count = 0;
    for (const std::uint32_t cell : edge.grid.cells) {
      const std::uint32_t vertex = vertex_of_cell_[cell];
      if (count == 0 || corners[count - 1] != vertex) corners[count++] = vertex;
    }
    if (count > 1 && corners[count - 1] == corners[0]) --count;
    if (count < 3) return;
    if (!edge.starts_inside)
      std::reverse(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count));
    if (count == 3) {
      mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
      return;
    }
    const double even = distance_of_middle(corners, corners[0], corners[2]);
    const double odd = distance_of_middle(corners, corners[1], corners[3]);
    constexpr double equal = 1e-9;
    const double length_even = length_of(corners[0], corners[2]);
    const double length_odd = length_of(corners[1], corners[3]);
    const double slack = equal * std::max(length_even, length_odd);
    const bool takes_even = std::abs(even - odd) <= slack ? length_even <= length_odd : even < odd;
    if (!takes_even) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    mesh_.triangles.push_back({corners[0], corners[1], corners[2]});
    mesh_.triangles.push_back({corners[0], corners[2], corners[3]});
  }
  double length_of(std::uint32_t a, std::uint32_t b) const {
    return glm::length(mesh_.vertices[a].place - mesh_.vertices[b].place);
  }
  /// Returns how far the middle between two corners is from the surface, as far as the cells around
  /// know.
  double distance_of_middle(const std::array<std::uint32_t, 4>& around, std::uint32_t a,
                            std::uint32_t b) const {
    const Vec3 middle = 0.5 * mesh_.vertices[a].place + 0.5 * mesh_.vertices[b].place;
    double most = 0;
    for (const std::uint32_t vertex : around) {
      const SurfacePlaces places(solid_, node(mesh_.vertices[vertex].cell));
      double distance = infinity;
      places.nearest(places.pulls_at(middle), distance);
      if (distance < infinity) most = std::max(most, distance);
    }
    return most;
  }

  const CellSolid& solid_;
  const CellPartition& partition_;
  MeasureClock& clock_;
  std::vector<SurfaceEdge> edges_;
  std::vector<std::uint32_t> vertex_of_cell_;
  DualMesh mesh_;
};

}  // namespace

DualMesh dual_mesh_of(const CellSolid& solid, const CellPartition& partition, MeasureClock& clock) {
  return DualMeshMaker(solid, partition, clock).make();
}

}  // namespace crt::core
