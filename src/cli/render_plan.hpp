// This settles, before any work is done, which pictures `crt render` makes of which scripts.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "cli/reporter.hpp"
#include "cli/script_source.hpp"

namespace crt::cli {

struct PlannedPicture {
  ScriptSource script;
  std::filesystem::path output;  ///< "-" is standard output
  bool is_film = false;          ///< of all frames
};

/// Returns a picture, or film, for each scene. Returns nothing if the request makes no sense or
/// something cannot be written, which is then reported.
std::optional<std::vector<PlannedPicture>> plan_pictures(const RenderRequest& request,
                                                         Reporter& reporter);

/// Returns the ending of pictures whose names say none: ".png", or ".exr" with channels beside the
/// colours.
const char* usual_ending(const PictureRequest& request);

}  // namespace crt::cli
