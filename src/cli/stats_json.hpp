// These functions write what a rendering did, as JSON for programs.
#pragma once

#include <crt/camera.hpp>
#include <crt/render.hpp>
#include <optional>
#include <string>
#include <vector>

namespace crt::cli {

/// Holds all that is reported of one picture.
struct PictureReport {
  std::string script;
  std::string output;
  /// The number of the frame is for animations.
  std::optional<int> frame;
  std::optional<Region> region;
  Settings settings;
  Projection projection = Projection::pinhole;
  RenderStats stats;
};

/// Returns a JSON object.
std::string to_json(const PictureReport& report);

/// Returns a JSON array of such objects.
std::string to_json(const std::vector<PictureReport>& reports);

}  // namespace crt::cli
