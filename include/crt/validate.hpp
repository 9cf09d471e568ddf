// These functions check descriptions. Preparing a scene makes all checks. A program that takes
// values from elsewhere may make them earlier, to say where a wrong one stands.
#pragma once

#include <crt/background.hpp>
#include <crt/camera.hpp>
#include <crt/entity.hpp>
#include <crt/light.hpp>
#include <crt/material.hpp>
#include <crt/primitives.hpp>
#include <crt/settings.hpp>

namespace crt {

/// @name Checks of descriptions
/// Each throws Error (invalid_argument) for the first value that is out of the range that its
/// header states, or not finite; Error::argument() names the field.
/// @{

/// Checks a primitive.
void validate(const Primitive& primitive);
/// Checks a pattern.
void validate(const Pattern& pattern);
/// Checks a material.
void validate(const Material& material);
/// Checks a principled material.
void validate(const PrincipledMaterial& material);
/// Checks a light.
void validate(const Light& light);
/// Checks a camera.
void validate(const Camera& camera);
/// Checks a background.
void validate(const Background& background);
/// Checks settings.
void validate(const Settings& settings);

/// @}

/// Says whether some part of an entity has no material of its own, so that Entity::with_material()
/// changes it. Only some hundred parts are looked at: if all of these have one, it says that
/// another lacks it.
bool lacks_material(const Entity& entity);

}  // namespace crt
