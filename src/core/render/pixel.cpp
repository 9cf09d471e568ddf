// These are pixels by the plain grid.
#include "core/render/pixel.hpp"

#include <algorithm>

#include "core/math/random.hpp"
#include "core/render/canvas.hpp"
#include "core/render/packet_tracer.hpp"
#include "core/render/tiles.hpp"

namespace crt::core {

namespace {

/// Random numbers are drawn for this.
constexpr std::uint32_t lens_dimension = 0;

/// A TilePlace is a place of a tile along Morton's curve, which goes through a square quarter by
/// quarter. So packets of rays through consecutive pixels stay together.
struct TilePlace {
  int x = 0;
  int y = 0;
};
constexpr auto tile_places = [] {
  std::array<TilePlace, Tiles::most_pixels> places;
  for (unsigned i = 0; i < places.size(); ++i) {
    for (unsigned bit = 0; i >> 2 * bit != 0; ++bit) {
      places[i].x |= static_cast<int>((i >> 2 * bit & 1u) << bit);
      places[i].y |= static_cast<int>((i >> (2 * bit + 1) & 1u) << bit);
    }
  }
  return places;
}();

/// GridRays are the rays of a grid through a tile, of one pixel after the other. Each subpixel has
/// a ray for each point of the lens.
class GridRays {
 public:
  /// Pixels has, by ray of a packet, its pixel's place in the tile.
  using Pixels = std::array<std::uint32_t, packet_size>;

  GridRays(const Frame& frame, const Region& region, int lens_points)
      : frame_(frame),
        region_(region),
        lens_points_(static_cast<std::uint32_t>(lens_points)),
        rays_per_pixel_(static_cast<std::uint32_t>(frame.subpixel_count()) * lens_points_) {}

  /// Places the next rays. Returns how many, and none at the end.
  template <bool with_lens>
  std::size_t next(RayPlaces& places, Pixels& pixels) {
    std::size_t count = 0;
    for (; place_ < tile_places.size(); ++place_, ray_ = 0) {
      if (!with_lens && count % lane_count == 0) {
        while (count < packet_size && place_square(places, pixels, count)) count += lane_count;
        if (place_ == tile_places.size()) break;
      }
      const TilePlace& place = tile_places[place_];
      if (place.x >= region_.width || place.y >= region_.height) continue;
      const int x = region_.x + place.x;
      const int y = region_.y + place.y;
      const auto pixel = static_cast<std::uint32_t>(place.y * region_.width + place.x);
      while (ray_ < rays_per_pixel_) {
        if (count == packet_size) return count;
        const std::uint32_t placed = place_some<with_lens>(x, y, places, count);
        std::fill_n(&pixels[count], placed, pixel);
        ray_ += placed;
        count += placed;
      }
    }
    return count;
  }

 private:
  /// Places the next ray or, where that is easy, as many as there are lanes. Returns how many.
  template <bool with_lens>
  std::uint32_t place_some(int x, int y, RayPlaces& places, std::size_t count) {
    const std::size_t group = count / lane_count;
    const std::size_t lane = count % lane_count;
    const bool makes_group =
        lane == 0 && ray_ % lane_count == 0 && rays_per_pixel_ - ray_ >= lane_count;
    const bool places_group = !with_lens && makes_group;
    if (frame_.draws_numbers())
      places.set_samples(count, places_group ? lane_count : 1, {x, y, ray_});
    if (places_group) {
      const PicturePlaceLanes& subpixels = frame_.subpixels()[ray_ / lane_count];
      places.picture[group] = {static_cast<double>(x) + subpixels.x,
                               static_cast<double>(y) + subpixels.y};
      return lane_count;
    }
    const std::size_t index = with_lens ? ray_ / lens_points_ : ray_;
    const PicturePlace subpixel =
        lane_of(frame_.subpixels()[index / lane_count], index % lane_count);
    set_lane(places.picture[group], lane, {x + subpixel.x, y + subpixel.y});
    if constexpr (with_lens) set_lane(places.lens[group], lane, lens_point(x, y));
    return 1;
  }

