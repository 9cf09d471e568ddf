#include "core/geometry/rounded_box/rounded_box.hpp"

#include <algorithm>

#include "core/geometry/checks.hpp"
#include "core/geometry/clipped_span.hpp"
#include "core/geometry/plane_face.hpp"
#include "core/geometry/rounded_box/functions.hpp"
#include "core/math/vector.hpp"
#include "text/format.hpp"

namespace crt::core {

RoundedBoxShape::RoundedBoxShape(const RoundedBox& box) : box_(box_of(box)), layout_(box) {}

bool RoundedBoxShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  if (starts_on_face(ray.start)) return crossings_from_face(ray, out);
  const NearLine line = NearLine::at_closest(ray, layout_.center, layout_.unit);
  const Walk walk = walk_through(layout_, line);
  if (!walk.found) return false;
  Crossing enter = crossing(ray, line, walk.enter, true);
  Crossing leave = crossing(ray, line, walk.leave, false);
  if (ray.start.face != invalid_index) {
    move_behind_plane(ray.start, enter);
    move_behind_plane(ray.start, leave);
  }
  if (!(enter.t < leave.t)) return false;
  out.push_back(enter);
  out.push_back(leave);
  return false;
}

bool RoundedBoxShape::crossings_from_face(const ObjectRay& ray, CrossingList& out) const {
  const bool leaves = ray.start.side == Side::outside;
  const double shortest = unit_roundoff * layout_.unit / largest_component(ray.direction);
  return append_from_face(ray.start, exit_from_face(leaves ? turned_round(ray) : ray), shortest,
                          out);
}

bool append_from_face(const FaceStart& start, Crossing other, double shortest, CrossingList& out) {
  const bool leaves = start.side == Side::outside;
  const bool is_flat = start.face < flat_faces_of_box;
  const Crossing here{.face = start.face, .root = static_cast<std::uint8_t>(leaves && !is_flat)};
  FaceStart on_face = start;
  on_face.on_face = true;
  if (leaves) {
    other.t = -other.t;
    other.t_low = -other.t_low;
    other.root = 0;
  }
  ClippedSpan span(on_face, shortest);
  span.enter(leaves ? other : here);
  span.leave(leaves ? here : other);
  return span.finish(out);
}

Crossing RoundedBoxShape::exit_from_face(const ObjectRay& ray) const {
  const NearLine line = NearLine::at_origin(ray, layout_.center, layout_.unit);
  const WayOut way = way_out(layout_, line);
  if (!way.is_first) return crossing(ray, line, way.leave, false);
  // The distance from the inner box is that of the start again. So a x^2 + 2 b x = 0.
  Vec3 q(0.0);
  Vec3 d(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    if (way.leave.sides[static_cast<std::size_t>(axis)] == 0) continue;
    q[axis] = layout_.beyond(way.leave.sides, axis, line.point[axis]);
    d[axis] = line.direction[axis];
  }
  const double a = glm::dot(d, d);
  const double b = glm::dot(q, d);
  const double distance = glm::length(q);
  const double r = layout_.radius;
  const double off_surface = std::abs((distance + r) * (distance - r));
  const double x = a > 0 ? -2 * b / a : 0;
  const double t = line.to_t(x);
  const bool is_flat = face_at(way.leave.sides) < flat_faces_of_box;
  return {.t = t,
          .error = error_next_to(layout_, line, line.at(x), t, std::abs(b) / r, std::sqrt(a)) +
                   (a > 0 ? line.to_t_length(start_error(off_surface, a, b)) : 0),
          .face = ray.start.face,
          .root = static_cast<std::uint8_t>(is_flat ? 0 : 1)};
}

Crossing RoundedBoxShape::crossing(const ObjectRay& ray, const NearLine& line, const WalkStep& step,
                                   bool entering) const {
  return face_at(step.sides) < flat_faces_of_box
             ? flat_crossing(ray, line, step, entering)
             : round_crossing(layout_, ray, line, step, entering);
}

Crossing RoundedBoxShape::flat_crossing(const ObjectRay& ray, const NearLine& line,
                                        const WalkStep& step, bool entering) const {
  const std::uint32_t face = face_at(step.sides);
  if (face == ray.start.face) return {.face = face, .entering = entering};
  const int axis = static_cast<int>(face / 2);
  const Bounds bounds = box_.bounds();
  const auto meeting =
      AxisMeeting<double>::of((face % 2 == 0 ? bounds.lower : bounds.upper)[axis], ray.origin[axis],
                              ray.direction[axis], ray.origin_low[axis], ray.direction_low[axis]);
  const double from = line.to_t(step.from);
  const double to = line.to_t(step.to);
  const double t = !(meeting.t >= from) ? from : std::min(meeting.t, to);
  Crossing crossing{.t = t, .error = meeting.error, .face = face, .entering = entering};
  // Next to a seam the true crossing may be on the round face beside.
  const Vec3 point = (1 / layout_.unit) * ray.from_center(layout_.center, t);
  const double margin = 2 * standard_error_across(2 * layout_.size);
  bool is_at_seam = t != meeting.t;
  for (int i = 0; i < 3; ++i) {
    if (i == axis) continue;
    is_at_seam = is_at_seam || !(point[i] > layout_.inner_lower[i] + margin &&
                                 point[i] < layout_.inner_upper[i] - margin);
  }
  if (is_at_seam)
    crossing.error = error_next_to(layout_, line, point, t, std::abs(line.direction[axis]), 0);
  return crossing;
}

