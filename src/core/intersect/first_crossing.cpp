#include "core/intersect/first_crossing.hpp"

#include "core/geometry/frustum/frustum.hpp"
#include "core/geometry/torus/torus.hpp"

namespace crt::core {

namespace {

ObjectRay object_ray(const Placement& placement, const PlainRay<double>& ray) {
  return placement.to_object(ray.origin, ray.direction);
}
ObjectRayLanes object_ray(const Placement& placement, const RayLanes& rays) {
  return placement.to_object(rays);
}

/// Returns the shape of an object of that kind.
template <class Kind>
const Kind& shape_of(const ProxyAxis& object) {
  return *shape_as<Kind>(object.typed);
}

template <class Real>
auto object_ray(const ProxyAxis& object, const FilterLine<Real>& line) {
  return object_ray(*object.moved->placement, plain_ray(line));
}

}  // namespace

template <class Real>
SphereChord<Real> chord_of_moved_sphere(const ProxyAxis& sphere, const FilterLine<Real>& line) {
  const auto& shape = shape_of<SphereShape>(sphere);
  return shape.chord<Real>(object_ray(sphere, line));
}
template SphereChord<double> chord_of_moved_sphere(const ProxyAxis&, const FilterLine<double>&);
template SphereChord<Lanes> chord_of_moved_sphere(const ProxyAxis&, const FilterLine<Lanes>&);

template <class Real>
FirstCrossing<Real> first_crossing_of_frustum(const ProxyAxis& cylinder,
                                              const FilterLine<Real>& line) {
  const auto& shape = shape_of<FrustumShape>(cylinder);
  const auto entry = cylinder.moved->placement->is_identity()
                         ? shape.first_entry<Real>(plain_ray(line))
                         : shape.first_entry<Real>(object_ray(cylinder, line));
  // What is not plainly after the start may be where the line has entered before.
  const auto known = entry.known && after_start(line, entry.t, entry.error).surely;
  return {.found = known,
          .unknown = !entry.rejected && !known,
          .entering = known,
          .t = entry.t,
          .error = entry.error};
}
template FirstCrossing<double> first_crossing_of_frustum(const ProxyAxis&,
                                                         const FilterLine<double>&);
template FirstCrossing<Lanes> first_crossing_of_frustum(const ProxyAxis&, const FilterLine<Lanes>&);

template <class Real>
ChangeCrossing<Real> change_of(const EnclosedFrustum& /*frustum*/, const Leaf& leaf, bool into_leaf,
                               const FilterLine<Real>& line) {
  if (!into_leaf) return {};
  const auto& shape = *shape_as<FrustumShape>(leaf.shape->typed());
  const auto entry = shape.first_entry<Real>(plain_ray(line));
  return {.crossing = {.found = entry.known, .t = entry.t, .error = entry.error}};
}
template ChangeCrossing<double> change_of(const EnclosedFrustum&, const Leaf&, bool,
                                          const FilterLine<double>&);
template ChangeCrossing<Lanes> change_of(const EnclosedFrustum&, const Leaf&, bool,
                                         const FilterLine<Lanes>&);

template <class Real>
FirstCrossing<Real> first_crossing_of_torus(const ProxyAxis& torus, const FilterLine<Real>& line,
                                            const typename FirstCrossing<Real>::Mask& asked) {
  const auto entry =
      shape_of<TorusShape>(torus).template first_entry<Real>(object_ray(torus, line), asked);
  // What is not plainly after the start may be one of several crossings, of which others count.
  const auto ahead =
      after_start(line, entry.t, entry.error).surely && entry.t > asked_above(line.certain_from);
  const auto known = entry.known && ahead;
  return {.found = known,
          .unknown = entry.found && !known,
          .entering = known,
          .t = entry.t,
          .error = entry.error};
}
template FirstCrossing<double> first_crossing_of_torus(const ProxyAxis&, const FilterLine<double>&,
                                                       const bool&);
template FirstCrossing<Lanes> first_crossing_of_torus(const ProxyAxis&, const FilterLine<Lanes>&,
                                                      const LaneMask&);

template <class Real>
FirstCrossing<Real> first_crossing_from_torus(const ProxyAxis& torus, const FilterLine<Real>& line,
                                              const typename FirstCrossing<Real>::Mask& asked) {
  const auto resolved = asked && line.begin >= 0.0;
  const auto comes_back =
      shape_of<TorusShape>(torus).template comes_back<Real>(object_ray(torus, line), resolved);
  return {.unknown = comes_back || (asked && !resolved)};
}
template FirstCrossing<double> first_crossing_from_torus(const ProxyAxis&,
                                                         const FilterLine<double>&, const bool&);
template FirstCrossing<Lanes> first_crossing_from_torus(const ProxyAxis&, const FilterLine<Lanes>&,
                                                        const LaneMask&);

}  // namespace crt::core
