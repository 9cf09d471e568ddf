#include "core/render/shadow.hpp"

#include <cmath>
#include <limits>

#include "core/render/media_along_ray.hpp"
#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

/// An AbsorbedShare is what the media along the ray absorb between the crossings.
class AbsorbedShare final : private MediaAlongRay::Line {
 public:
  AbsorbedShare(const PreparedData& data, const WorldRay& ray, std::span<const RayHit> crossings,
                Workspace& work)
      : data_(data), ray_(ray), crossings_(crossings), work_(work), media_(work.media_along_ray) {}

  /// Returns the share of light that is left for a ray that starts within `media`.
  Rgb share(const MediaLists& lists, MediaLists::List media) {
    media_.begin(crossings_, *this);
    for (; media != MediaLists::empty; media = lists.around(media)) {
      const Medium& medium = lists.innermost(media);
      if (!data_.is_passed(medium.object, passing_shadow)) media_.surround(medium);
    }
    for (std::size_t begin = 0; begin < crossings_.size();) {
      std::size_t end = begin + 1;
      while (end < crossings_.size() && have_one_t(crossings_[begin], crossings_[end])) ++end;
      go_on_to(crossings_[begin].t);
      pass(begin, end);
      begin = end;
    }
    go_on_to(ray_.t_max);
    return share_;
  }

 private:
  void go_on_to(double t) {
    if (!media_.empty()) {
      share_ *= transmittance(data_.materials()[media_.innermost().material], t - reached_);
    }
    reached_ = t;
  }

  /// Leaves and then enters whatever is at one place.
  void pass(std::size_t begin, std::size_t end) {
    std::vector<RayHit>& entered = work_.entered;
    entered.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const RayHit& crossing = crossings_[i];
      if ((i + 1) % steps_per_look == 0) work_.rays.csg.steps.poll();
      if (!data_.is_solid(crossing)) continue;
      if (crossing.entering) {
        if (entered.size() < max_media_at_once) entered.push_back(crossing);
      } else {
        media_.leave(crossing.object);
      }
    }
    sort_outermost_first(entered,
                         [&](std::uint32_t object) { return media_.exit_of(object, end); });
    for (const RayHit& crossing : entered) {
      media_.enter({crossing.object, data_.hit_material(crossing)}, end);
    }
  }

  RayHit exit_beyond(std::uint32_t object) const override {
    if (std::isinf(ray_.t_max)) return {};
    WorldRay beyond = ray_;
    beyond.t_min = ray_.t_max;
    beyond.t_max = std::numeric_limits<double>::infinity();
    return data_.find_exit(beyond, object, work_.rays).exit;
  }

  const PreparedData& data_;
  const WorldRay& ray_;
  std::span<const RayHit> crossings_;
  Workspace& work_;
  MediaAlongRay& media_;
  Rgb share_{1, 1, 1};
  double reached_ = 0;
};

}  // namespace

Rgb light_share(const PreparedData& data, const WorldRay& ray, std::span<const RayHit> crossings,
                const MediaLists& lists, MediaLists::List media, Workspace& work) {
  Rgb share(1);
  for (const RayHit& crossing : crossings) {
    const CrossingFilter filter = crossing_filter(data, ray, crossing, work.stats);
    share = bounded_share(share * (filter.transparency * filter.color));
    if (is_black(share)) return share;
  }
  if (data.features().absorption)
    share *= AbsorbedShare(data, ray, crossings, work).share(lists, media);
  return share;
}

}  // namespace crt::core
