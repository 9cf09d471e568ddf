// The Settings block has attributes that set a part of the scene.
#pragma once

#include <vector>

#include "crt/scene.hpp"
#include "lang/objects.hpp"

namespace crt::lang {

/// Returns the row of Settings. It builds no value: see apply_settings().
const ObjectType& settings_type();

/// Checks and fills in what the attributes set. `block` is where the Settings stand.
void apply_settings(Context& context, Span block, const std::vector<Given>& attributes,
                    Scene& scene);

}  // namespace crt::lang
