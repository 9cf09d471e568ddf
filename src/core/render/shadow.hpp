// Shadow rays: how much of a light gets through to a point.
#pragma once

#include "core/render/workspace.hpp"

namespace crt::core {

/// Where something is transparent: the share of light, by channel, that the way along `ray` to its t_max
/// leaves. Transparent things tint it at each crossing, and where solids absorb (the innermost around the ray
/// does) by the length inside. `media` are those around the ray's start, of `lists`.
Rgb light_share(const PreparedData& data, const WorldRay& ray, MediaLists& lists, MediaLists::List media,
                Workspace& work);

}  // namespace crt::core
