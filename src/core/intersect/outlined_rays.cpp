#include "core/intersect/outlined_rays.hpp"

namespace crt::core {

BoxStarts OutlinedRay::starts_on(const OutlineBox& box) const {
  if (start_surface_ == nothing) return {};
  return BoxStarts::of(box, *this);
}

Judgement OutlinedRay::judged_box(const OutlineBox& box, double limit) const {
  const BoxStarts starts = starts_on(box);
  if (starts.some != 0) {
    if (starts.left != 0) return Judgement::missed;
    if (starts.open != 0) return Judgement::open;
  }
  return judgement(judge_box(starts.meetings(box, line_, 0), line_, limit));
}

FirstCrossing<double> OutlinedRay::first_crossing_of_box(const OutlineBox& box) const {
  const BoxStarts starts = starts_on(box);
  if (starts.some != 0) {
    if (starts.left != 0) return {};
    if (starts.open != 0) return {.unknown = true};
  }
  return core::first_crossing_of_box(box, starts.meetings(box, line_, 0), line_);
}

FirstCrossing<double> OutlinedRay::first_crossing_at_torus(const Outline& torus,
                                                           const Outlines& outlines) const {
  const OutlineAxis& axis = outlines.axis(torus);
  if (torus.surface != start_surface_) return first_crossing_of_torus(axis, line_, true);
  if (start_side_ != Side::outside) return {.unknown = true};
  return first_crossing_from_torus(axis, line_, true);
}

FirstCrossing<Lanes> OutlinedPacket::first_crossing_at_torus(const Outline& torus, const Outlines& outlines,
                                                             std::size_t group, RayMask asked) const {
  const OutlineAxis& axis = outlines.axis(torus);
  const OutlineLine<Lanes>& lines = packet_.groups[group];
  const RayMask starting =
      packet_.starts.on_surface != 0 ? asked & RayPacket::lanes(starting_on(torus.surface), group) : 0;
  const RayMask elsewhere = asked & ~starting;
  FirstCrossing<Lanes> first;
  if (elsewhere != 0) first = first_crossing_of_torus(axis, lines, lanes_with(elsewhere));
  if (starting != 0) first.unknown |= first_crossing_from_torus(axis, lines, lanes_with(starting)).unknown;
  return first;
}

}  // namespace crt::core
