// What is measured of solids of examples, which is to be the same on every machine.
#pragma once

#include <filesystem>
#include <vector>

#include "images/hashes.hpp"

namespace crt::tests {

/// Returns the scripts whose solids are measured.
std::vector<std::filesystem::path> measured_scripts();

/// Measures the first solids of a script in every way that there is.
NamedHashes hashes_of_measures(const std::filesystem::path& script);

}  // namespace crt::tests
