// Renders the reference pictures of the example scenes again, and their hashes. Look at them before
// you commit, and say in the commit what changed them.
#include <algorithm>
#include <crt/render.hpp>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "images/compare.hpp"
#include "images/example_pictures.hpp"
#include "images/hashes.hpp"

using namespace crt;
using namespace crt::tests;

int main() try {
  namespace fs = std::filesystem;
  const auto old_hashes = read_hashes();
  const std::vector<ExamplePicture> pictures = example_pictures();

  fs::create_directories(reference_path(pictures.front()).parent_path());
  for (const auto& entry : fs::directory_iterator(reference_path(pictures.front()).parent_path())) {
    const bool known = std::any_of(
        pictures.begin(), pictures.end(),
        [&](const ExamplePicture& picture) { return reference_path(picture) == entry.path(); });
    if (!known) fs::remove(entry.path());
  }

  {
    std::ofstream hashes(hashes_path());
    for (const HashSubject& subject : hash_subjects())
      for (const auto& [name, hash] : subject()) hashes << hash << ' ' << name << '\n';
  }
  for (const ExamplePicture& picture : pictures) {
    const Image image = render(prepare(small_scene(picture)));
    const std::string hash = pixel_hash(image);
    const fs::path path = reference_path(picture);
    const auto old = old_hashes.find(picture.name);
    if (old != old_hashes.end() && old->second == hash && fs::exists(path)) continue;
    if (!fs::exists(path)) {
      std::cout << picture.name << ": new\n";
    } else {
      const Difference difference = compare(image, Image::read(path));
      std::cout << picture.name << ": changed; RMSE " << difference.rmse << " of 255, "
                << 100 * difference.share_of_visible << " % of the pixels visibly\n";
    }
    image.write(path, {.reproducible = true});
  }
} catch (const std::exception& error) {
  std::cerr << "update_references: " << error.what() << '\n';
  return 1;
}
