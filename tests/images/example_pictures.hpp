// These are the pictures of the example scripts, as the gallery has them, but small: quick to
// render and small enough to keep references of.
#pragma once

#include <crt/prepared_scene.hpp>
#include <crt/script.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace crt::tests {

/// An ExamplePicture is one picture: a script and what its "-- picture:" line adds to it.
struct ExamplePicture {
  std::string name{};  ///< "csg", or "phong-diffuse" for an extra picture
  std::filesystem::path script{};
  ScriptOptions options{};
};

/// Returns the folder examples/.
std::filesystem::path examples_path();

/// Returns every picture of every script in examples/scenes and examples/tutorial, by name.
std::vector<ExamplePicture> example_pictures();

/// Runs the script and makes its picture small: at most 160 pixels wide, one ray a pixel (unless
/// the picture is about that) and few points of the lens, or few samples where it has a target
/// error. Throws Error with the diagnostics if the script has errors or warnings.
Scene small_scene(const ExamplePicture& picture);

/// Returns the hash of a picture's float pixels.
std::string pixel_hash(const Image& image);

// The repository keeps these.
std::filesystem::path reference_path(const ExamplePicture& picture);
std::filesystem::path hashes_path();

/// Returns the lines "HASH NAME" of hashes.txt, by name.
std::map<std::string, std::string> read_hashes();

}  // namespace crt::tests
