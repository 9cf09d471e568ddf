// Every example scene renders as it did when its reference was made: nearly, as anyone can see, and
// exactly, as the hash of its pixels shows. If a change is meant, run ./dev references, look, and
// commit.
#include <doctest/doctest.h>

#include <crt/render.hpp>
#include <filesystem>
#include <iostream>
#include <string>

#include "images/compare.hpp"
#include "images/example_pictures.hpp"
#include "images/measured_solids.hpp"

using namespace crt;
using namespace crt::tests;

namespace {

namespace fs = std::filesystem;

/// Keeps what a failed comparison looked like, and says where it is.
void keep_for_inspection(const ExamplePicture& picture, const Image& image,
                         const Image& reference) {
  const fs::path folder = CRT_FAILED_IMAGES;
  fs::create_directories(folder);
  const fs::path rendered = folder / (picture.name + ".png");
  image.write(rendered);
  std::cerr << picture.name << ": rendered as " << rendered.string();
  if (compare(image, reference).same_size) {
    const fs::path difference = folder / (picture.name + "-difference.png");
    difference_picture(image, reference).write(difference);
    std::cerr << ", differs as in " << difference.string();
  }
  std::cerr << "; the reference is " << reference_path(picture).string() << '\n';
}

/// Returns the picture put together from its four quarters, each rendered alone.
Image render_in_quarters(const PreparedScene& scene, int width, int height) {
  Image whole(width, height);
  const int middle_x = width / 2 + 1;
  const int middle_y = height / 2 - 1;
  const Region quarters[] = {{0, 0, middle_x, middle_y},
                             {middle_x, 0, width - middle_x, middle_y},
                             {0, middle_y, middle_x, height - middle_y},
                             {middle_x, middle_y, width - middle_x, height - middle_y}};
  for (const Region& quarter : quarters) {
    const Image part = render(scene, {.region = quarter});
    for (int y = 0; y < part.height(); ++y) {
      const auto row = part.pixels().subspan(
          4 * static_cast<std::size_t>(y) * static_cast<std::size_t>(part.width()),
          4 * static_cast<std::size_t>(part.width()));
      const std::size_t start =
          4 * (static_cast<std::size_t>(quarter.y + y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(quarter.x));
      std::copy(row.begin(), row.end(),
                whole.pixels().begin() + static_cast<std::ptrdiff_t>(start));
    }
  }
  return whole;
}

}  // namespace

TEST_CASE("each example looks like its reference, and any threads and regions give the same bits") {
  // These bounds are in 8-bit steps. A reference is as an older version made it, if a change since
  // then moved an edge or two by a pixel. A mistake moves far more.
  constexpr double max_rmse = 1.5;
  constexpr double max_visible = 0.002;

  const auto hashes = read_hashes();
  for (const ExamplePicture& picture : example_pictures()) {
    CAPTURE(picture.name);
    REQUIRE(fs::exists(reference_path(picture)));
    const Image reference = Image::read(reference_path(picture));

    const Scene scene = small_scene(picture);
    const PreparedScene prepared = prepare(scene);
    const Image image = render(prepared, {.threads = 1});
    const Difference difference = compare(image, reference);
    CHECK(difference.same_size);
    CHECK(difference.rmse <= max_rmse);
    CHECK(difference.share_of_visible <= max_visible);

    const std::string hash = pixel_hash(image);
    REQUIRE(hashes.count(picture.name) == 1);
    CHECK(hash == hashes.at(picture.name));
    for (const int threads : {2, 7}) {
      CAPTURE(threads);
      CHECK(pixel_hash(render(prepared, {.threads = threads})) == hash);
    }
    CHECK(pixel_hash(render_in_quarters(prepared, image.width(), image.height())) == hash);

    const bool alike = difference.same_size && difference.rmse <= max_rmse &&
                       difference.share_of_visible <= max_visible &&
                       hash == hashes.at(picture.name);
    if (!alike) keep_for_inspection(picture, image, reference);
  }
}

TEST_CASE("no reference is left of a picture that is no more") {
  std::size_t known = 0;
  for (const ExamplePicture& picture : example_pictures())
    known += fs::exists(reference_path(picture)) ? 1 : 0;
  std::size_t kept = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(CRT_SOURCE_DIR) / "tests/images/references")) {
    kept += entry.path().extension() == ".png" ? 1 : 0;
  }
  CHECK(kept == known);
  constexpr std::size_t hashes_of_each = 4;  // of both tiers' pictures and queries
  constexpr std::size_t measures_of_each = 7;
  CHECK(read_hashes().size() ==
        hashes_of_each * known + measures_of_each * measured_scripts().size());
}

TEST_CASE("a comparison tells what an eye would") {
  Image grey_picture(10, 10);
  grey_picture.set_settings({.gamma = 1});
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) grey_picture.set(x, y, grey(0.5));
  }
  Image spotted = grey_picture;
  spotted.set(3, 4, {1, 0.5, 0.5});

  CHECK(compare(grey_picture, grey_picture).rmse == 0);
  CHECK(compare(grey_picture, spotted).share_of_visible == doctest::Approx(0.01));
  CHECK(compare(grey_picture, spotted).rmse == doctest::Approx(127 / 20.0));
  CHECK(difference_picture(grey_picture, spotted).at(3, 4).r > 1);
  CHECK(difference_picture(grey_picture, spotted).at(4, 4).r == 0);
  CHECK_FALSE(compare(grey_picture, Image(10, 9)).same_size);
}
