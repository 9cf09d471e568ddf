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

constexpr std::size_t items_of_task = 64;

/// Says whether faces with some normals make an edge or a corner.
void find_sharpness(std::span<const Vec3> normals, DualVertex& vertex) {
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
bool find_place(const SurfacePlaces& places, std::span<const std::size_t> faces, Vec3& place) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (std::size_t j = i + 1; j < faces.size(); ++j)
      if (places.meet_on_the_way(std::array{faces[i], faces[j]}, place)) return true;
  }
  return std::ranges::any_of(
      faces, [&](std::size_t face) { return places.meet(std::span(&face, 1), place); });
}

}  // namespace

std::size_t DualMesher::PlaceHash::operator()(const Vec3& place) const {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    hash ^= std::bit_cast<std::uint64_t>(place[axis]);
    hash *= 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return hash;
}

DualMesh DualMesher::mesh() {
  const std::vector<SurfaceEdge> before = std::exchange(edges_, {});
  find_edges();
  take_over(before);
  find_crossings();
  place_vertices();
  find_diagonals();
  DualMesh mesh;
  mesh.vertices = cells_.vertices;
  for (const SurfaceEdge& edge : edges_) add_polygon(edge, mesh);
  close(mesh.vertices, mesh.triangles, mesh.tangled);
  for (const DualVertex& vertex : mesh.vertices)
    if (!vertex.is_plain) mesh.tangled.push_back(vertex.cell);
  return mesh;
}

std::uint32_t DualMesher::corner_at(const Vec3& place, std::uint32_t cell) {
  const auto [found, is_new] =
      corner_numbers_.emplace(place, static_cast<std::uint32_t>(corners_.size()));
  if (is_new) corners_.push_back({.place = place, .cell = cell});
  return found->second;
}

/// Finds the edges whose ends are on different sides of the surface.
void DualMesher::find_edges() {
  struct Ends {
    GridEdge edge;
    std::uint32_t from;
    std::uint32_t to;
  };
  std::vector<Ends> open;
  partition_.for_each_edge([&](const GridEdge& edge) {
    const Ends ends{edge, corner_at(edge.from, edge.cells[0]),
                    corner_at(edge.end(), edge.cells[0])};
    // A cell of which all is known says what its corners are.
    bool is_known = false;
    for (const std::uint32_t cell : edge.cells) {
      if (node(cell).look.is_open()) continue;
      is_known = true;
      const bool is_full = node(cell).look.kind == CellLook::Kind::full;
      for (const std::uint32_t end : {ends.from, ends.to}) {
        corners_[end].is_known = true;
        corners_[end].is_inside = corners_[end].is_inside || is_full;
      }
    }
    if (!is_known) open.push_back(ends);
  });
  find_corners();
  for (const Ends& ends : open) {
    const bool starts = corners_[ends.from].is_inside;
    if (starts != corners_[ends.to].is_inside)
      edges_.push_back({.grid = ends.edge, .starts_inside = starts});
  }
}

void DualMesher::find_corners() {
  for_ranges(corners_.size(), items_of_task, clock_.workers(),
             [&](std::size_t begin, std::size_t end) {
               for (std::size_t i = begin; i < end; ++i) {
                 GridCorner& corner = corners_[i];
                 if (corner.is_known) continue;
                 const CellLook look =
                     solid_.look({{corner.place, corner.place}, node(corner.cell).look.program});
                 corner.is_inside = look.kind == CellLook::Kind::full;
                 corner.is_known = true;
               }
             });
}

/// Takes over what is known of edges that were there before.
void DualMesher::take_over(const std::vector<SurfaceEdge>& before) {
  // An edge is known by its middle.
  const auto key_of = [](const SurfaceEdge& edge) {
    return 0.5 * edge.grid.from + 0.5 * edge.grid.end();
  };
  std::unordered_map<Vec3, const SurfaceEdge*, PlaceHash> known;
  known.reserve(before.size());
  for (const SurfaceEdge& edge : before) known.emplace(key_of(edge), &edge);
  for (SurfaceEdge& edge : edges_) {
    const auto found = known.find(key_of(edge));
    if (found == known.end()) continue;
    const SurfaceEdge& old = *found->second;
    const bool is_same = old.grid.axis == edge.grid.axis && old.grid.from == edge.grid.from &&
                         old.grid.to == edge.grid.to && old.starts_inside == edge.starts_inside;
    if (!is_same) continue;
    edge.crossing = old.crossing;
    edge.has_crossing = true;
    edge.is_even = old.is_even;
    edge.has_diagonal = old.has_diagonal && old.grid.cells == edge.grid.cells;
  }
}

void DualMesher::find_crossings() {
  for_ranges(edges_.size(), items_of_task, clock_.workers(),
             [&](std::size_t begin, std::size_t end) {
               for (std::size_t i = begin; i < end; ++i) {
                 SurfaceEdge& edge = edges_[i];
                 if (edge.has_crossing) continue;
                 const SurfacePlaces places(solid_, node(plainest_cell(edge.grid)));
                 const Vec3 to = edge.grid.end();
                 edge.crossing = edge.starts_inside ? places.between(edge.grid.from, to)
                                                    : places.between(to, edge.grid.from);
               }
             });
}
/// Returns the cell at an edge that knows its faces, and has the fewest.
std::uint32_t DualMesher::plainest_cell(const GridEdge& edge) const {
  std::uint32_t best = edge.cells[0];
  const auto rank = [&](std::uint32_t cell) {
    const CellLook& look = node(cell).look;
    return look.kind == CellLook::Kind::crossed ? look.faces.size() : CellLook::max_faces + 1;
  };
  for (const std::uint32_t cell : edge.cells)
    if (rank(cell) < rank(best)) best = cell;
  return best;
}

