// `crt export` writes the solids of a scene as triangles.
#pragma once

#include <crt/scene.hpp>

#include "cli/options.hpp"
#include "cli/reporter.hpp"

namespace crt::cli {

/// Says whether the ending of the output's name is that of a mesh file.
bool writes_mesh(const ExportRequest& request);

/// Writes the solids that are asked for. What is no solid or has no end is left out with a warning.
/// Throws Error if nothing is left.
void export_mesh(const Scene& scene, const ExportRequest& request, Reporter& reporter);

}  // namespace crt::cli
