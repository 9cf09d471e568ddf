// The third program of the tutorial for C++: it renders in the background, shows the progress,
// stops if asked to ("tutorial_render stop"), and writes the picture with distances and objects
// beside its colours, tee.exr, and the distances as greys, distance.png.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <string_view>
#include <thread>

#include "tee.hpp"

/// Makes a picture of distances: the nearer, the brighter.
crt::Image distance_picture(const crt::Image& image) {
  const double nearest = 6;
  const double farthest = 14;
  const auto distances = image.channel("Z");
  crt::Image result(image.width(), image.height());
  result.set_settings({.gamma = 1});  // the file holds these numbers as they are
  std::size_t pixel = 0;              // row by row
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x, ++pixel) {
      const double z = distances[pixel];
      result.set(x, y, crt::grey(std::clamp((farthest - z) / (farthest - nearest), 0.0, 1.0)));
    }
  }
  return result;
}

int main(int argc, char** argv) try {
  const bool stops = argc > 1 && std::string_view(argv[1]) == "stop";
  crt::Scene scene = tee_scene();
  scene.settings.target_error = 4.0 / 255;

  crt::RenderJob job(crt::prepare(scene), {.aovs = {.depth = true, .id = true}});
  while (!job.finished()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    std::cout << std::lround(100 * job.progress()) << " %\r" << std::flush;
    if (stops) job.cancel();
  }
  const crt::Image image = job.wait();  // throws if it was stopped
  image.write("tee.exr");
  distance_picture(image).write("distance.png");
  std::cout << "100 %, " << image.stats().samples_mean << " samples a pixel\n";
} catch (const crt::Error& error) {
  std::cerr << "tutorial_render: " << error.what() << '\n';
  return error.code() == crt::ErrorCode::cancelled ? 2 : 1;
}
