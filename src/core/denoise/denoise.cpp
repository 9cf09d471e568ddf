#include "core/denoise/denoise.hpp"

#include <cmath>
#include <functional>

#include "core/denoise/noise.hpp"

namespace crt::core {

namespace {

constexpr int search_radius = 7;  ///< of the pixels that a mean is of
constexpr int patch_radius = 1;   ///< of what is compared around two of them
static_assert(search_radius + patch_radius < margin_of_planes);

/// Albedos count as at least this where light is divided by them.
constexpr float least_albedo = 0.05F;
/// Light beyond this, and what is no number, is left alone.
constexpr float most_light = 1e15F;

/// Strips of so many rows are worked on by one thread.
constexpr int rows_of_strip = 16;

/// Returns what a channel of a pixel is divided by. What is seen beside surfaces stays.
float divisor(const Guide& guide, std::size_t channel) {
  return std::max(least_albedo, guide.albedo[channel] + (1 - guide.cover));
}

/// Returns the smaller of two steps to neighbours, which is that along one surface.
float slope_between(float before, float here, float behind) {
  const float down = here - before;
  const float up = behind - here;
  return std::abs(down) < std::abs(up) ? down : up;
}

class Denoiser {
 public:
  Denoiser(int width, int height, std::span<float> pixels, std::span<const Guide> guides)
      : layout_(width, height), pixels_(pixels), guides_(guides), planes_(layout_) {}

  void run(const StripRunner& run_strips) {
    const auto in_strips = [&](const std::function<void(int, int)>& work) {
      const int strips = (layout_.height() + rows_of_strip - 1) / rows_of_strip;
      run_strips(static_cast<std::size_t>(strips), [&](std::size_t strip) {
        const int first = static_cast<int>(strip) * rows_of_strip;
        work(first, std::min(layout_.height(), first + rows_of_strip));
      });
    };
    Plane own(layout_.size());
    in_strips([&](int first, int last) { take(first, last, own); });
    in_strips([&](int first, int last) { find_slopes(first, last); });
    Plane residuals(layout_.size());
    const bool some_are_unknown = std::any_of(
        guides_.begin(), guides_.end(), [](const Guide& guide) { return guide.estimates < 2; });
    if (some_are_unknown)
      in_strips([&](int first, int last) { find_residuals(planes_, first, last, residuals); });
    Plane variances(layout_.size());
    in_strips([&](int first, int last) {
      find_variances(planes_, guides_, own, residuals, first, last, variances);
    });
    planes_.variance = std::move(variances);
    std::array<Plane, 3> kept = planes_.light;
    in_strips([&](int first, int last) { tame(first, last, kept); });
    planes_.light.swap(kept);
    for (Plane* const plane :
         {&planes_.light[0], &planes_.light[1], &planes_.light[2], &planes_.variance})
      extend(*plane);
    in_strips([&](int first, int last) { filter(first, last); });
  }

 private:
  template <class Use>
  void for_each_pixel(int first_row, int last_row, const Use& use) const {
    for (int y = first_row; y < last_row; ++y) {
      for (int x = 0; x < layout_.width(); ++x) {
        use(static_cast<std::size_t>(y) * static_cast<std::size_t>(layout_.width()) +
                static_cast<std::size_t>(x),
            layout_.index(x, y));
      }
    }
  }

  /// Takes in the pixels of rows, and their own variances.
  void take(int first_row, int last_row, Plane& own) {
    for_each_pixel(first_row, last_row, [&](std::size_t pixel, std::size_t place) {
      const Guide& guide = guides_[pixel];
      bool is_known = guide.estimates > 0;
      float variance = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const float light = pixels_[4 * pixel + i] / divisor(guide, i);
        is_known = is_known && std::abs(light) < most_light;
        planes_.light[i][place] = light;
        variance += guide.variance[i] / (divisor(guide, i) * divisor(guide, i));
        planes_.albedo[i][place] = guide.albedo[i];
        planes_.normal[i][place] = guide.normal[i];
      }
      planes_.cover[place] = guide.cover;
      planes_.nearness[place] = guide.nearness;
      planes_.is_known[place] = is_known ? 1.0F : 0.0F;
      own[place] = variance < most_light * most_light ? variance : most_light * most_light;
      if (is_known) return;
      own[place] = 0;
      for (Plane& light : planes_.light) light[place] = 0;
    });
  }

