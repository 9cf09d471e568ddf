#include "core/scene/first_crossing.hpp"

#include "core/geometry/torus.hpp"

namespace crt::core {

namespace {

ObjectRay object_ray(const Placement& placement, const PlainRay<double>& ray) {
  return placement.to_object(ray.origin, ray.direction);
}
ObjectRayLanes object_ray(const Placement& placement, const RayLanes& rays) {
  return placement.to_object(rays);
}

}  // namespace

template <class Real>
FirstCrossing<Real> first_crossing_of_torus(const OutlineAxis& torus, const OutlineLine<Real>& line,
                                            const typename FirstCrossing<Real>::Mask& asked) {
  // Of all shapes only the torus has such an outline.
  const auto& shape = static_cast<const TorusShape&>(*torus.torus->shape);
  const auto entry = shape.first_entry<Real>(object_ray(*torus.torus->placement, plain_ray(line)), asked);
  // What is not plainly after the start may be one of several crossings, of which others count.
  const auto ahead =
      both(after_start(line, entry.t, entry.error).surely, entry.t > asked_above(line.certain_from));
  const auto known = both(entry.known, ahead);
  return {.found = known,
          .unknown = without(entry.found, known),
          .entering = known,
          .t = entry.t,
          .error = entry.error};
}
template FirstCrossing<double> first_crossing_of_torus(const OutlineAxis&, const OutlineLine<double>&,
                                                       const bool&);
template FirstCrossing<Lanes> first_crossing_of_torus(const OutlineAxis&, const OutlineLine<Lanes>&,
                                                      const LaneMask&);

}  // namespace crt::core
