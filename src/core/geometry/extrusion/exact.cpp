// Extrusions of the exact tier find where the line meets each plane and each cylinder without
// rounding.
#include "core/geometry/frustum/exact.hpp"
#include "core/geometry/exact_flat.hpp"
#include "core/geometry/extrusion/extrusion.hpp"
#include "core/geometry/known_places.hpp"

namespace crt::core {

namespace {

/// An ExactExtrusion has the surfaces of an extrusion.
struct ExactExtrusion {
  std::shared_ptr<const Profile> profile;
  std::array<ExactPlane, 2> ends;
  std::vector<ExactPlane> planes;                        ///< by piece
  std::vector<std::unique_ptr<ExactFrustum>> cylinders;  ///< by arc, for first arcs

  explicit ExactExtrusion(const Extrusion& extrusion);

  /// Returns the plane of a face, which must not be round.
  const ExactPlane& plane_of(std::uint32_t face) const {
    if (face < end_count) return ends[face];
    return planes[profile->pieces()[profile->wall(wall_of_face(face)).piece].first];
  }
  const Profile::Arc* arc_of(std::uint32_t face) const {
    if (face < end_count) return nullptr;
    const Profile::Wall wall = profile->wall(wall_of_face(face));
    return wall.arc != invalid_index ? &profile->arcs()[wall.arc] : nullptr;
  }
  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const;
};

ExactExtrusion::ExactExtrusion(const Extrusion& extrusion)
    : profile(extrusion.profile),
      ends{ExactPlane({0, 0, -1}, {0, 0, std::min(extrusion.from, extrusion.to)}),
           ExactPlane({0, 0, 1}, {0, 0, std::max(extrusion.from, extrusion.to)})} {
  planes.reserve(profile->pieces().size());
  for (const Profile::Piece& piece : profile->pieces()) {
    planes.push_back(ExactPlane::through(piece.from, piece.to, piece.from + Vec3(0, 0, 1)));
  }
  cylinders.resize(profile->arcs().size());
  for (std::uint32_t i = 0; i < cylinders.size(); ++i) {
    const Profile::Arc& arc = profile->arcs()[i];
    if (arc.first != i) continue;
    const Vec3 from(arc.center.x, arc.center.y, ends[0].position().z);
    const Vec3 to(arc.center.x, arc.center.y, ends[1].position().z);
    cylinders[i] = std::make_unique<ExactFrustum>(from, to, arc.radius, arc.radius);
  }
}

std::optional<RealRoot> ExactExtrusion::place(const ExactRay& ray, const Crossing& crossing) const {
  const Profile::Arc* arc = arc_of(crossing.face);
  if (arc == nullptr) return place_on(plane_of(crossing.face), ray, crossing);
  if (is_start(ray, crossing)) return RealRoot::at(0);
  const std::uint32_t start = ray.near.start.face;
  const bool starts_there =
      start != invalid_index && are_on_one_surface(*profile, start, crossing.face);
  const ExactQuadratic circle = PlaneLine(ray).equation(*arc);
  return root_at(ray, crossing, starts_there ? circle.beside_zero() : circle.polynomial());
}

class ExactTier final : public ExtrusionTier {
 public:
  ExactTier(const ExactExtrusion& extrusion, const ExactRay& ray, PlaneLine& line)
      : extrusion_(extrusion), ray_(ray), line_(line) {
    enter_.meeting.side = -1;
    leave_.meeting.side = 1;
    for (std::uint32_t end = 0; end < end_count; ++end) {
      CapMeeting& meeting = meetings_[end];
      meeting.face = end;
      meeting.at_start = ray.near.start.face == end;
      if (meeting.at_start) {
        meeting.meeting.side = extrusion.ends[end].side(ray);
      } else {
        meeting.meeting = extrusion.ends[end].meet(ray);
      }
      if (!meeting.meeting.found()) continue;
      meeting.plane = &extrusion.ends[end];
      (meeting.meeting.side < 0 ? enter_ : leave_) = meeting;
    }
  }

