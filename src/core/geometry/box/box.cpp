#include "core/geometry/box/box.hpp"

#include <limits>

#include "core/geometry/box/enclose_turned.hpp"
#include "core/math/vector.hpp"

#include "core/geometry/box/functions.hpp"

namespace crt::core {

BoxShape::BoxShape(const Box& box)
    : lower_(glm::min(box.corner_a, box.corner_b)),
      upper_(glm::max(box.corner_a, box.corner_b)),
      faces_{PlaneFace({-1, 0, 0}, lower_), PlaneFace({1, 0, 0}, upper_),
             PlaneFace({0, -1, 0}, lower_), PlaneFace({0, 1, 0}, upper_),
             PlaneFace({0, 0, -1}, lower_), PlaneFace({0, 0, 1}, upper_)} {}

std::optional<CoreSegment> BoxShape::core_segment() const {
  const Vec3 size = upper_ - lower_;
  int along = size.y > size.x ? 1 : 0;
  if (size.z > size[along]) along = 2;
  Vec3 across = 0.5 * size;
  across[along] = 0;
  const double reach = glm::length(across);
  return CoreSegment{lower_ + across, upper_ - across, reach, reach};
}

std::unique_ptr<const PlacedSolid> BoxShape::placed(const Placement& placement) const {
  const EnclosedBox box{lower_, upper_};
  auto solid = place(box, placement);
  if (solid != nullptr) return solid;
  const std::optional<EnclosedTurnedBox> turned = EnclosedTurnedBox::of(box, placement);
  if (!turned) return nullptr;
  return std::make_unique<const PlacedSolidOf<EnclosedTurnedBox>>(*turned);
}

bool BoxShape::crossings(const ObjectRay& ray, CrossingList& out) const {
  const double shortest =
      unit_roundoff * (largest_component(upper_ - lower_) / largest_component(ray.direction));
  ClippedSpan span(ray.start, shortest);
  if (ray.start.face == invalid_index) {
    const unsigned ends = possible_ends(ray);
    if (ends == 0) return false;
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      if ((ends >> face & 1u) == 0) continue;
      faces_[face].clip(ray, face, span);
      if (span.empty()) return false;
    }
  } else {
    for (std::uint32_t face = 0; face < faces_.size(); ++face) faces_[face].clip(ray, face, span);
  }
  return span.finish(out);
}

unsigned BoxShape::possible_ends(const ObjectRay& ray) const {
  std::array<double, 3> enter;
  std::array<double, 3> leave;
  std::array<double, 3> error;
  double last_enter = -infinity;
  double first_leave = infinity;
  // This covers the low parts of origin and direction, and the roundings here.
  constexpr double slack = 0x1p-48;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const double origin = ray.origin[axis];
    enter[i] = -infinity;
    leave[i] = infinity;
    error[i] = 0;
    if (ray.direction[axis] == 0 && ray.direction_low[axis] == 0) {
      const double margin = slack * std::abs(origin);
      if (lower_[axis] + margin < origin && origin < upper_[axis] - margin) continue;
      return all_faces;
    }
    const double inverse = 1 / ray.direction[axis];
    constexpr double steepest = 0x1p500;
    if (!(std::abs(inverse) < steepest)) return all_faces;
    const double lower = (lower_[axis] - origin) * inverse;
    const double upper = (upper_[axis] - origin) * inverse;
    enter[i] = std::min(lower, upper);
    leave[i] = std::max(lower, upper);
    error[i] = slack * (std::abs(lower) + std::abs(upper) + std::abs(origin * inverse));
    last_enter = std::max(last_enter, enter[i] - error[i]);
    first_leave = std::min(first_leave, leave[i] + error[i]);
  }
  if (last_enter > first_leave) return 0;
  unsigned faces = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool upwards = ray.direction[static_cast<int>(axis)] > 0;
    const unsigned near = 1u << (2 * axis + (upwards ? 0 : 1));
    const unsigned far = 1u << (2 * axis + (upwards ? 1 : 0));
    if (enter[axis] + error[axis] >= last_enter) faces |= near;
    if (leave[axis] - error[axis] <= first_leave) faces |= far;
  }
  return faces;
}

namespace {

/// Finds where lines that pass through a box enter it, or else leave it, if that is plainly on one
/// face. Next to an edge the exact test says which face is met.
template <class Real>
SpanEnd<Real> end_in_box(const EnclosedBox& box, const BoxMeetings<Real>& meetings,
                         const FilterLine<Real>& line, const MaskOf<Real>& enters) {
  // The greatest of three, of which the second must plainly be less.
  const std::array<Real, 3> t = {select(enters, meetings.enter[0], -meetings.leave[0]),
                                 select(enters, meetings.enter[1], -meetings.leave[1]),
                                 select(enters, meetings.enter[2], -meetings.leave[2])};
  const Real greatest = max(max(t[0], t[1]), t[2]);
  const Real second = max(min(t[0], t[1]), min(max(t[0], t[1]), t[2]));
  // (Minus infinity with its error is no number, and is not next to anything.)
  const auto beside = second + meetings.error_of(second) >= greatest - meetings.error_of(greatest);

  const auto across_x = t[0] == greatest;
  const auto across_y = t[1] == greatest;
  const auto chosen = [&](const Real& x, const Real& y, const Real& z) {
    return select(across_x, x, select(across_y, y, z));
  };
  const auto of_axis = [&](const Vec3& v) {
    return chosen(broadcast<Real>(v.x), broadcast<Real>(v.y), broadcast<Real>(v.z));
  };
  const Real speed = chosen(line.direction[0], line.direction[1], line.direction[2]);
  const auto downwards = speed < 0.0;
  const auto is_upper = (enters && downwards) || (!enters && !downwards);
  const Real position = select(is_upper, of_axis(box.upper), of_axis(box.lower));
  const auto meeting = AxisMeeting<Real>::of(
      position, chosen(line.origin[0], line.origin[1], line.origin[2]), speed);
  return {.known = meetings.known && meeting.found && !beside,
          .t = meeting.t,
          .error = meeting.error,
          .face = of_axis({0, 2, 4}) + select(is_upper, broadcast<Real>(1), Real{})};
}

}  // namespace

