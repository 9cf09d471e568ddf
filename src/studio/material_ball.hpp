// A material ball shows what a material of a script looks like.
#pragma once

#include <crt/language_service.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace crt::studio {

/// Returns a PNG file, in base64, of a ball of the material that begins at a byte of a script: an
/// object, one derived from a variable, or the value of an attribute `material`. `tree` is that of
/// the script. There is none if no material begins there, or it cannot be made by itself, as what
/// it needs is known in a macro or a loop alone.
std::optional<std::string> material_ball(const std::string& text, const std::string& name,
                                         const std::vector<ScriptNode>& tree, std::uint32_t byte);

}  // namespace crt::studio
