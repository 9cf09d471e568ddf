// OpenSCAD is run to evaluate a .scad file.
#pragma once

#include <filesystem>
#include <string>

namespace crt::cli {

/// Returns the tree that openscad writes of a part. Throws Error (io) if it is not installed, or
/// finds the part wrong, and (limit) if it takes longer than so many seconds.
std::string csg_of_scad(const std::filesystem::path& part, double seconds);

}  // namespace crt::cli
