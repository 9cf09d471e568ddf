// Shadow rays: how much of a light gets through to a point.
#pragma once

#include "core/render/workspace.hpp"

namespace crt::core {

/// The share of light, by channel, that the way along `ray` to its t_max leaves, on which all
/// crossings are of transparent things. These tint it at each crossing, and where solids absorb
/// (the innermost around the ray does) by the length inside. `media` are those around the ray's
/// start, of `lists`.
Rgb light_share(const PreparedData& data, const WorldRay& ray, std::span<const RayHit> crossings,
                const MediaLists& lists, MediaLists::List media, Workspace& work);

}  // namespace crt::core