  /// Places the rays of the next four pixels, a square, if each has one ray. Returns false if they
  /// are not all in the region.
  bool place_square(RayPlaces& places, Pixels& pixels, std::size_t count) {
    if (rays_per_pixel_ > 1 || place_ == tile_places.size() || place_ % lane_count != 0)
      return false;
    const TilePlace& place = tile_places[place_];
    if (place.x + 1 >= region_.width || place.y + 1 >= region_.height) return false;
    const PicturePlaceLanes& middle = frame_.subpixels().front();
    places.picture[count / lane_count] = {region_.x + place.x + lanes_of(0, 1, 0, 1) + middle.x[0],
                                          region_.y + place.y + lanes_of(0, 0, 1, 1) + middle.y[0]};
    const auto pixel = static_cast<std::uint32_t>(place.y * region_.width + place.x);
    const auto below = pixel + static_cast<std::uint32_t>(region_.width);
    const std::array<std::uint32_t, lane_count> square = {pixel, pixel + 1, below, below + 1};
    std::copy(square.begin(), square.end(), &pixels[count]);
    for (int i = 0; frame_.draws_numbers() && i < static_cast<int>(lane_count); ++i) {
      places.set_samples(count + static_cast<std::size_t>(i), 1,
                         {region_.x + place.x + i % 2, region_.y + place.y + i / 2, 0});
    }
    place_ += lane_count;
    return true;
  }

  /// Returns the lens point of the next ray.
  LensPoint lens_point(int x, int y) {
    const std::size_t lane = ray_ % lane_count;
    if (lane == 0) {
      const auto [u, v] = random_pairs(frame_.settings().seed, {.x = static_cast<std::uint32_t>(x),
                                                                .y = static_cast<std::uint32_t>(y),
                                                                .sample = ray_,
                                                                .dimension = lens_dimension});
      lens_points_of_rays_ = frame_.camera().lens_points(u, v);
    }
    return lane_of(lens_points_of_rays_, lane);
  }

  const Frame& frame_;
  Region region_;
  std::uint32_t lens_points_;  ///< 1 without a lens
  std::uint32_t rays_per_pixel_;
  // These say which ray comes next:
  std::size_t place_ = 0;
  std::uint32_t ray_ = 0;  ///< of its pixel
  /// These are the lens points of this ray and the others of four.
  LensPointLanes lens_points_of_rays_;
};

/// Returns how many samples of a pixel a block has, so that there are about eight.
std::uint64_t block_size(std::uint64_t samples) {
  constexpr std::uint64_t blocks = 8;
  return std::max<std::uint64_t>(1, samples / blocks);
}

/// GridSums adds up samples. A pixel's sum is that of its subpixels' sums over the lens, in their
/// order.
class GridSums {
 public:
  /// `first_hit_sums` and `noise` may be empty.
  GridSums(int lens_points, std::uint64_t samples_per_pixel, std::span<PixelMean> sums,
           std::span<FirstHit> first_hit_sums, std::span<PixelNoise> noise)
      : lens_points_(lens_points),
        block_size_(static_cast<std::uint32_t>(block_size(samples_per_pixel))),
        sums_(sums),
        first_hit_sums_(first_hit_sums),
        noise_(noise) {}

