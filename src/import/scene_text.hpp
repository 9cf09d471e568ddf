// Scenes that an imported part is shown in.
#pragma once

#include <crt/bounding_box.hpp>
#include <crt/entity.hpp>
#include <string>
#include <vector>

namespace crt::importing {

/// Returns the Settings for a part in a box: a camera that sees all of it, and two lights.
std::string settings_for(const BoundingBox& box);

/// Returns the box around all entities that have an end.
BoundingBox box_around(const std::vector<Entity>& entities);

/// Returns what comment a script begins with.
std::string heading_of(const std::string& name);

}  // namespace crt::importing