void DualMesher::place_vertices() {
  const CellVertices before = std::exchange(cells_, {});
  auto& crossings = cells_.crossings;
  for (const SurfaceEdge& edge : edges_) {
    for (std::size_t i = 0; i < 4; ++i) {
      const auto others = edge.grid.cells.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::find(edge.grid.cells.begin(), others, edge.grid.cells[i]) == others)
        crossings.emplace_back(edge.grid.cells[i], edge.crossing);
    }
  }
  std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b) {
    const auto key = [](const auto& of_cell) {
      return std::tuple(of_cell.first, of_cell.second.x, of_cell.second.y, of_cell.second.z);
    };
    return key(a) < key(b);
  });
  cells_.of_cell.assign(partition_.node_count(), invalid_index);
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (i > 0 && crossings[i].first == crossings[i - 1].first) continue;
    cells_.of_cell[crossings[i].first] = static_cast<std::uint32_t>(cells_.starts.size());
    cells_.starts.push_back(i);
  }
  const std::size_t count = cells_.starts.size();
  cells_.starts.push_back(crossings.size());
  cells_.vertices.resize(count);
  cells_.is_new.resize(count);
  for_ranges(count, items_of_task, clock_.workers(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const auto here = cells_.crossings_of(static_cast<std::uint32_t>(v));
      const std::uint32_t cell = here.front().first;
      const std::uint32_t old = cell < before.of_cell.size() ? before.of_cell[cell] : invalid_index;
      cells_.is_new[v] =
          old == invalid_index || !std::ranges::equal(before.crossings_of(old), here);
      cells_.vertices[v] = cells_.is_new[v] != 0 ? vertex(here) : before.vertices[old];
    }
  });
}

DualVertex DualMesher::vertex(std::span<const CellCrossing> cell_crossings) const {
  const std::uint32_t cell = cell_crossings.front().first;
  std::vector<Vec3> crossings;
  crossings.reserve(cell_crossings.size());
  for (const CellCrossing& crossing : cell_crossings) crossings.push_back(crossing.second);
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

/// Returns the corners of an edge's polygon, counter-clockwise from outside.
DualMesher::Polygon DualMesher::polygon_of(const SurfaceEdge& edge) const {
  Polygon polygon;
  auto& [corners, count] = polygon;
  for (const std::uint32_t cell : edge.grid.cells) {
    const std::uint32_t vertex = cells_.of_cell[cell];
    if (count == 0 || corners[count - 1] != vertex) corners[count++] = vertex;
  }
  if (count > 1 && corners[count - 1] == corners[0]) --count;
  if (!edge.starts_inside)
    std::reverse(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(count));
  return polygon;
}

/// Finds the diagonals by which polygons of four corners become triangles.
void DualMesher::find_diagonals() {
  for_ranges(edges_.size(), items_of_task, clock_.workers(),
             [&](std::size_t begin, std::size_t end) {
               for (std::size_t i = begin; i < end; ++i) {
                 SurfaceEdge& edge = edges_[i];
                 const Polygon polygon = polygon_of(edge);
                 if (polygon.count < 4) continue;
                 const bool is_new = std::ranges::any_of(
                     polygon.corners, [&](std::uint32_t v) { return cells_.is_new[v] != 0; });
                 if (edge.has_diagonal && !is_new) continue;
                 edge.is_even = is_even_nearer(polygon.corners);
                 edge.has_diagonal = true;
               }
             });
}

void DualMesher::add_polygon(const SurfaceEdge& edge, DualMesh& mesh) const {
  auto [corners, count] = polygon_of(edge);
  if (count < 3) return;
  if (count == 4 && !edge.is_even) std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  mesh.triangles.push_back({corners[0], corners[1], corners[2]});
  if (count == 4) mesh.triangles.push_back({corners[0], corners[2], corners[3]});
}

/// Returns whether the diagonal from the first of four corners is nearer to the surface than that
/// from the second.
bool DualMesher::is_even_nearer(const std::array<std::uint32_t, 4>& corners) const {
  const double even = distance_of_middle(corners, corners[0], corners[2]);
  const double odd = distance_of_middle(corners, corners[1], corners[3]);
  constexpr double equal = 1e-9;
  const double length_even = length_of(corners[0], corners[2]);
  const double length_odd = length_of(corners[1], corners[3]);
  const double slack = equal * std::max(length_even, length_odd);
  return std::abs(even - odd) <= slack ? length_even <= length_odd : even < odd;
}

double DualMesher::length_of(std::uint32_t a, std::uint32_t b) const {
  return glm::length(cells_.vertices[a].place - cells_.vertices[b].place);
}
/// Returns how far the middle between two corners is from the surface, as far as the cells around
/// know.
double DualMesher::distance_of_middle(const std::array<std::uint32_t, 4>& around, std::uint32_t a,
                                      std::uint32_t b) const {
  const Vec3 middle = 0.5 * cells_.vertices[a].place + 0.5 * cells_.vertices[b].place;
  double most = 0;
  for (const std::uint32_t vertex : around) {
    const SurfacePlaces places(solid_, node(cells_.vertices[vertex].cell));
    double distance = infinity;
    places.nearest(places.pulls_at(middle), distance);
    if (distance < infinity) most = std::max(most, distance);
  }
  return most;
}

}  // namespace crt::core
