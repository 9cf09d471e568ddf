// The messages about what the live view shows: its options, boxes, and balls that show materials;
// and about the machine.
#pragma once

#include <crt/text_places.hpp>
#include <nlohmann/json_fwd.hpp>

#include "studio/analyst.hpp"
#include "studio/machine.hpp"
#include "studio/renderer.hpp"
#include "studio/view_options.hpp"

namespace crt::studio {

/// Reads options, whose places are those of a text. Throws what the JSON library throws, and Error
/// (invalid_argument).
ViewOptions view_options_of(const nlohmann::json& value, const TextPlaces& places);

/// Lists the boxes of what is shown and of what is cut from it, as far as they are found soon.
/// Sides at infinity are null.
nlohmann::json boxes_json(const View& view);

/// Answers with a picture of a ball of the material at a place, as a PNG file in base64. It is null
/// where there is no material, or one that cannot be made by itself.
nlohmann::json preview_json(const Analysis& analysis, std::uint32_t unit);

/// Returns the message `machine`. What the system does not say is left out.
nlohmann::json machine_message(const MachineState& state);

}  // namespace crt::studio
