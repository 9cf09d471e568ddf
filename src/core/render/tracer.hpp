// The tracer: what light comes along a camera ray. Source: Whitted, An improved illumination model
// for shaded display, Communications of the ACM 23(6), 1980.
#pragma once

#include <array>
#include <span>

#include "core/ray/ray_packet.hpp"
#include "core/render/first_hit.hpp"
#include "core/render/frame.hpp"
#include "core/render/progress.hpp"
#include "core/render/surface_group.hpp"
#include "core/shading/phong.hpp"

namespace crt::core {

/// Traces camera rays on one thread, up to packet_size side by side. Each ray has its weight: its
/// share of the light that the camera ray brings. In every round each sample follows one ray. Of
/// those that go on from where that ends the last one is followed in the next round, and the other
/// waits on the sample's stack. The rounds' rays, and the shadow rays of each light, travel as
/// packets where they go nearly the same way. A sample does not depend on what is traced beside it.
class Tracer {
 public:
  /// All three must outlive the tracer, and nothing else may use the workspace meanwhile.
  Tracer(const Frame& frame, Workspace& work, Progress& progress);

  struct Sample {
    Lanes channels =
        lanes_of(0, 0, 0, 1);  ///< red, green and blue, premultiplied with the last: alpha
    /// The weight of rays that were not followed, of the channel that lost most.
    double dropped = 0;
    /// If asked for: samples that meet the same things on the same paths have the same, others most
    /// likely not: what was hit, from which side, after how many mirrors and refractions, in which
    /// lights' shadows.
    std::uint64_t identity = 0;
  };

  /// From now on samples get an identity.
  void identify() { identifies_ = true; }

  /// Traces as many camera rays as there are samples, up to packet_size. Says of each what it meets
  /// first, if there is margin for that in `first_hits`. Throws Error (cancelled) soon after the
  /// progress says so.
  void trace(std::span<const RayLanes> camera_rays, std::span<Sample> samples,
             std::span<FirstHit> first_hits = {});

  /// Where as many camera rays as there are places meet something first; no light is followed.
  void look(std::span<const RayLanes> camera_rays, std::span<FirstPlace> places);

 private:
  /// A ray for each sample that is not done yet. Below they are known by their numbers in the
  /// round.
  struct Round {
    std::size_t count = 0;
    RayBatch rays;
    std::array<VectorLanes, RayPacket::group_count> weights;  ///< shares of the pixels' light
    std::array<PathState, packet_size> paths;
    std::array<SampleWork*, packet_size> works;
    std::array<Sample*, packet_size> samples;
  };

  /// What a camera's ray starts in.
  void start_media(std::size_t ray);
  /// Follows the rays of this round, and makes the next.
  void follow();
  /// Takes a closer look at what a ray meets. False if no light from there gets through what is on
  /// the way.
  bool see(std::size_t ray);
  /// Adds what those rays see that hit nothing.
  void see_background(RayMask rays);
  /// Takes from the weight what the medium around the way to a hit absorbs; whether anything is
  /// left.
  bool pass_medium(std::size_t ray);

  /// What the camera rays of the round that was just followed have met.
  void tell_first_hits(std::span<FirstHit> first_hits);

  /// What a ray of this round meets, once it has been looked up.
  SurfaceLane surface(std::size_t ray) { return {surfaces_[ray / lane_count], ray % lane_count}; }
  /// Looks up what the rays meet that are on a surface.
  void look_up_each(RayMask on_surface);
  /// Adds the light of all lights that these surfaces send back along the paths.
  void add_light(RayMask on_surface);
  /// Those that any light makes brighter.
  RayMask taking_light(RayMask on_surface) const;
  /// Makes the rays that find out which of some surfaces a light reaches, and returns which: to the
  /// others no light comes.
  RayMask send_to(const PreparedLight& source, RayMask surfaces_lit);
  /// What is on the paths of the shadow rays that are sent.
  LightPaths paths_to_light(const PacketStarts& starts, RayMask sent);
  /// Those that start where something absorbs light.
  RayMask absorbing(RayMask sent) const;

