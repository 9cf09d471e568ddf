#include "core/scene/outlined_rays.hpp"

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

}  // namespace crt::core
