// Cells are divided until a mesh of them is proved to be near enough. Those are divided whose
// triangles, or whose surface, are not.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "core/geometry/mesh/equal_positions.hpp"
#include "core/math/float_environment.hpp"
#include "core/measure/entity_cells.hpp"
#include "core/measure/measure_clock.hpp"
#include "core/tasks/parallel.hpp"
#include "core/tessellate/closed_triangles.hpp"
#include "core/tessellate/deviation_proof.hpp"
#include "core/tessellate/dual_mesh.hpp"
#include "core/tessellate/simplify.hpp"
#include "crt/error.hpp"
#include "crt/surface_mesh.hpp"

namespace crt {

namespace core {

namespace {

class Tessellation {
 public:
  Tessellation(const CellSolid& solid, double deviation, MeasureClock& clock)
      : solid_(solid),
        deviation_(deviation),
        clock_(clock),
        partition_(solid, deviation, clock),
        mesher_(solid, partition_, clock) {}

  /// Returns whether the mesh is proved.
  bool run() {
    constexpr int most_rounds = 64;
    for (int round = 0; round < most_rounds; ++round) {
      const bool is_fine = partition_.refine();
      mesh_ = mesher_.mesh();
      if (!is_fine || clock_.is_over()) return false;
      bool is_divided = divide(mesh_.tangled, CellPartition::Aim::apart);
      is_divided = divide(cells_off_surface(), CellPartition::Aim::near) || is_divided;
      if (is_divided) continue;
      // What is near a triangle that changes would change, too.
      if (is_near_surface_ && !has_gaps_ && simplify()) return true;
      const std::set<std::uint32_t> cells = cells_off_mesh();
      if (cells.empty() && is_near_surface_) {
        simplify();
        return true;
      }
      if (!divide(cells, CellPartition::Aim::covered)) return false;
    }
    return false;
  }
  const DualMesh& mesh() const { return mesh_; }

 private:
  static constexpr std::size_t items_of_task = 16;
  using TriangleKey = std::array<double, 18>;

  template <class Cells>
  bool divide(const Cells& cells, CellPartition::Aim aim) {
    bool is_divided = false;
    for (const std::uint32_t cell : cells) is_divided = partition_.divide(cell, aim) || is_divided;
    return is_divided;
  }

  /// Finds the cells of triangles that are not proved to be near the surface.
  std::set<std::uint32_t> cells_off_surface() {
    const SurfaceProof proof(solid_, partition_, deviation_);
    const auto count = static_cast<std::uint32_t>(mesh_.triangles.size());
    std::vector<char> is_near(count);
    for_each(count, [&](std::uint32_t i) {
      is_near[i] = proved_.contains(key_of(i)) ||
                   proof.is_near_surface({&vertex_of(i, 0), &vertex_of(i, 1), &vertex_of(i, 2)});
    });
    std::set<std::uint32_t> cells;
    std::set<TriangleKey> proved;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (is_near[i] != 0)
        proved.insert(key_of(i));
      else
        add_cells_of(i, cells);
    }
    proved_ = std::move(proved);
    is_near_surface_ = cells.empty();
    return cells;
  }
  /// Finds the cells with surface that is not proved to be near the mesh.
  std::set<std::uint32_t> cells_off_mesh() {
    std::vector<std::uint32_t> all;
    for (std::uint32_t i = 0; i < partition_.node_count(); ++i)
      if (partition_.node(i).is_leaf()) all.push_back(i);
    return cells_off_mesh(all);
  }
  /// Finds those among some.
  template <class Cells>
  std::set<std::uint32_t> cells_off_mesh(const Cells& some) {
    const std::vector<std::uint32_t> cells(some.begin(), some.end());
    const MeshProof proof(solid_, partition_, mesh_, deviation_);
    std::vector<char> is_covered(cells.size());
    for_each(static_cast<std::uint32_t>(cells.size()),
             [&](std::uint32_t i) { is_covered[i] = proof.is_near_mesh(cells[i]); });
    std::set<std::uint32_t> off;
    for (std::uint32_t i = 0; i < is_covered.size(); ++i)
      if (is_covered[i] == 0) off.insert(cells[i]);
    return off;
  }

