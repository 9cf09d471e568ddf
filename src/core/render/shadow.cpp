#include "core/render/shadow.hpp"

#include <cmath>
#include <limits>

#include "core/render/media_order.hpp"
#include "core/render/surface_hit.hpp"

namespace crt::core {

namespace {

/// What the media along the ray absorb, between the crossings.
class AbsorbedShare {
 public:
  AbsorbedShare(const PreparedData& data, const WorldRay& ray, std::span<const RayHit> crossings,
                MediaLists& lists, MediaLists::List media, Workspace& work)
      : data_(data), ray_(ray), crossings_(crossings), lists_(lists), media_(media), work_(work) {}

  Rgb share() {
    const std::uint32_t mark = lists_.mark();
    for (std::size_t begin = 0; begin < crossings_.size();) {
      std::size_t end = begin + 1;
      while (end < crossings_.size() && same_place(crossings_[begin], crossings_[end])) ++end;
      go_on_to(crossings_[begin].t);
      pass(begin, end);
      begin = end;
    }
    go_on_to(ray_.t_max);
    lists_.release(mark);
    return share_;
  }

 private:
  void go_on_to(double t) {
    if (media_ != MediaLists::empty) {
      share_ *= transmittance(data_.materials()[lists_.innermost(media_).material], t - reached_);
    }
    reached_ = t;
  }

  /// Leaves and then enters whatever is at one place.
  void pass(std::size_t begin, std::size_t end) {
    std::vector<RayHit>& entered = work_.entered;
    entered.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const RayHit& crossing = crossings_[i];
      if (!data_.is_solid(crossing)) continue;
      if (crossing.entering) {
        if (entered.size() < most_media_at_once) entered.push_back(crossing);
      } else {
        media_ = lists_.left(media_, crossing.object);
      }
    }
    const auto exit_of = [&](std::uint32_t object) { return exit_after(end, object); };
    sort_outermost_first(entered, exit_of);
    for (const RayHit& crossing : entered) {
      const Medium medium{crossing.object, data_.hit_material(crossing)};
      media_ = entered_in_order(lists_, media_, medium, exit_of);
    }
  }

  /// Where the ray's line leaves a solid, from a crossing on.
  RayHit exit_after(std::size_t index, std::uint32_t object) const {
    for (; index < crossings_.size(); ++index) {
      const RayHit& crossing = crossings_[index];
      if (crossing.object == object && !crossing.entering) return crossing;
    }
    if (std::isinf(ray_.t_max)) return {};
    WorldRay beyond = ray_;
    beyond.t_min = ray_.t_max;
    beyond.t_max = std::numeric_limits<double>::infinity();
    return data_.stay(beyond, object, work_.rays).exit;
  }

  const PreparedData& data_;
  const WorldRay& ray_;
  std::span<const RayHit> crossings_;
  MediaLists& lists_;
  MediaLists::List media_;
  Workspace& work_;
  Rgb share_{1, 1, 1};
  double reached_ = 0;
};

}  // namespace

Rgb light_share(const PreparedData& data, const WorldRay& ray, std::span<const RayHit> crossings,
                MediaLists& lists, MediaLists::List media, Workspace& work) {
  Rgb share(1);
  for (const RayHit& crossing : crossings) {
    const CrossingFilter filter = crossing_filter(data, ray, crossing, work.stats);
    share = bounded_share(share * (filter.transparency * filter.color));
    if (is_black(share)) return share;
  }
  if (data.features().absorption) share *= AbsorbedShare(data, ray, crossings, lists, media, work).share();
  return share;
}

}  // namespace crt::core
