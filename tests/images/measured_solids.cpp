#include "images/measured_solids.hpp"

#include <crt/measure.hpp>
#include <crt/script.hpp>
#include <crt/section.hpp>
#include <crt/surface_mesh.hpp>
#include <span>

#include "images/example_pictures.hpp"
#include "images/number_bytes.hpp"

namespace crt::tests {

namespace {

constexpr std::size_t max_solids = 3;

/// Returns points on a grid over a box, a little larger than that.
std::vector<Vec3> grid_over(const BoundingBox& box) {
  constexpr int steps = 5;
  std::vector<Vec3> points;
  const auto share = [](int i) { return -0.1 + 1.2 * i / (steps - 1); };
  for (int i = 0; i < steps * steps * steps; ++i) {
    const Vec3 shares(share(i % steps), share(i / steps % steps), share(i / steps / steps));
    points.push_back(box.lower + shares * (box.upper - box.lower));
  }
  return points;
}

/// Returns the solids of a script that have bounds, or the first of them.
std::vector<Entity> solids_of(const std::filesystem::path& script) {
  std::vector<Entity> solids;
  const ScriptResult result = run_script_file(script);
  for (const Entity& entity : result.scene.value().entities) {
    if (solids.size() == max_solids || !entity.is_solid()) continue;
    const Vec3 size = bounding_box(entity).upper - bounding_box(entity).lower;
    if (size.x + size.y + size.z < 1e300) solids.push_back(entity);
  }
  return solids;
}

/// A Measured is what one kind of measure says of all solids.
using Measured = void (*)(std::span<const Entity>, NumberBytes&);

void add_mass(std::span<const Entity> solids, NumberBytes& bytes) {
  for (const Entity& solid : solids) {
    bytes.add(volume(solid, {.relative_width = 1e-5}));
    const MassProperties mass = mass_properties(solid, {.relative_width = 1e-2});
    bytes.add(mass.area);
    for (const Interval& interval : mass.centroid) bytes.add(interval);
    for (const Interval& interval : mass.inertia) bytes.add(interval);
  }
}

void add_bounds(std::span<const Entity> solids, NumberBytes& bytes) {
  for (const Entity& solid : solids) {
    const BoundingBox box = tight_bounding_box(solid, {.relative_width = 1e-4});
    bytes.add(box.lower);
    bytes.add(box.upper);
  }
}

void add_points(std::span<const Entity> solids, NumberBytes& bytes) {
  for (const Entity& solid : solids) {
    const std::vector<Vec3> points = grid_over(bounding_box(solid));
    std::vector<PointSide> sides(points.size());
    contains(solid, points, sides);
    std::vector<NearestPoint> nearest(points.size());
    nearest_points(solid, points, nearest, {.relative_width = 1e-6});
    for (std::size_t i = 0; i < points.size(); ++i) {
      bytes.add(static_cast<double>(sides[i]));
      bytes.add(nearest[i].distance);
      bytes.add(nearest[i].point);
      for (const LinePiece& piece : thickness_along(solid, points[i], {1, 2, 3})) {
        bytes.add(piece.from);
        bytes.add(piece.to);
      }
    }
  }
}

void add_pairs(std::span<const Entity> solids, NumberBytes& bytes) {
  for (const Overlap& overlap : interference(solids, {.relative_width = 1e-3}))
    bytes.add(overlap.volume);
  for (const Entity& solid : solids) {
    const BoundingBox box = bounding_box(solid);
    const Vec3 away = 1.5 * (box.upper - box.lower);
    const Clearance found =
        clearance(solid, solid.transformed(translate(away)), {.relative_width = 1e-6});
    bytes.add(found.distance);
    bytes.add(found.on_a);
    bytes.add(found.on_b);
  }
}

void add_walls(std::span<const Entity> solids, NumberBytes& bytes) {
  for (const Entity& solid : solids) {
    const Wall wall = least_wall(solid);
    bytes.add(wall.thickness);
    bytes.add(wall.from);
    bytes.add(wall.to);
  }
}

void add_sections(std::span<const Entity> solids, NumberBytes& bytes) {
  for (const Entity& solid : solids) {
    const BoundingBox box = bounding_box(solid);
    const double height = 0.5 * (box.lower.y + box.upper.y);
    const Section cut = section(solid, {0, 1, 0}, height, usual_deviation({&solid, 1}));
    bytes.add(cut.area);
    bytes.add(cut.deviation);
    for (const SectionPolyline& line : section_polylines(cut))
      for (const Vec3& point : line) bytes.add(point);
  }
}

void add_meshes(std::span<const Entity> solids, NumberBytes& bytes) {
  for (const Entity& solid : solids) {
    const SurfaceMesh mesh = tessellate(solid, 4 * usual_deviation({&solid, 1}));
    bytes.add(mesh.deviation);
    for (const Vec3& position : mesh.positions) bytes.add(position);
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t corner : triangle) bytes.add_word(corner);
  }
}

constexpr std::pair<const char*, Measured> kinds[] = {
    {"mass", add_mass},   {"bounds", add_bounds},     {"points", add_points},
    {"pairs", add_pairs}, {"sections", add_sections}, {"meshes", add_meshes},
    {"walls", add_walls},
};

}  // namespace

std::vector<std::filesystem::path> measured_scripts() {
  std::vector<std::filesystem::path> scripts;
  for (const char* name : {"measure/bracket", "measure/housing", "measure/plate", "scenes/flange",
                           "scenes/quadrics", "scenes/primitives"})
    scripts.push_back(examples_path() / (std::string(name) + ".crt"));
  return scripts;
}

NamedHashes hashes_of_measures(const std::filesystem::path& script) {
  const std::vector<Entity> solids = solids_of(script);
  NamedHashes result;
  for (const auto& [kind, add] : kinds) {
    NumberBytes bytes;
    add(solids, bytes);
    result.emplace_back(script.stem().string() + ":" + kind, bytes.hash());
  }
  return result;
}

}  // namespace crt::tests