  /// Takes triangles away while all stays proved. Returns false, and takes none, if it is not
  /// before.
  bool simplify() {
    const DualMesh whole = mesh_;
    std::vector<char> kept(whole.vertices.size(), 0);
    constexpr int most_tries = 6;
    for (int attempt = 0; attempt < most_tries; ++attempt) {
      mesh_ = simplified(whole, SurfaceProof(solid_, partition_, deviation_), kept, clock_);
      const std::set<std::uint32_t> cells = cells_off_mesh();
      if (cells.empty()) return true;
      if (attempt == 0) {
        mesh_ = whole;
        has_gaps_ = !cells_off_mesh(cells).empty();
        if (has_gaps_) return false;
      }
      // Near such a cell too much was taken away.
      for (const std::uint32_t cell : cells) {
        const Bounds near = partition_.node(cell).box.grown(deviation_);
        for (std::size_t v = 0; v < kept.size(); ++v)
          if (near.touches({whole.vertices[v].place, whole.vertices[v].place})) kept[v] = 1;
      }
    }
    mesh_ = whole;
    return cells_off_mesh().empty();
  }
  template <class Work>
  void for_each(std::uint32_t count, const Work& work) {
    for_ranges(count, items_of_task, clock_.workers(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(static_cast<std::uint32_t>(i));
    });
  }
  TriangleKey key_of(std::uint32_t number) const {
    TriangleKey key{};
    std::size_t at = 0;
    for (const std::uint32_t corner : mesh_.triangles[number]) {
      for (int axis = 0; axis < 3; ++axis) {
        key[at++] = mesh_.vertices[corner].place[axis];
        key[at++] = mesh_.vertices[corner].outwards[axis];
      }
    }
    return key;
  }
  /// Adds the cells of a triangle's corners that are about as large as the largest of them, or
  /// whose corner does not show all of their faces.
  void add_cells_of(std::uint32_t number, std::set<std::uint32_t>& cells) const {
    std::array<double, 3> sizes{};
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Bounds& box = partition_.node(cell_of(number, i)).box;
      sizes[i] = glm::length(box.upper - box.lower);
      if (!partition_.is_small(cell_of(number, i))) largest = std::max(largest, sizes[i]);
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (2 * sizes[i] > largest || vertex_of(number, i).is_partial)
        cells.insert(cell_of(number, i));
  }
  const DualVertex& vertex_of(std::uint32_t triangle, std::size_t corner) const {
    return mesh_.vertices[mesh_.triangles[triangle][corner]];
  }
  std::uint32_t cell_of(std::uint32_t triangle, std::size_t corner) const {
    return vertex_of(triangle, corner).cell;
  }

  const CellSolid& solid_;
  double deviation_;
  MeasureClock& clock_;
  CellPartition partition_;
  DualMesher mesher_;
  DualMesh mesh_;
  std::set<TriangleKey> proved_;
  bool is_near_surface_ = false;  ///< all triangles are
  bool has_gaps_ = false;         ///< there was surface that is not near the whole mesh
};

/// Returns the triangles that a solid is made of as a closed mesh, or an empty one.
DualMesh own_mesh_of(const CellSolid& solid, double deviation) {
  constexpr double rounding = 0x1p-44;
  if (!(deviation > rounding * solid.bounds().farthest())) return {};
  std::vector<Vec3> corners;
  for (const Triangle& triangle : solid.own_triangles())
    corners.insert(corners.end(), {triangle.a, triangle.b, triangle.c});
  const std::vector<std::uint32_t> firsts = first_equal(corners);
  DualMesh mesh;
  std::vector<std::uint32_t> numbers(corners.size());
  for (std::uint32_t i = 0; i < corners.size(); ++i) {
    if (firsts[i] != i) {
      numbers[i] = numbers[firsts[i]];
      continue;
    }
    numbers[i] = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back().place = corners[i];
  }
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    const std::array<std::uint32_t, 3> triangle = {numbers[i], numbers[i + 1], numbers[i + 2]};
    // Where it was placed, rounding may have made two corners one.
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      return {};
    mesh.triangles.push_back(triangle);
  }
  close(mesh.vertices, mesh.triangles, mesh.tangled);
  return mesh.tangled.empty() ? mesh : DualMesh{};
}

}  // namespace

}  // namespace core

SurfaceMesh tessellate(const Entity& entity, double deviation, const MeasureOptions& options) {
  if (!(deviation > 0 && deviation < core::infinity))
    throw Error(ErrorCode::invalid_argument, "deviation must be above 0 and finite", "deviation");
  core::validate(options);
  return core::measured([&] {
    core::EntityCells cells(entity);
    cells.check_bounded();
    cells.unite_near_faces();
    core::MeasureClock clock(options);
    SurfaceMesh result;
    result.deviation = deviation;
    for (const core::CellSolid& solid : cells.solids()) {
      core::DualMesh mesh = core::own_mesh_of(solid, deviation);
      if (mesh.triangles.empty()) {
        core::Tessellation tessellation(solid, deviation, clock);
        if (!tessellation.run() || solid.has_united_faces()) result.deviation = core::infinity;
        mesh = tessellation.mesh();
      }
      const auto first = static_cast<std::uint32_t>(result.positions.size());
      for (const core::DualVertex& vertex : mesh.vertices) result.positions.push_back(vertex.place);
      for (const auto& [a, b, c] : mesh.triangles)
        result.triangles.push_back({first + a, first + b, first + c});
    }
    return result;
  });
}

}  // namespace crt
