#include "cli/export_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <crt/schema_settings.hpp>
#include <crt/surface_mesh.hpp>
#include <string>
#include <vector>

#include "cli/interrupt.hpp"
#include "cli/intervals.hpp"

namespace crt::cli {

namespace {

/// A MeshedEntity is an entity whose surface is a part of the file.
struct MeshedEntity {
  std::size_t place = 0;
  SurfaceMesh mesh;
};

/// Returns the places of the entities that are asked for.
std::vector<std::size_t> places_of(const Scene& scene, const ExportRequest& request) {
  std::vector<std::size_t> places;
  if (!request.entity) {
    places.resize(scene.entities.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
    return places;
  }
  const auto place = static_cast<std::size_t>(*request.entity);
  if (place < scene.entities.size()) return {place};
  throw Error(ErrorCode::invalid_argument,
              fmt::format("there is no entity {}: the scene has {}, which count from 0", place,
                          scene.entities.size()));
}

/// Makes triangles of the solids. One that is asked for alone must be one.
std::vector<MeshedEntity> meshes_of(const Scene& scene, const ExportRequest& request,
                                    double deviation, Reporter& reporter) {
  const InterruptScope interrupt;
  MeasureOptions options{.go_on = [&] { return !interrupt.interrupted(); }};
  if (request.seconds) options.seconds = *request.seconds;
  std::vector<MeshedEntity> meshes;
  for (const std::size_t place : places_of(scene, request)) {
    try {
      MeshedEntity made{.place = place,
                        .mesh = tessellate(scene.entities[place], deviation, options)};
      if (!std::isfinite(made.mesh.deviation))
        reporter.warn(
            fmt::format("entity {}: its triangles could not be proved to be within the "
                        "deviation of its surface",
                        place));
      if (!made.mesh.triangles.empty()) meshes.push_back(std::move(made));
    } catch (const Error& error) {
      if (request.entity || error.code() != ErrorCode::invalid_argument) throw;
      reporter.warn(fmt::format("entity {} is left out: {}", place, error.what()));
    }
  }
  return meshes;
}

}  // namespace

bool writes_mesh(const ExportRequest& request) {
  if (request.language || request.output.empty()) return false;
  try {
    surface_mesh_format(request.output);
    return true;
  } catch (const Error& error) {
    // A build without mesh files says so where one is asked for.
    if (error.code() == ErrorCode::unsupported) return false;
    throw;
  }
}

void export_mesh(const Scene& scene, const ExportRequest& request, Reporter& reporter) {
  std::vector<Entity> wanted;
  for (const std::size_t place : places_of(scene, request)) wanted.push_back(scene.entities[place]);
  const double deviation = request.deviation ? *request.deviation : usual_deviation(wanted);
  const std::vector<MeshedEntity> meshes = meshes_of(scene, request, deviation, reporter);
  std::vector<SurfaceMeshPart> parts;
  parts.reserve(meshes.size());
  std::size_t triangles = 0;
  double largest = 0;
  for (const MeshedEntity& made : meshes) {
    parts.push_back({.mesh = &made.mesh,
                     .name = fmt::format("entity {}", made.place),
                     .color = plain_color(scene.entities[made.place])});
    triangles += made.mesh.triangles.size();
    largest = std::max(largest, made.mesh.deviation);
  }
  write_surface_mesh(request.output, parts, {.unit = scene.settings.unit});
  const std::string_view unit = schema::script_name_of(scene.settings.unit);
  const std::string proved =
      std::isfinite(largest)
          ? fmt::format(", within {} {} of the surface", end_text(largest, largest, true), unit)
          : std::string();
  reporter.note(fmt::format("{}: {} triangles{}", request.output.string(), triangles, proved));
}

}  // namespace crt::cli
