// The box of the exact tier compares the last of the three faces that are entered with the first of
// the three that are left.
#include <array>

#include "core/geometry/box/box.hpp"
#include "core/geometry/clipped_span.hpp"
#include "core/geometry/exact_plane.hpp"
#include "core/geometry/exact_shape.hpp"
#include "core/math/vector.hpp"

namespace crt::core {
namespace {

class ExactBoxShape final : public ExactShape {
 public:
  explicit ExactBoxShape(const Box& box)
      : size_(largest_component(box.corner_a - box.corner_b)),
        faces_{ExactPlane({-1, 0, 0}, glm::min(box.corner_a, box.corner_b)),
               ExactPlane({1, 0, 0}, glm::max(box.corner_a, box.corner_b)),
               ExactPlane({0, -1, 0}, glm::min(box.corner_a, box.corner_b)),
               ExactPlane({0, 1, 0}, glm::max(box.corner_a, box.corner_b)),
               ExactPlane({0, 0, -1}, glm::min(box.corner_a, box.corner_b)),
               ExactPlane({0, 0, 1}, glm::max(box.corner_a, box.corner_b))} {}

  bool crossings(const ExactRay& ray, CrossingList& out) const override {
    if (ray.near.start.face != invalid_index) return crossings_from_face(ray, out);
    End enter;
    End leave;
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      const ExactPlane::Meeting meeting = faces_[face].meet(ray);
      if (!meeting.found()) {
        if (!meeting.behind) return false;
        continue;
      }
      End& end = meeting.side < 0 ? enter : leave;
      if (end.face == invalid_index || is_nearer(ray, meeting, face, end)) end = {meeting, face};
      if (surely_passed(enter, leave)) return false;
    }
    if (enter.face == invalid_index || leave.face == invalid_index) return false;
    if (order(ray, faces_[enter.face], enter.meeting, faces_[leave.face], leave.meeting) >= 0)
      return false;
    out.push_back(enter.meeting.crossing(enter.face));
    out.push_back(leave.meeting.crossing(leave.face));
    return false;
  }

  std::optional<RealRoot> place(const ExactRay& ray, const Crossing& crossing) const override {
    if (is_start(ray, crossing)) return RealRoot::at(0);
    return root_at(ray, crossing, faces_[crossing.face].equation(ray.exact()));
  }

  ExactSurface surface(std::uint32_t face) const override {
    return {.is_plane = true, .points = {}, .numbers = faces_[face].numbers()};
  }

  std::size_t bytes() const override {
    std::size_t bytes = sizeof *this;
    for (const ExactPlane& plane : faces_) bytes += plane.more_bytes();
    return bytes;
  }

 private:
  /// An End is where the line enters or leaves what is between the faces tested until then.
  struct End {
    ExactPlane::Meeting meeting;
    std::uint32_t face = invalid_index;
  };

  bool is_nearer(const ExactRay& ray, const ExactPlane::Meeting& meeting, std::uint32_t face,
                 const End& end) const {
    const int later = order(ray, faces_[face], meeting, faces_[end.face], end.meeting);
    return meeting.side < 0 ? later > 0 : later < 0;
  }

  static bool surely_passed(const End& enter, const End& leave) {
    return enter.face != invalid_index && leave.face != invalid_index &&
           enter.meeting.t.hi - leave.meeting.t.hi > enter.meeting.error + leave.meeting.error;
  }

  /// Finds the crossings of a ray from a face. The start is on its face by identity, so only the
  /// meetings with the other faces are computed.
  bool crossings_from_face(const ExactRay& ray, CrossingList& out) const {
    ClippedSpan span(ray.near.start,
                     unit_roundoff * (size_ / largest_component(ray.near.direction)));
    for (std::uint32_t face = 0; face < faces_.size(); ++face) {
      ExactPlane::Meeting meeting;
      if (face == ray.near.start.face) {
        meeting.side = faces_[face].side(ray);
        if (meeting.side <= 0 && ray.near.start.side == Side::outside) span.clear();
        if (meeting.side == 0) continue;
      } else {
        meeting = faces_[face].meet(ray);
      }
      if (!meeting.found()) {
        if (!meeting.behind) span.clear();
        continue;
      }
      if (meeting.side > 0) {
        span.leave(meeting.crossing(face));
      } else {
        span.enter(meeting.crossing(face));
      }
    }
    return span.finish(out);
  }

  double size_;
  std::array<ExactPlane, 6> faces_;
};

}  // namespace

std::unique_ptr<const ExactShape> make_exact_shape(const Box& box) {
  return std::make_unique<ExactBoxShape>(box);
}

}  // namespace crt::core
