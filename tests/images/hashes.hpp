// These are the hashes in hashes.txt, which are to be the same on every machine: of every example
// picture in both tiers, and of what queries answer in its scene.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "images/example_pictures.hpp"

namespace crt::tests {

using Hashes = std::map<std::string, std::string>;

/// Returns the hashes that an example has, each with its name: "csg" of the picture, "csg:exact" of
/// that in the exact tier, "csg:queries" and "csg:queries:exact" of the answers to random rays.
std::vector<std::pair<std::string, std::string>> hashes_of(const ExamplePicture& picture);

}  // namespace crt::tests