  /// The mirrored and the refracted rays that go on from where a group of rays ends.
  struct Split {
    RayMask mirrored = 0;
    RayMask refracted = 0;
    VectorLanes mirrored_direction;
    VectorLanes mirrored_weight;
    VectorLanes refracted_direction;
    VectorLanes refracted_weight;
    RayMask into_volumes = 0;  ///< rays that would go through solids' surfaces
    std::array<MediaLists::List, lane_count> media_behind;
    std::array<std::uint32_t, lane_count>
        media_marks;  ///< before lists were made for what is behind
  };
  /// Adds the light of surfaces to the samples, and takes those samples of a group of rays into the
  /// next round that have a ray left.
  void finish(std::size_t group, RayMask on_surface);
  /// Sends mirrored and refracted rays on; returns which samples have such a one in the next round.
  RayMask send_on(std::size_t group, RayMask lanes);
  /// Of surfaces that do not end paths.
  void split(std::size_t group, RayMask lanes, Split& split);
  /// What is behind them, and how much gets there.
  struct Behind {
    Lanes transparency{};  ///< where it is 0, the rest means nothing
    VectorLanes color;
    Lanes index_before = lanes_of(1);
    Lanes index_behind = lanes_of(1);
  };
  void look_behind(std::size_t group, RayMask lanes, Behind& behind, Split& split);
  /// Which rays of such weights are to go on from where a group of rays ends, of which some are too
  /// deep.
  RayMask worth_it(std::size_t group, RayMask lanes, RayMask deep, const VectorLanes& weights);
  /// What they may weigh after all that brightens light on their further paths.
  VectorLanes most_weights(std::size_t group, const VectorLanes& weights) const;
  /// worth_it() by these.
  RayMask heavy_enough(std::size_t group, RayMask lanes, RayMask deep, const VectorLanes& most);
  /// A ray that has done one bounce more, into the next round or, if it waits, onto the stack. The
  /// caller fills in its media.
  PathState& depart(std::size_t ray, RayKind kind, bool waits, const Vec3& direction,
                    const StartPoint& start, const Rgb& weight);
  /// A place in the next round for the sample of a ray.
  std::size_t join_next_round(std::size_t ray, RayKind kind);
  /// Takes up what waits of a ray's sample.
  void pop(std::size_t ray);

  /// Of the surfaces at the place of a ray's first hit the one that is seen: that which lets the
  /// least light through, of several the one whose object was written first.
  RayHit seen_of(const WorldRay& ray);

  /// What a ray that goes on through a hit's place finds.
  struct Passage {
    double transparency = 0;  ///< of all surfaces there together
    Rgb color{1, 1, 1};
    MediaLists::List media = MediaLists::empty;  ///< behind them
  };
  /// At a place of several objects.
  void pass_coincident(std::size_t ray, Passage& passage);
  /// The media behind the surface of a solid that is alone at its place.
  MediaLists::List media_behind(std::size_t ray);
  WorldRay ray_behind(std::size_t ray);
  double refractive_index(const MediaLists& lists, MediaLists::List media) const;

  /// Counts rays; lets the progress speak now and then.
  void tick(unsigned rays = 1);

  /// The share of the pixel's light that comes along a ray of this round.
  Rgb weight(std::size_t ray) const {
    return round_->weights[ray / lane_count].lane(ray % lane_count);
  }

  /// Takes the surfaces that rays of this round have met into their samples' identities.
  void note_surfaces(RayMask on_surface);
  /// Takes one more thing that a sample has met into its identity.
  static void note(Sample& sample, std::uint64_t thing);

  const Frame& frame_;
  const PreparedData& data_;
  Workspace& work_;
  Progress& progress_;
  /// The same in every sample's lists.
  MediaLists::List camera_media_ = MediaLists::empty;
  /// Of the lists that all camera rays need.
  std::uint32_t camera_media_mark_ = 0;
  bool has_transparency_;
  unsigned ticks_ = 0;
  std::size_t waiting_ = 0;  ///< rays on the samples' stacks
  bool identifies_ = false;
  std::array<Round, 2> rounds_;
  Round* round_ = rounds_.data();           ///< this one
  Round* next_round_ = rounds_.data() + 1;  ///< is made meanwhile
  std::array<RayHit, packet_size> hits_;
  std::array<SurfaceGroup, packet_size / lane_count> surfaces_;
  /// Rays from these to a light, and what comes along them if they meet nothing.
  RayBatch shadow_rays_;
  std::array<VectorLanes, packet_size / lane_count> lights_;
  LightSamples light_sample_;  ///< of a group; a new one for each would be filled with zeros first
};

}  // namespace crt::core