  void find_slopes(int first_row, int last_row) {
    const std::size_t row = layout_.index(0, 1) - layout_.index(0, 0);
    const Plane& nearness = planes_.nearness;
    for_each_pixel(first_row, last_row, [&](std::size_t, std::size_t place) {
      planes_.slope_x[place] =
          slope_between(nearness[place - 1], nearness[place], nearness[place + 1]);
      planes_.slope_y[place] =
          slope_between(nearness[place - row], nearness[place], nearness[place + row]);
    });
  }

  /// Lets pixels that a few bright samples have made far brighter than what is around them be no
  /// brighter than is usual there. Light is lost by that. Without it they would stay as spots.
  void tame(int first_row, int last_row, std::array<Plane, 3>& tamed) const {
    constexpr int radius = 2;
    constexpr float usual_deviations = 3;
    const auto sum_at = [&](std::size_t place) {
      return planes_.light[0][place] + planes_.light[1][place] + planes_.light[2][place];
    };
    for (int y = first_row; y < last_row; ++y) {
      for (int x = 0; x < layout_.width(); ++x) {
        const std::size_t place = layout_.index(x, y);
        if (planes_.variance[place] == 0) continue;
        float weights = 0;
        float sum = 0;
        float squares = 0;
        for (int dy = -radius; dy <= radius; ++dy) {
          for (int dx = -radius; dx <= radius; ++dx) {
            const std::size_t other = layout_.index(x + dx, y + dy);
            if (other == place || planes_.is_known[other] == 0) continue;
            const float weight = weight_of(
                std::min(max_surface_distance, SurfaceDistance(planes_, dx, dy)(place, other)));
            const float light = sum_at(other);
            weights += weight;
            sum += weight * light;
            squares += weight * light * light;
          }
        }
        if (weights < 1) continue;
        const float mean = sum / weights;
        const float deviation = std::sqrt(std::max(0.0F, squares / weights - mean * mean));
        const float most = mean + usual_deviations * deviation;
        const float own = sum_at(place);
        if (!(own > most) || !(most > 0)) continue;
        for (Plane& light : tamed) light[place] *= most / own;
      }
    }
  }

  /// Repeats the picture's edges in the margin.
  void extend(Plane& plane) const {
    const int width = layout_.width();
    const int height = layout_.height();
    for (int y = -margin_of_planes; y < height + margin_of_planes; ++y) {
      const int row = std::clamp(y, 0, height - 1);
      for (int x = -margin_of_planes; x < width + margin_of_planes; ++x)
        plane[layout_.index(x, y)] = plane[layout_.index(std::clamp(x, 0, width - 1), row)];
    }
  }

  void filter(int first_row, int last_row);

  PlaneLayout layout_;
  std::span<float> pixels_;
  std::span<const Guide> guides_;
  PicturePlanes planes_;
};

/// Finds how far the surfaces of pixels in a row differ from those of as many others.
[[gnu::noinline]] void find_surface_distances(const SurfaceDistance& distance, std::size_t one,
                                              std::size_t other, std::size_t count,
                                              float* __restrict distances) {
  const SurfaceDistance kept = distance;  // so that it is seen that writing does not change it
  for (std::size_t x = 0; x < count; ++x) distances[x] = kept(one + x, other + x);
}

/// A Strip has the sums of the weighted means of some rows.
class Strip {
 public:
  Strip(const PicturePlanes& planes, int first_row, int last_row)
      : planes_(planes),
        width_(planes.layout.width()),
        first_row_(first_row),
        rows_(last_row - first_row),
        distances_(static_cast<std::size_t>(width_ + 2) * static_cast<std::size_t>(rows_ + 2)),
        across_(distances_.size()),
        row_weights_(static_cast<std::size_t>(width_)),
        weights_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(rows_)),
        sums_{Plane(weights_.size()), Plane(weights_.size()), Plane(weights_.size())} {}

  /// Adds the pixels that are (dx, dy) away.
  void add(int dx, int dy) {
    static_assert(patch_radius == 1);
    for (int row = -1; row <= rows_; ++row) compare(row, dx, dy);
    const std::size_t wide = std::size_t{2} + static_cast<std::size_t>(width_);
    for (int row = 0; row < rows_; ++row) {
      const float* const above = &across_[static_cast<std::size_t>(row) * wide];
      weigh(row, dx, dy, {above, above + wide, above + 2 * wide});
    }
  }

