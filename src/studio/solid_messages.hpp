// The messages about solids: how much one is, and its surface as triangles.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "studio/renderer.hpp"

namespace crt::studio {

/// A SurfaceQuestion asks for a file of triangles.
struct SurfaceQuestion {
  std::string format;                 ///< "stl", "obj", "ply", "3mf" or "glb"
  double deviation = 0;               ///< 0 for one that fits the size of all
  std::optional<std::size_t> entity;  ///< none for all solids
};

/// Says how much an entity is. Bounds are null and a `fault` says why, where it has none. It takes
/// some seconds at most. Throws Error (cancelled) if nobody waits any more.
nlohmann::json measures_json(const View& view, std::size_t entity,
                             const std::function<bool()>& goes_on);

/// Reads a question. Throws what the JSON library throws, and Error.
SurfaceQuestion surface_question_of(const View& view, const nlohmann::json& message);

/// Returns the message that a file of triangles is. Throws Error as tessellate() does, and if there
/// is no solid.
std::string surface_message(const View& view, const SurfaceQuestion& question,
                            const std::function<bool()>& goes_on);

}  // namespace crt::studio
