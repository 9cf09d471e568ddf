// These functions check descriptions. Preparing a scene makes all checks. A program that takes
// values from elsewhere may make them earlier, to say where a wrong one stands.
#pragma once

#include <crt/background.hpp>
#include <crt/camera.hpp>
#include <crt/light.hpp>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <crt/settings.hpp>

namespace crt {

// Each throws Error (invalid_argument) for the first value that is out of the range that its header
// states, or not finite; Error::argument() names the field.

void validate(const Primitive& primitive);
void validate(const Pattern& pattern);
void validate(const Material& material);
void validate(const Light& light);
void validate(const Camera& camera);
void validate(const Background& background);
void validate(const Settings& settings);

}  // namespace crt
