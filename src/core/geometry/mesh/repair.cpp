#include "core/geometry/mesh/repair.hpp"

#include <cmath>
#include <utility>

#include "core/geometry/checks.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

void check_distance(const char* name, double distance) {
  constexpr double largest = 1e100;
  if (distance >= 0 && distance <= largest) return;
  reject(name, text::format("must be from 0 to 1e100 (it is {})", distance).c_str());
}

/// Returns a copy that may be changed.
RepairedMesh copy_of(const GivenMesh& given) {
  RepairedMesh mesh{.positions = given.positions,
                    .triangles = {given.triangles.begin(), given.triangles.end()},
                    .attributes = given.attributes};
  if (!mesh.attributes.normals.empty() && mesh.attributes.normal_indices.empty())
    mesh.attributes.normal_indices = mesh.triangles;
  if (!mesh.attributes.uv.empty() && mesh.attributes.uv_indices.empty())
    mesh.attributes.uv_indices = mesh.triangles;
  return mesh;
}

bool is_flat(const TriangleIndices& corners) {
  const auto [a, b, c] = corners;
  return a == b || b == c || c == a;
}

/// Gives the triangles the numbers of equal positions and then of those within a tolerance.
void weld(RepairedMesh& mesh, double tolerance, MeshReport& report) {
  const std::vector<std::uint32_t> equal = first_within(mesh.positions, 0);
  const std::vector<std::uint32_t> near =
      tolerance > 0 ? first_within(mesh.positions, tolerance) : equal;
  for (std::uint32_t i = 0; i < equal.size(); ++i)
    report.welded_vertices += equal[i] == i && near[i] != i ? 1 : 0;
  for (TriangleIndices& corners : mesh.triangles) {
    TriangleIndices exact = corners;
    for (std::uint32_t& corner : exact) corner = equal[corner];
    for (std::uint32_t& corner : corners) corner = near[corner];
    report.welded_triangles += !is_flat(exact) && is_flat(corners) ? 1 : 0;
  }
}

}  // namespace

std::shared_ptr<const MeshTriangles> make_mesh_triangles(const GivenMesh& given,
                                                         const MeshOptions& options,
                                                         std::optional<FillRule> fill,
                                                         MeshReport report) {
  check_distance("weld", options.weld);
  check_distance("stitch", options.stitch);
  if (fill && *fill != FillRule::nonzero && *fill != FillRule::even_odd)
    reject("fill", "must be FillRule::nonzero or FillRule::even_odd");
  report.reported = options.warn != nullptr;
  std::shared_ptr<const MeshTriangles> result;
  if (options.weld == 0 && options.stitch == 0) {
    result = std::make_shared<const MeshTriangles>(given.positions, given.triangles,
                                                   &given.attributes, fill, std::move(report));
  } else {
    check_mesh(given.positions, given.triangles, &given.attributes);
    RepairedMesh mesh = copy_of(given);
    weld(mesh, options.weld, report);
    if (options.weld > 0) {
      report.warnings.push_back(
          text::format("weld has made {} of its vertices others, and {} of its triangles went",
                       report.welded_vertices, report.welded_triangles));
    }
    if (options.stitch > 0) {
      report.stitched_vertices = stitch(mesh, options.stitch);
      report.warnings.push_back(
          text::format("stitch has put {} vertices into edges", report.stitched_vertices));
    }
    result = std::make_shared<const MeshTriangles>(mesh.positions, mesh.triangles, &mesh.attributes,
                                                   fill, std::move(report));
  }
  if (!options.warn) return result;
  for (const std::string& warning : result->report().warnings) options.warn(warning);
  return result;
}

}  // namespace crt::core
