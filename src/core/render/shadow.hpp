// Shadow rays find how much of a light gets through to a point.
#pragma once

#include "core/render/workspace.hpp"

namespace crt::core {

/// Returns the share of light, by channel, that is left on the path along `ray` to its t_max. All
/// crossings on it are of transparent things. These tint the light at each crossing. Where solids
/// absorb, the innermost around the ray absorbs by the length inside. `media` are those around the
/// ray's start, of `lists`.
Rgb light_share(const PreparedData& data, const WorldRay& ray, std::span<const RayHit> crossings,
                const MediaLists& lists, MediaLists::List media, Workspace& work);

}  // namespace crt::core
