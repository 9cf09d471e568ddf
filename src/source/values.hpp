// Materials, patterns, lights, cameras, backgrounds and settings become source code.
#pragma once

#include <memory>
#include <string>

#include "crt/scene.hpp"
#include "source/program.hpp"

namespace crt::source {

/// Returns the name of an image. Throws Error (unsupported) if no code can make it.
std::string image_name(Program& program, const std::shared_ptr<const Image>& image);

/// Returns the name of a material.
std::string material_name(Program& program, const SharedMaterial& shared);

// These return values, in C the names of structs.

std::string light_value(Program& program, const Light& light);
std::string camera_value(Program& program, const Camera& camera);
std::string background_value(Program& program, const Background& background);
std::string settings_value(Program& program, const Settings& settings);

}  // namespace crt::source
