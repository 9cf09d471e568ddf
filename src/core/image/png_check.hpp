// Whether a PNG file is whole. The PNG library would print its complaints to the standard error
// output; what is cut short or damaged is found here first.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace crt::core {

/// What is wrong with the chunks of a file that begins with the signature of PNG; empty if nothing.
std::string png_damage(std::span<const std::byte> content);

}  // namespace crt::core
