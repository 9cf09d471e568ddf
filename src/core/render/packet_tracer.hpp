// Places in the picture become samples, a packet of camera rays at a time.
#pragma once

#include <array>
#include <span>

#include "core/render/tracer.hpp"

namespace crt::core {

/// RayPlaces are places of the picture, and of the lens if there is one, of the camera rays of a
/// packet.
struct RayPlaces {
  std::array<PicturePlaceLanes, RayPacket::group_count> picture;
  std::array<LensPointLanes, RayPacket::group_count> lens;
  std::array<SampleId, packet_size> samples;  ///< only where Frame::draws_numbers()

  /// Says that rays are consecutive samples of a pixel.
  void set_samples(std::size_t first, std::size_t count, const SampleId& id) {
    for (std::size_t i = 0; i < count; ++i) {
      samples[first + i] = {id.x, id.y, id.index + static_cast<std::uint32_t>(i)};
    }
  }
};

/// A PacketTracer traces rays by packets.
class PacketTracer {
 public:
  PacketTracer(const Frame& frame, Tracer& tracer, bool with_first_hits)
      : camera_(frame.camera()),
        with_lens_(frame.features().lens),
        with_numbers_(frame.draws_numbers()),
        with_first_hits_(with_first_hits),
        tracer_(tracer) {}

  struct Traced {
    std::span<const Sample> samples;
    std::span<const FirstHit> first_hits;  ///< none if nobody asks for them
  };
  /// Traces the first `count` rays.
  Traced trace(const RayPlaces& places, std::size_t count) {
    const std::size_t with_lens = with_lens_ ? places.lens.size() : 0;
    camera_.rays(count, places.picture, std::span(places.lens).first(with_lens), rays_);
    const std::span<Sample> samples = std::span(samples_).first(count);
    const std::span<FirstHit> first_hits =
        std::span(first_hits_).first(with_first_hits_ ? count : 0);
    tracer_.trace(rays_, samples, std::span(places.samples).first(with_numbers_ ? count : 0),
                  first_hits);
    return {samples, first_hits};
  }

 private:
  const CameraRays& camera_;
  bool with_lens_;
  bool with_numbers_;
  bool with_first_hits_;
  Tracer& tracer_;
  std::array<RayLanes, RayPacket::group_count> rays_;
  std::array<Sample, packet_size> samples_;
  std::array<FirstHit, packet_size> first_hits_;
};

}  // namespace crt::core