  void add(const PacketTracer::Traced& traced, const GridRays::Pixels& pixels) {
    for (std::size_t i = 0; i < traced.samples.size(); ++i) {
      const Sample& sample = traced.samples[i];
      PixelMean& pixel = sums_[pixels[i]];
      PixelMean& sum = lens_points_ == 1 ? pixel : lens_sum_;
      sum.channels += sample.channels;
      sum.dropped += sample.dropped;
      if (lens_points_ == 1 || ++lens_point_ < lens_points_) continue;
      pixel.channels += lens_sum_.channels;
      pixel.dropped += lens_sum_.dropped;
      lens_sum_ = PixelMean{};
      lens_point_ = 0;
    }
    for (std::size_t i = 0; i < traced.first_hits.size(); ++i) {
      first_hit_sums_[pixels[i]].add(traced.first_hits[i]);
    }
    if (noise_.empty()) return;
    for (std::size_t i = 0; i < traced.samples.size(); ++i) {
      PixelNoise& noise = noise_[pixels[i]];
      noise.block += traced.samples[i].channels;
      if (++noise.samples % block_size_ != 0) continue;
      noise.sum += noise.block;
      noise.squares += noise.block * noise.block;
      noise.block = Lanes{};
    }
  }

 private:
  int lens_points_;
  std::uint32_t block_size_;
  std::span<PixelMean> sums_;
  std::span<FirstHit> first_hit_sums_;
  std::span<PixelNoise> noise_;
  PixelMean lens_sum_{};
  int lens_point_ = 0;
};

}  // namespace

Guide guide_of(const FirstHit& hit, const Lanes& variances, std::size_t estimates) {
  Guide guide{.cover = static_cast<float>(hit.cover),
              .nearness = static_cast<float>(hit.nearness),
              .estimates = static_cast<float>(estimates)};
  const FloatLanes floats = finite_floats(variances);
  for (int i = 0; i < 3; ++i) {
    const auto channel = static_cast<std::size_t>(i);
    guide.albedo[channel] = finite_float(hit.color[i]);
    guide.normal[channel] = finite_float(hit.normal[i]);
    guide.variance[channel] = floats[channel];
  }
  return guide;
}

Guide guide_of(const FirstHit& hit, const PixelNoise& noise, std::uint64_t samples) {
  const std::uint64_t size = block_size(samples);
  const std::uint64_t count = samples / size;
  const auto blocks = static_cast<double>(count);
  const double divisor =
      std::max(1.0, blocks - 1) * static_cast<double>(size) * static_cast<double>(samples);
  const Lanes squares = noise.squares - noise.sum * noise.sum / blocks;
  // Where all blocks are alike, rounding leaves some of their squares.
  constexpr double rounding = 0x1p-40;
  const Lanes variances = select(squares > rounding * noise.squares, squares / divisor, Lanes{});
  return guide_of(hit, variances, count);
}

void trace_pixels(const Frame& frame, const Region& region, Tracer& tracer,
                  std::span<PixelMean> pixels, std::span<FirstHit> first_hits,
                  std::span<PixelNoise> noise, RenderStats& stats) {
  const bool lens = frame.features().lens;
  const int lens_points = lens ? frame.settings().dof_samples : 1;
  const std::uint64_t samples_per_pixel =
      frame.subpixel_count() * static_cast<std::uint64_t>(lens_points);
  std::fill(pixels.begin(), pixels.end(), PixelMean{});
  PacketTracer packets(frame, tracer, !first_hits.empty());
  GridRays rays(frame, region, lens_points);
  GridSums sums(lens_points, samples_per_pixel, pixels, first_hits, noise);
  RayPlaces places;
  GridRays::Pixels of_pixels;
  const auto next = [&] {
    return lens ? rays.next<true>(places, of_pixels) : rays.next<false>(places, of_pixels);
  };
  while (const std::size_t count = next()) sums.add(packets.trace(places, count), of_pixels);

  if (samples_per_pixel > 1) {
    const auto divisor = static_cast<double>(samples_per_pixel);
    for (PixelMean& pixel : pixels) pixel = {pixel.channels / divisor, pixel.dropped / divisor};
    for (FirstHit& hit : first_hits) hit.divide(static_cast<std::int64_t>(samples_per_pixel));
  }
  stats.pixels += pixels.size();
  if (lens) stats.lens_samples += pixels.size() * samples_per_pixel;
}

}  // namespace crt::core
