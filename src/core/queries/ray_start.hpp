// A RayStart is what a hit gives to a ray that goes on from it: the identity of the surface.
#pragma once

#include <optional>

#include "core/prepare/prepared_data.hpp"
#include "crt/query.hpp"

namespace crt::core {

/// Returns the start of rays that go on from a hit.
RayStart start_of(const RayHit& hit);

/// Returns whether a start is nowhere or of a hit in this scene, as far as one can see.
bool is_of_scene(const PreparedData& data, const RayStart& start);

/// Returns what a start says, or nothing for one that is nowhere. Throws Error (invalid_argument)
/// for one that is not of this scene; `argument` names it.
std::optional<RayHit> read_start(const PreparedData& data, const RayStart& start,
                                 const char* argument);

/// Lets a ray begin on the surface of a hit, to the side that its direction says. That is where the
/// ray has its origin, or where its t_min is if that is where it meets the surface.
void begin_on(const PreparedData& data, const RayHit& surface, WorldRay& ray, RayWorkspace& work);

/// Lets a ray end on the surface of a hit.
void end_on(const PreparedData& data, const RayHit& surface, WorldRay& ray);

}  // namespace crt::core
