#include "core/intersect/filter_rays.hpp"

namespace crt::core {

BoxStarts FilterRay::starts_on(const ProxyBox& box) const {
  if (start_surface_ == nothing) return {};
  return BoxStarts::of(box, *this);
}

Answer FilterRay::decide_box(const ProxyBox& box, double limit) const {
  const BoxStarts starts = starts_on(box);
  if (starts.some != 0) {
    if (starts.left != 0) return Answer::rejected;
    if (starts.open != 0) return Answer::undecided;
  }
  return answer(test_box(starts.meetings(box, line_, 0), line_, limit));
}

FirstCrossing<double> FilterRay::first_crossing_of_box(const ProxyBox& box) const {
  const BoxStarts starts = starts_on(box);
  if (starts.some != 0) {
    if (starts.left != 0) return {};
    if (starts.open != 0) return {.unknown = true};
  }
  return core::first_crossing_of_box(box, starts.meetings(box, line_, 0), line_);
}

FirstCrossing<double> FilterRay::first_crossing_at_torus(const BoundingProxy& torus,
                                                         const BoundingProxies& proxies) const {
  const ProxyAxis& axis = proxies.axis(torus);
  if (torus.surface != start_surface_) return first_crossing_of_torus(axis, line_, true);
  if (start_side_ != Side::outside) return {.unknown = true};
  return first_crossing_from_torus(axis, line_, true);
}

FirstCrossing<Lanes> FilterPacket::first_crossing_at_torus(const BoundingProxy& torus,
                                                           const BoundingProxies& proxies,
                                                           std::size_t group, RayMask asked) const {
  const ProxyAxis& axis = proxies.axis(torus);
  const FilterLine<Lanes>& lines = packet_.groups[group];
  const RayMask starting = packet_.starts.on_surface != 0
                               ? asked & RayPacket::lanes(starting_on(torus.surface), group)
                               : 0;
  const RayMask elsewhere = asked & ~starting;
  FirstCrossing<Lanes> first;
  if (elsewhere != 0) first = first_crossing_of_torus(axis, lines, lanes_with(elsewhere));
  if (starting != 0)
    first.unknown |= first_crossing_from_torus(axis, lines, lanes_with(starting)).unknown;
  return first;
}

}  // namespace crt::core
