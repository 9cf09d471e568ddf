// The Settings block: its attributes, and what of the scene they set.
#pragma once

#include <vector>

#include "crt/scene.hpp"
#include "lang/objects.hpp"

namespace crt::lang {

/// The row of Settings. It builds no value: see apply_settings().
const ObjectType& settings_type();

/// Fills in what the attributes set, checked; `block` is where the Settings stand.
void apply_settings(Context& context, Span block, const std::vector<Given>& attributes,
                    Scene& scene);

}  // namespace crt::lang
