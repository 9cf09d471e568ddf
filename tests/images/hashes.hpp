// These are the hashes in hashes.txt, which are to be the same on every machine: of every example
// picture in both tiers, of what queries answer in its scene, and of what is measured of solids.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace crt::tests {

using NamedHashes = std::vector<std::pair<std::string, std::string>>;

/// A HashSubject computes the hashes that one example has, each with its name: "csg" of the
/// picture, "csg:exact" of that in the exact tier, "csg:queries" and "csg:queries:exact" of the
/// answers to random rays, or "flange:volume" and the like of measures.
using HashSubject = std::function<NamedHashes()>;

/// Returns all of them: those of pictures first, by name.
std::vector<HashSubject> hash_subjects();

}  // namespace crt::tests
