// Rays find lights by chance of which the surfaces that they come from may have taken samples.
#pragma once

#include "core/render/path_rays.hpp"
#include "core/render/surface_group.hpp"
#include "core/render/trace_context.hpp"

namespace crt::core {

/// Returns the shares that count of what a group of rays finds of a light, which it meets at t.
/// `chosen` is the light's number among the ChosenLights, or invalid_index if it is none of them.
Lanes shares_of_rays(const TraceContext& context, const PathRays& rays, std::size_t group,
                     const PreparedLight& light, std::uint32_t chosen, const Lanes& t);

/// Returns the shares that count of the light that surfaces, which a group of rays has met, give
/// off.
Lanes shares_of_emission(const TraceContext& context, const PathRays& rays, std::size_t group,
                         RayMask some, const SurfaceGroup& surfaces);

}  // namespace crt::core