  EndMeeting meet_end(std::uint32_t end) const override {
    const ExactPlane::Meeting& meeting = meetings_[end].meeting;
    return {.side = meeting.side,
            .found = meeting.found(),
            .behind = meeting.behind,
            .crossing = meeting.crossing()};
  }

  bool meet(std::uint32_t piece, Crossing& crossing) const override {
    const ExactPlane::Meeting meeting = extrusion_.planes[piece].meet(ray_);
    crossing.t = meeting.t.hi;
    crossing.t_low = meeting.t.lo;
    crossing.error = meeting.error;
    return meeting.found();
  }

  std::array<Crossing, 2> meet_circle(std::uint32_t arc, const EndSpan&) const override {
    FilteredSide side(*extrusion_.cylinders[arc], ray_);
    const std::optional<Crossing> enter = side.root(true, enter_, leave_);
    const std::optional<Crossing> leave = side.root(false, enter_, leave_);
    if (enter && leave) return {*enter, *leave};
    const auto roots = line_.equation(extrusion_.profile->arcs()[arc]).roots();
    return {exact_crossing(roots[0], {}), exact_crossing(roots[1], {})};
  }

  Crossing meet_circle_again(std::uint32_t arc) const override {
    const std::optional<SideStart> side = FilteredSide(*extrusion_.cylinders[arc], ray_).start();
    if (side) return side->other;
    const ExactQuadratic circle = line_.equation(extrusion_.profile->arcs()[arc]);
    return exact_crossing(circle.root_beside_zero(), {});
  }

  void place(const DoubleDouble& t, Crossing& crossing) const override {
    crossing = exact_crossing(t, crossing);
  }

  int order(const Crossing& first, const Crossing& second) const override {
    if (are_on_one_surface(*extrusion_.profile, first.face, second.face) &&
        first.root == second.root) {
      return 0;
    }
    const auto find = [this](const Crossing& crossing) { return extrusion_.place(ray_, crossing); };
    return places_.order(first, second, find);
  }

 private:
  const ExactExtrusion& extrusion_;
  const ExactRay& ray_;
  PlaneLine& line_;
  std::array<CapMeeting, 2> meetings_;
  CapMeeting enter_;
  CapMeeting leave_;
  mutable KnownPlaces places_;
};

class ExactExtrusionShape final : public ExactShape {
 public:
  explicit ExactExtrusionShape(const Extrusion& extrusion)
      : extrusion_(extrusion), shortest_(unit_roundoff * size_of(extrusion)) {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    PlaneLine line(ray);
    const ExactTier tier(extrusion_, ray, line);
    append_crossings(*extrusion_.profile, line, tier,
                     shortest_ / largest_component(ray.near.direction), out);
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    return extrusion_.place(ray, crossing);
  }

  ExactSurface surface(std::uint32_t face) const override {
    const Profile::Arc* arc = extrusion_.arc_of(face);
    if (arc == nullptr) {
      return {.is_plane = true, .points = {}, .numbers = extrusion_.plane_of(face).numbers()};
    }
    const ExactFrustum& cylinder = *extrusion_.cylinders[arc->first];
    return {.points = {exactly(cylinder.narrow), exactly(cylinder.wide)},
            .numbers = {cylinder.radius, cylinder.wide_radius}};
  }

  /// Returns only its own bytes, and not those of the profile.
  std::size_t bytes() const override {
    std::size_t bytes = sizeof *this + extrusion_.planes.capacity() * sizeof(ExactPlane) +
                        extrusion_.cylinders.capacity() * sizeof(extrusion_.cylinders[0]);
    for (const ExactPlane& plane : extrusion_.planes) bytes += plane.more_bytes();
    for (const auto& cylinder : extrusion_.cylinders) bytes += cylinder ? sizeof *cylinder : 0;
    return bytes;
  }

 private:
  static double size_of(const Extrusion& extrusion) {
    const Bounds& bounds = extrusion.profile->bounds();
    return std::max(largest_component(bounds.upper - bounds.lower),
                    std::abs(extrusion.to - extrusion.from));
  }

  ExactExtrusion extrusion_;
  double shortest_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Extrusion& extrusion) {
  return std::make_unique<ExactExtrusionShape>(extrusion);
}

}  // namespace crt::core
