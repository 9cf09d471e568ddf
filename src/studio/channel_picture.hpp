// This makes the channels of a picture visible: distances as grey, numbers of entities as colours.
#pragma once

#include <crt/image.hpp>
#include <crt/render.hpp>
#include <cstdint>
#include <vector>

#include "studio/view_options.hpp"

namespace crt::studio {

/// Returns what a render must report for a channel to be shown.
Aovs aovs_of(Channel channel);

/// Says whether a channel needs no light, and so no more than one camera ray a pixel.
bool is_geometric(Channel channel);

/// Returns 8-bit RGBA of a channel of a picture. What is not rendered yet is transparent.
std::vector<std::uint8_t> displayed(const Image& image, Channel channel);

/// Puts a part of a picture at its place in a picture that is transparent beside it.
std::vector<std::uint8_t> placed(const std::vector<std::uint8_t>& rgba, const Region& region,
                                 int width, int height);

}  // namespace crt::studio
