// This turns what the studio knows into the messages of docs/studio.md. Places in them are units of
// UTF-16.
#pragma once

#include <crt/image.hpp>
#include <crt/language_service.hpp>
#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "studio/analyst.hpp"
#include "studio/renderer.hpp"

namespace crt::studio {

nlohmann::json diagnostics_message(const Analysis& analysis);
nlohmann::json state_message(const RenderState& state);
nlohmann::json scene_message(const View& view);
nlohmann::json finished_message(const Revision& revision, const Image& image);
nlohmann::json objects_json();

nlohmann::json completion_json(const Analysis& analysis, std::uint32_t unit);
nlohmann::json hover_json(const Analysis& analysis, std::uint32_t unit);
nlohmann::json definition_json(const Analysis& analysis, std::uint32_t unit);
nlohmann::json places_json(const Analysis& analysis, std::uint32_t unit);
/// Answers with the places that get a new name, and the other files that have the old one. Throws
/// Error (invalid_argument) where it cannot be changed.
nlohmann::json rename_json(const Analysis& analysis, std::uint32_t unit, const std::string& name);
nlohmann::json format_json(const Analysis& analysis);

/// Answers which entity a place of the picture shows. It is null where there is none.
nlohmann::json pick_json(const View& view, double x, double y);

/// Returns the first entity that comes from within a piece of the text, or else around it: two
/// places. Throws what the JSON library throws, and Error (invalid_argument) where there is none.
std::size_t entity_of_span(const View& view, const nlohmann::json& span);

/// Answers with source code: that of the scene, or of the first entity that comes from a piece of
/// the text. The question has `language`, and perhaps a `span`. Throws what the JSON library
/// throws, and Error.
nlohmann::json code_json(const View& view, const nlohmann::json& question);

/// Reads a camera. Throws what the JSON library throws, and Error (invalid_argument).
Camera camera_of(const nlohmann::json& value);

/// Writes a message. Bytes that are no UTF-8 are replaced.
std::string text_of(const nlohmann::json& message);

}  // namespace crt::studio