template <class Real>
void RoundedBoxShape::write_round_point(const Vec3Of<Real>& offset, std::uint32_t face,
                                        bool with_uv, SurfacePointOf<Real>& point) const {
  const Sides sides = sides_of(face);
  const Vec3Of<Real> p = broadcast<Real>(1 / layout_.unit) * offset;
  Vec3Of<Real> q = broadcast<Real>(Vec3(0));
  Vec3 outwards(0);
  for (int axis = 0; axis < 3; ++axis) {
    const int side = sides[static_cast<std::size_t>(axis)];
    outwards[axis] = side;
    if (side < 0) q[axis] = min(p[axis] - layout_.inner_lower[axis], Real{});
    if (side > 0) q[axis] = max(p[axis] - layout_.inner_upper[axis], Real{});
  }
  const auto is_apart = largest_component(q) > 0.0;
  const Vec3Of<Real> n = unit_vector(select(is_apart, q, broadcast<Real>(outwards)));
  Vec3Of<Real> place = p;
  for (int axis = 0; axis < 3; ++axis) {
    const int side = sides[static_cast<std::size_t>(axis)];
    const double corner = (side < 0 ? layout_.inner_lower : layout_.inner_upper)[axis];
    if (side != 0) place[axis] = corner + layout_.radius * n[axis];
  }
  place = clamp(place, broadcast<Real>(layout_.lower), broadcast<Real>(layout_.upper));
  const Bounds bounds = box_.bounds();
  point.position = clamp(broadcast<Real>(layout_.center) + broadcast<Real>(layout_.unit) * place,
                         broadcast<Real>(bounds.lower), broadcast<Real>(bounds.upper));
  point.normal = n;
  if (!with_uv) return;
  const Vec3Of<Real> share = clamp(
      (place - broadcast<Real>(layout_.lower)) / broadcast<Real>(layout_.upper - layout_.lower),
      broadcast<Real>(Vec3(0)), broadcast<Real>(Vec3(1)));
  const auto is_x = abs(n.x) >= abs(n.y) && abs(n.x) >= abs(n.z);
  const auto is_y = abs(n.y) >= abs(n.z) && !is_x;
  point.u = select(is_x, share.z, share.x);
  point.v = select(is_y, share.z, share.y);
}

SurfacePoint RoundedBoxShape::point_on(const Vec3& offset, const Vec3& direction,
                                       std::uint32_t face, bool with_uv) const {
  if (face < flat_faces_of_box) return box_.point_on(offset, direction, face, with_uv);
  SurfacePoint point;
  write_round_point<double>(offset, face, with_uv, point);
  return point;
}

void RoundedBoxShape::points_on(const VectorLanes& offsets, const VectorLanes& directions,
                                std::uint32_t some, std::uint32_t face, bool with_uv,
                                SurfacePointLanes& points) const {
  if (face < flat_faces_of_box) {
    box_.points_on(offsets, directions, some, face, with_uv, points);
  } else {
    write_round_point<Lanes>(offsets, face, with_uv, points);
  }
}

Surface RoundedBoxShape::surface(std::uint32_t face) const {
  if (face < flat_faces_of_box) return box_.surface(face);
  const Bounds bounds = box_.bounds();
  return {.kind = SurfaceKind::rounding,
          .position = bounds.lower + Vec3(0.0),
          .direction = bounds.upper - bounds.lower,
          .sizes = {layout_.radius * layout_.unit, static_cast<double>(face)}};
}

std::unique_ptr<const FaceFunctions> RoundedBoxShape::face_functions() const {
  const Bounds bounds = box_.bounds();
  return face_functions_of(RoundedBoxFunctions({.lower = bounds.lower, .upper = bounds.upper},
                                               layout_.radius * layout_.unit, layout_.unit));
}

double largest_radius(const RoundedBox& box) {
  double least = infinity;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = box.corner_a[axis];
    const double b = box.corner_b[axis];
    const DoubleDouble side = two_sum(std::max(a, b), -std::min(a, b));
    least = std::min(least, 0.5 * (side.lo < 0 ? std::nextafter(side.hi, 0) : side.hi));
  }
  return least;
}

void validate(const RoundedBox& box) {
  constexpr double rounding = 0x1p-50;
  const double largest = largest_radius(box);
  const double slack =
      rounding * std::max(largest_component(box.corner_a), largest_component(box.corner_b));
  if (!(box.radius <= largest + slack)) {
    reject("radius", text::format("must be at most {}, half of the shortest side (it is {})",
                                  largest, box.radius));
  }
}

std::unique_ptr<const Shape> make_shape(const RoundedBox& box) {
  if (box.radius == 0) return std::make_unique<BoxShape>(box_of(box));
  return std::make_unique<RoundedBoxShape>(box);
}

}  // namespace crt::core
