// Materials, patterns, lights, cameras, backgrounds and settings become source code.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "crt/scene.hpp"
#include "source/program.hpp"

namespace crt::source {

/// Adds a file of an image that is to lie beside a script. Returns the file's name.
std::string image_file_name(Program& program, const Image& image);

/// Adds a file of heights likewise, if there are many and all are floats, and returns its name.
std::optional<std::string> heights_file_name(Program& program, const HeightGrid& grid);

/// Returns the name of an image. In a script it is that of its file, between quotes. Throws Error
/// (unsupported) if no code can make it.
std::string image_name(Program& program, const std::shared_ptr<const Image>& image);

/// Returns the name of a material.
std::string material_name(Program& program, const SharedMaterial& shared);

// These return values, in C the names of structs.

std::string light_value(Program& program, const Light& light);
std::string camera_value(Program& program, const Camera& camera);
std::string background_value(Program& program, const Background& background);

/// Returns the fields of Settings. Throws Error (unsupported) for a seed that scripts cannot have.
Fields settings_fields(Program& program, const Settings& settings);

/// Adds how a camera projects, which is a field of Settings in scripts.
void add_projection(Fields& fields, const Camera& camera);

}  // namespace crt::source
