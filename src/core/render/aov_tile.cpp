#include "core/render/aov_tile.hpp"

#include <cmath>
#include <new>
#include <utility>

#include "core/render/canvas.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// An AovPixel is all that is known of one pixel.
struct AovPixel {
  const FirstHit& hit;
  const FirstPlace& place;
  const PixelMeasure& measure;
};

/// A channel says what an AOV holds of a pixel.
struct FloatChannel {
  const char* name;
  bool Aovs::*asked;
  double (*value)(const AovPixel& pixel);
};

struct IntegerChannel {
  const char* name;
  bool Aovs::*asked;
  std::uint32_t (*value)(const AovPixel& pixel);
};

// Readers of EXR files look for these names: Z for a distance, X, Y and Z in a layer for a
// direction, R, G and B for a colour.
constexpr FloatChannel float_channels[] = {
    {"Z", &Aovs::depth, [](const AovPixel& pixel) { return pixel.place.distance; }},
    {"N.X", &Aovs::normal, [](const AovPixel& pixel) { return pixel.hit.normal.x; }},
    {"N.Y", &Aovs::normal, [](const AovPixel& pixel) { return pixel.hit.normal.y; }},
    {"N.Z", &Aovs::normal, [](const AovPixel& pixel) { return pixel.hit.normal.z; }},
    {"albedo.R", &Aovs::albedo, [](const AovPixel& pixel) { return pixel.hit.color.r; }},
    {"albedo.G", &Aovs::albedo, [](const AovPixel& pixel) { return pixel.hit.color.g; }},
    {"albedo.B", &Aovs::albedo, [](const AovPixel& pixel) { return pixel.hit.color.b; }},
    {"error", &Aovs::error, [](const AovPixel& pixel) { return double{pixel.measure.half_width}; }},
};

constexpr IntegerChannel integer_channels[] = {
    {"id", &Aovs::id, [](const AovPixel& pixel) { return pixel.place.entity_id; }},
    {"part", &Aovs::part, [](const AovPixel& pixel) { return pixel.place.part_id; }},
    {"samples", &Aovs::samples, [](const AovPixel& pixel) { return pixel.measure.samples; }},
};

/// Returns the nearest float, which is finite if the value is.
float to_float(double value) {
  return std::isinf(value) ? static_cast<float>(value) : finite_float(value);
}

/// Calls copy(place in the tile, place in the region, count) for each row of the tile.
template <class Function>
void for_each_row(const Region& tile, const Region& region, const Function& copy) {
  const auto width = static_cast<std::size_t>(tile.width);
  for (int y = 0; y < tile.height; ++y) {
    copy(static_cast<std::size_t>(y) * width, index_in(region, tile.x, tile.y + y), width);
  }
}

}  // namespace

void add_channels(const Aovs& aovs, Image& image) {
  const FirstHit no_hit;
  const FirstPlace no_place;
  const PixelMeasure no_measure;
  const AovPixel none = {no_hit, no_place, no_measure};
  const std::size_t pixel_count = image.pixels().size() / 4;
  try {
    std::vector<ImageChannel> channels;
    for (const FloatChannel& channel : float_channels) {
      if (!(aovs.*channel.asked)) continue;
      channels.push_back(
          {channel.name, std::vector<float>(pixel_count, to_float(channel.value(none)))});
    }
    for (const IntegerChannel& channel : integer_channels) {
      if (!(aovs.*channel.asked)) continue;
      channels.push_back(
          {channel.name, std::vector<std::uint32_t>(pixel_count, channel.value(none))});
    }
    image.set_channels(std::move(channels));
  } catch (const std::bad_alloc&) {
    throw Error(ErrorCode::out_of_memory,
                text::format("no memory for further channels of {} x {} pixels", image.width(),
                             image.height()));
  }
}

std::span<FirstHit> AovTile::first_hits(bool are_wanted) {
  return std::span(first_hits_).first(are_wanted ? pixel_count(tile_) : 0);
}

void AovTile::take(const PixelMeasures& measures, const Region& region) {
  for_each_row(tile_, region, [&](std::size_t to, std::size_t from, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      measures_[to + i] = {.samples = measures.samples[from + i],
                           .half_width = measures.half_widths[from + i]};
      if (!measures.first_hits.empty()) first_hits_[to + i] = measures.first_hits[from + i];
    }
  });
}

void AovTile::look(const CameraRays& camera, Tracer& tracer) {
  if (!aovs_.depth && !aovs_.id && !aovs_.part) return;
  constexpr double middle = 0.5;
  static_assert(Tiles::side == packet_size);
  std::array<PicturePlaceLanes, RayPacket::group_count> places;
  std::array<RayLanes, RayPacket::group_count> rays;
  const auto width = static_cast<std::size_t>(tile_.width);
  for (int y = 0; y < tile_.height; ++y) {
    for (std::size_t group = 0; group < places.size(); ++group) {
      const double first_x = tile_.x + static_cast<double>(group * lane_count) + middle;
      places[group] = {first_x + lanes_of(0, 1, 2, 3), lanes_of(tile_.y + y + middle)};
    }
    camera.rays(width, places, {}, rays);
    tracer.look(rays, std::span(first_places_).subspan(static_cast<std::size_t>(y) * width, width));
  }
}

void AovTile::put(const Region& region, Image& image) const {
  const auto copy = [&](const auto& channel, auto values, const auto& converted) {
    for_each_row(tile_, region, [&](std::size_t from, std::size_t to, std::size_t count) {
      for (std::size_t i = 0; i < count; ++i) {
        values[to + i] = converted(
            channel.value({first_hits_[from + i], first_places_[from + i], measures_[from + i]}));
      }
    });
  };
  for (const FloatChannel& channel : float_channels) {
    if (aovs_.*channel.asked) copy(channel, image.channel(channel.name), to_float);
  }
  for (const IntegerChannel& channel : integer_channels) {
    if (aovs_.*channel.asked)
      copy(channel, image.integer_channel(channel.name), [](auto id) { return id; });
  }
}

}  // namespace crt::core
