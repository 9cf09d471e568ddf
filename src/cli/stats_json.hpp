// What a rendering did, as JSON for programs.
#pragma once

#include <crt/camera.hpp>
#include <crt/render.hpp>
#include <optional>
#include <string>
#include <vector>

namespace crt::cli {

/// All that is told of one picture.
struct PictureReport {
  std::string script;
  std::string output;
  /// Of an animation.
  std::optional<int> frame;
  std::optional<Region> region;
  Settings settings;
  Projection projection = Projection::pinhole;
  RenderStats stats;
};

/// A JSON object.
std::string to_json(const PictureReport& report);

/// A JSON array of them.
std::string to_json(const std::vector<PictureReport>& reports);

}  // namespace crt::cli