  /// Calls use(x, y, light) with the means.
  template <class Use>
  void for_each_mean(const Use& use) const {
    std::size_t i = 0;
    for (int row = 0; row < rows_; ++row) {
      for (int x = 0; x < width_; ++x, ++i) {
        if (weights_[i] > 0)
          use(x, first_row_ + row,
              std::array{sums_[0][i] / weights_[i], sums_[1][i] / weights_[i],
                         sums_[2][i] / weights_[i]});
      }
    }
  }

 private:
  /// Compares the pixels of a row with others, and adds up three across for each.
  void compare(int row, int dx, int dy) {
    // Differences count in units of so many standard deviations of theirs, squared.
    constexpr float squared_deviations = 0.45F * 0.45F;
    constexpr float least = 1e-30F;
    constexpr float pixels_of_patch = 9;
    const std::size_t one = planes_.layout.index(-1, first_row_ + row);
    const std::size_t other = planes_.layout.index(-1 + dx, first_row_ + row + dy);
    const std::size_t wide = std::size_t{2} + static_cast<std::size_t>(width_);
    const float* const red = planes_.light[0].data();
    const float* const green = planes_.light[1].data();
    const float* const blue = planes_.light[2].data();
    const float* const variance = planes_.variance.data();
    float* __restrict const distances = &distances_[static_cast<std::size_t>(row + 1) * wide];
    for (std::size_t x = 0; x < wide; ++x) {
      const float r = red[one + x] - red[other + x];
      const float g = green[one + x] - green[other + x];
      const float b = blue[one + x] - blue[other + x];
      const float p = variance[one + x];
      const float q = variance[other + x];
      const float noise = p + std::min(p, q);
      distances[x] = (r * r + g * g + b * b - noise) /
                     (pixels_of_patch * (least + squared_deviations * (p + q)));
    }
    float* __restrict const across = &across_[static_cast<std::size_t>(row + 1) * wide];
    for (std::size_t x = 0; x + 2 < wide; ++x)
      across[x] = distances[x] + distances[x + 1] + distances[x + 2];
  }

  void weigh(int row, int dx, int dy, const std::array<const float*, 3>& across) {
    const std::size_t one = planes_.layout.index(0, first_row_ + row);
    const std::size_t other = planes_.layout.index(dx, first_row_ + row + dy);
    const auto width = static_cast<std::size_t>(width_);
    const auto [above, here, below] = across;
    const float* const is_known = planes_.is_known.data() + other;
    float* __restrict const weights = row_weights_.data();
    find_surface_distances(SurfaceDistance(planes_, dx, dy), one, other, width, weights);
    for (std::size_t x = 0; x < width; ++x)
      weights[x] =
          std::min(max_surface_distance, std::max(weights[x], above[x] + here[x] + below[x]));
    for (std::size_t x = 0; x < width; ++x) weights[x] = is_known[x] * weight_of(weights[x]);
    const std::size_t begin = static_cast<std::size_t>(row) * width;
    float* __restrict const sum = weights_.data() + begin;
    for (std::size_t x = 0; x < width; ++x) sum[x] += weights[x];
    for (std::size_t channel = 0; channel < 3; ++channel) {
      float* __restrict const light_sum = sums_[channel].data() + begin;
      const float* const light = planes_.light[channel].data() + other;
      for (std::size_t x = 0; x < width; ++x) light_sum[x] += weights[x] * light[x];
    }
  }

  const PicturePlanes& planes_;
  int width_;
  int first_row_;
  int rows_;
  Plane distances_;
  Plane across_;
  Plane row_weights_;
  Plane weights_;
  std::array<Plane, 3> sums_;
};

void Denoiser::filter(int first_row, int last_row) {
  Strip strip(planes_, first_row, last_row);
  for (int dy = -search_radius; dy <= search_radius; ++dy) {
    for (int dx = -search_radius; dx <= search_radius; ++dx) strip.add(dx, dy);
  }
  strip.for_each_mean([&](int x, int y, const std::array<float, 3>& light) {
    const std::size_t place = layout_.index(x, y);
    if (planes_.variance[place] == 0 || planes_.is_known[place] == 0) return;
    const std::size_t pixel =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(layout_.width()) +
        static_cast<std::size_t>(x);
    for (std::size_t i = 0; i < 3; ++i)
      pixels_[4 * pixel + i] = light[i] * divisor(guides_[pixel], i);
  });
}

}  // namespace

void denoise(int width, int height, std::span<float> pixels, std::span<const Guide> guides,
             const StripRunner& run) {
  Denoiser(width, height, pixels, guides).run(run);
}

}  // namespace crt::core
