#include "honesty.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>

namespace crt::bench {

namespace {

constexpr double step = 1.0 / 255;
/// Rays through a flat pixel may differ by this much, in any channel.
constexpr double max_of_flat = 2 * step;
/// So many rays in a row and in a column of a pixel decide its class.
constexpr int rays_across = 32;
constexpr std::uint64_t first_seed_of_truth = 1001;

Shown shown(const Color& color, const Settings& settings) {
  return {displayed(color.r, settings), displayed(color.g, settings), displayed(color.b, settings)};
}

double farthest(const Shown& a, const Shown& b) {
  double result = 0;
  for (std::size_t c = 0; c < a.size(); ++c) result = std::max(result, std::abs(a[c] - b[c]));
  return result;
}

/// Rays holds the rays through a pixel, together.
struct Rays {
  std::set<std::uint32_t> entities;
  Shown low{};
  Shown high{};
};

/// A RayPicture is a part of the scene's picture in which each ray is a pixel.
class RayPicture {
 public:
  RayPicture(Scene scene, const Region& region) : settings_(scene.settings) {
    Settings& settings = scene.settings;
    settings.width *= rays_across;
    settings.height *= rays_across;
    settings.supersampling = 1;
    settings.dof_samples = std::min(settings.dof_samples, few_lens_samples);
    const Region rays{region.x * rays_across, region.y * rays_across, region.width * rays_across,
                      region.height * rays_across};
    image_ = render(prepare(scene), {.region = rays, .aovs = {.id = true}});
  }

  Rays of_pixel(int x, int y) const {
    const auto ids = image_.integer_channel("id");
    Rays rays;
    rays.low = rays.high = shown(image_.at(x * rays_across, y * rays_across), settings_);
    for (int j = y * rays_across; j < (y + 1) * rays_across; ++j) {
      for (int i = x * rays_across; i < (x + 1) * rays_across; ++i) {
        rays.entities.insert(
            ids[static_cast<std::size_t>(j) * static_cast<std::size_t>(image_.width()) +
                static_cast<std::size_t>(i)]);
        const Shown seen = shown(image_.at(i, j), settings_);
        for (std::size_t c = 0; c < seen.size(); ++c) {
          rays.low[c] = std::min(rays.low[c], seen[c]);
          rays.high[c] = std::max(rays.high[c], seen[c]);
        }
      }
    }
    return rays;
  }

 private:
  static constexpr int few_lens_samples = 2;
  Settings settings_;
  Image image_;
};

/// Returns a part of a picture and the pixels around it that are in the picture.
Region with_margin(const Region& region, const Settings& settings) {
  const int left = std::max(region.x - 1, 0);
  const int top = std::max(region.y - 1, 0);
  return {left, top, std::min(region.x + region.width + 1, settings.width) - left,
          std::min(region.y + region.height + 1, settings.height) - top};
}

/// A Neighbourhood holds rays by pixel.
class Neighbourhood {
 public:
  Neighbourhood(const Scene& scene, const Region& region)
      : region_(with_margin(region, scene.settings)) {
    const RayPicture picture(scene, region_);
    for (int y = 0; y < region_.height; ++y) {
      for (int x = 0; x < region_.width; ++x) pixels_.push_back(picture.of_pixel(x, y));
    }
  }

  const Rays* at(int x, int y) const {
    x -= region_.x;
    y -= region_.y;
    if (x < 0 || y < 0 || x >= region_.width || y >= region_.height) return nullptr;
    return &pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(region_.width) +
                    static_cast<std::size_t>(x)];
  }

  /// Says whether an entity is all that is seen in the pixel or in one beside it.
  bool fills_a_pixel(std::uint32_t entity, int x, int y) const {
    for (int j = y - 1; j <= y + 1; ++j) {
      for (int i = x - 1; i <= x + 1; ++i) {
        const Rays* rays = at(i, j);
        if (rays != nullptr && rays->entities.size() == 1 && rays->entities.contains(entity))
          return true;
      }
    }
    return false;
  }

 private:
  Region region_;
  std::vector<Rays> pixels_;
};

PixelClass class_at(const Neighbourhood& all, int x, int y, bool is_blurred,
                    const EntityRange& interest) {
  const Rays& rays = *all.at(x, y);
  const auto any_entity = [&](const auto& is_so) {
    return std::any_of(rays.entities.begin(), rays.entities.end(), is_so);
  };
  if (farthest(rays.low, rays.high) <= max_of_flat) return PixelClass::flat;
  if (is_blurred) return PixelClass::defocused;
  if (any_entity([&](std::uint32_t id) { return id >= interest.first && id <= interest.last; })) {
    return PixelClass::special;
  }
  if (any_entity([&](std::uint32_t id) { return !all.fills_a_pixel(id, x, y); }))
    return PixelClass::sub_pixel;
  return PixelClass::edge;
}

}  // namespace

std::vector<PixelClass> classes_of(const Scene& scene, const Region& region,
                                   const EntityRange& interest) {
  const bool is_blurred = has_lens(scene.camera) && scene.settings.dof_samples > 1;
  const Neighbourhood all(scene, region);
  std::vector<PixelClass> classes;
  for (int y = region.y; y < region.y + region.height; ++y) {
    for (int x = region.x; x < region.x + region.width; ++x) {
      classes.push_back(class_at(all, x, y, is_blurred, interest));
    }
  }
  return classes;
}

TruePixels true_pixels(const Scene& scene, const Region& region, std::vector<bool> chosen,
                       int samples) {
  Scene fine = scene;
  fine.settings.target_error = 1;
  fine.settings.min_samples = fine.settings.max_samples = samples;
  const PreparedScene prepared = prepare(fine);
  const Image one = render(prepared, {.region = region, .seed = first_seed_of_truth});
  const Image other = render(prepared, {.region = region, .seed = first_seed_of_truth + 1});

  TruePixels result{.scene = scene, .region = region, .chosen = std::move(chosen)};
  double squares = 0;
  int count = 0;
  for (int i = 0; i < region.width * region.height; ++i) {
    const Color a = one.at(i % region.width, i / region.width);
    const Color b = other.at(i % region.width, i / region.width);
    const Settings& settings = scene.settings;
    result.truth.push_back(shown({(a.r + b.r) / 2, (a.g + b.g) / 2, (a.b + b.b) / 2, 1}, settings));
    if (!result.chosen[static_cast<std::size_t>(i)]) continue;
    const double half = farthest(shown(a, settings), shown(b, settings)) / 2;
    squares += half * half;
    ++count;
  }
  result.uncertainty = std::sqrt(squares / std::max(count, 1));
  return result;
}

std::vector<Trial> trials_of(const TruePixels& pixels, double target_error, int seeds) {
  Scene adaptive = pixels.scene;
  adaptive.settings.target_error = target_error;
  const PreparedScene prepared = prepare(adaptive);
  std::vector<Trial> trials;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Image image = render(prepared, {.region = pixels.region,
                                          .seed = static_cast<std::uint64_t>(seed),
                                          .aovs = {.error = true}});
    const auto claims = image.channel("error");
    std::size_t index = 0;
    for (std::size_t i = 0; i < pixels.truth.size(); ++i) {
      if (!pixels.chosen[i]) continue;
      const int x = static_cast<int>(i) % pixels.region.width;
      const int y = static_cast<int>(i) / pixels.region.width;
      const double error = farthest(shown(image.at(x, y), adaptive.settings), pixels.truth[i]);
      trials.push_back({.pixel = index++, .claimed = double{claims[i]}, .error = error});
    }
  }
  return trials;
}

}  // namespace crt::bench