template <class Real>
void BoxShape::write_span(const FilterLine<Real>& line, const WantedEnds<Real>& wanted,
                          const FaceStarts<Real>* starts, ShapeSpan<Real>& span) const {
  const EnclosedBox box{lower_, upper_};
  const auto meetings = BoxMeetings<Real>::of(box, line, starts);
  const Enclosure<Real> part = meetings.enclosure();
  const MaskOf<Real> passes = part.enter_to < part.leave_from;
  span.misses = part.enter_from > part.leave_to;
  if (wanted.only_first) {
    const MaskOf<Real> enters = passes && part.enter_from > line.certain_from;
    const MaskOf<Real> is_inside = passes && part.enter_to <= line.begin;
    const MaskOf<Real> leaves = is_inside && part.leave_from > line.certain_from;
    span.misses = span.misses || part.leave_to < line.begin;
    if (!any(enters || leaves)) return;
    span.enter = end_in_box(box, meetings, line, enters);
    span.leave = span.enter;
    span.leave.known = span.leave.known && leaves;
    span.enter.known = span.enter.known && (enters || leaves);
    span.enter.t = select(enters, span.enter.t, broadcast<Real>(-infinity));
    return;
  }
  // Mostly each line has one end at most that is asked for.
  span.enter = end_in_box(box, meetings, line, wanted.enter);
  span.leave = any(wanted.enter && wanted.leave) ? end_in_box(box, meetings, line, MaskOf<Real>{})
                                                 : span.enter;
  span.enter.known = span.enter.known && wanted.enter && passes;
  span.leave.known = span.leave.known && wanted.leave && passes;
}
template void BoxShape::write_span(const FilterLine<double>&, const WantedEnds<double>&,
                                   const FaceStarts<double>*, ShapeSpan<double>&) const;
template void BoxShape::write_span(const FilterLine<Lanes>&, const WantedEnds<Lanes>&,
                                   const FaceStarts<Lanes>*, ShapeSpan<Lanes>&) const;

template <class Real>
void BoxShape::write_point(const Vec3Of<Real>& offset, const Vec3Of<Real>&, std::uint32_t face,
                           bool with_uv, SurfacePointOf<Real>& point) const {
  using Vector = Vec3Of<Real>;
  const PlaneFace& plane = faces_[face];
  const Vector size = broadcast<Real>(upper_ - lower_);
  const Vector within = clamp(offset, broadcast<Real>(Vec3(0)), size);
  point.position = min(broadcast<Real>(upper_), broadcast<Real>(lower_) + within);
  point.position[plane.axis()] = broadcast<Real>(plane.position()[plane.axis()]);
  point.normal = broadcast<Real>(plane.unit_normal());
  if (!with_uv) return;
  const Vector share = within / size;
  point.u = plane.axis() == 0 ? share.z : share.x;
  point.v = plane.axis() == 1 ? share.z : share.y;
}

template void BoxShape::write_point<double>(const Vec3&, const Vec3&, std::uint32_t, bool,
                                            SurfacePoint&) const;
template void BoxShape::write_point<Lanes>(const VectorLanes&, const VectorLanes&, std::uint32_t,
                                           bool, SurfacePointLanes&) const;

std::unique_ptr<const FaceFunctions> BoxShape::face_functions() const {
  return face_functions_of(BoxFunctions{.lower = lower_, .upper = upper_});
}

SurfacePieces BoxShape::pieces() const {
  SurfacePieces pieces;
  for (const PlaneFace& face : faces_) {
    const int axis = face.axis();
    SurfacePiece piece{
        .kind = SurfacePiece::Kind::parallelogram, .origin = lower_, .normal = face.unit_normal()};
    piece.origin[axis] = face.position()[axis];
    const int along_a = (axis + 1) % 3;
    const int along_b = (axis + 2) % 3;
    piece.edge_a[along_a] = upper_[along_a] - lower_[along_a];
    piece.edge_b[along_b] = upper_[along_b] - lower_[along_b];
    pieces.push_back(piece);
  }
  return pieces;
}

std::unique_ptr<const Shape> make_shape(const Box& box) {
  return std::make_unique<BoxShape>(box);
}

}  // namespace crt::core
