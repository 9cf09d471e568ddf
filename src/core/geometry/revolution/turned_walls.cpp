#include "core/geometry/revolution/turned_walls.hpp"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/order_of_places.hpp"
#include "core/geometry/profile/agree_with_start.hpp"
#include "core/geometry/profile/errors_beside.hpp"
#include "core/geometry/revolution/candidate_search.hpp"
#include "core/geometry/revolution/exact_walls.hpp"

namespace crt::core {

namespace {

/// Sizes times this are far more than what rounding does to the places that are compared.
constexpr double filter_rounding = 0x1p-46;

/// A TurnedWall is a crossing of the line with a wall or an end. Its face is not turned.
struct TurnedWall {
  Crossing crossing;
  ShiftMask shifts = 0;  ///< the lines that cross a wall; none for an end
  bool along_normal = false;
  std::uint32_t surface = 0;  ///< the body that stands for all walls on its surface
  PassedCorner corner = {};
  std::uint32_t place = 0;  ///< counts the places along the line

  /// Returns whether both are one crossing of one surface. A line crosses a torus twice in the same
  /// sense, and all other surfaces once.
  bool is_one_with(const TurnedWall& other) const {
    return surface == other.surface && along_normal == other.along_normal &&
           crossing.root / 2 == other.crossing.root / 2;
  }
};

/// A PlaceInProfile is where a point of a line is in the profile, relative to a corner's height.
struct PlaceInProfile {
  double x = 0;
  double y = 0;
  double error = 0;
};

/// Returns the sign of t where a line crosses the plane of the first end, less that of the second.
int order_of_ends(const ExactLine& line, const std::array<Vec3, end_count>& normals) {
  std::array<Dyadic, end_count> rate;
  std::array<Dyadic, end_count> height;
  for (std::size_t end = 0; end < end_count; ++end) {
    rate[end] = dot(exactly(normals[end]), line.direction);
    height[end] = dot(exactly(normals[end]), line.origin);
  }
  return (height[1] * rate[0] - height[0] * rate[1]).sign() * rate[0].sign() * rate[1].sign();
}

/// TurnedWalls makes one list of crossings.
class TurnedWalls {
 public:
  TurnedWalls(const TurnedProfile& turned, const ObjectRay& ray, const RevolutionTier& tier,
              CrossingList& out)
      : turned_(turned), profile_(*turned.profile), ray_(ray), tier_(tier), out_(out) {}

  void append();
  /// Returns the number of the root at the start, as far as it is known.
  std::uint8_t root_at_start() const { return root_at_start_; }

 private:
  using Walls = std::pmr::vector<TurnedWall>;

  bool starts_on(std::uint32_t face) const {
    return ray_.start.face != invalid_index && are_on_one_surface(profile_, face, ray_.start.face);
  }
  bool is_at_start(const Crossing& crossing) const {
    return ray_.start.face != invalid_index && crossing.t == 0 && crossing.error == 0;
  }
  TurnedWall& add(const Crossing& crossing, std::uint32_t face, ShiftMask shifts,
                  bool along_normal);
  bool are_even() const;
  bool passes_corner(const CandidateSearch& search, const Profile::Piece& piece) const;
  bool meet_wall(std::uint32_t number);
  bool has_twin(const Crossing& crossing) const;
  std::optional<bool> is_in_wall(const Profile::Piece& piece, const Crossing& crossing) const;
  PlaceInProfile place_of(const Profile::Piece& piece, const Crossing& crossing) const;
  void meet_ends();
  void meet_exactly(std::span<const std::uint32_t> pieces);
  void unify();
  void give_start(std::uint32_t wall, Crossing& crossing);
  int order(const TurnedWall& a, const TurnedWall& b) const;
  void sort_by_place();
  void append_parts();
  void drop_if_endless();
  bool is_between_ends() const;
  const TurnedWall& chosen(Walls::const_iterator begin, Walls::const_iterator end,
                           bool entering) const;

  const TurnedProfile& turned_;
  const Profile& profile_;
  const ObjectRay& ray_;
  const RevolutionTier& tier_;
  CrossingList& out_;
  // What most lines need fits here.
  std::array<std::byte, 4096> buffer_;
  std::pmr::monotonic_buffer_resource memory_{buffer_.data(), buffer_.size()};
  Walls walls_{&memory_};
  std::pmr::vector<std::uint32_t> candidates_{&memory_};  ///< later those met by their bodies
  std::pmr::vector<std::uint32_t> open_{&memory_};        ///< candidates that take exact arithmetic
  CrossingList met_;                                      ///< of one body
  std::array<bool, end_count> is_behind_{};
  double largest_error_ = 0;
  std::uint8_t root_at_start_ = 0;
};

void TurnedWalls::append() {
  const CandidateSearch search(turned_, ray_);
  if (search.misses()) return;
  search.each(profile_.tree(), [&](std::uint32_t number) {
    const Profile::Piece& piece = profile_.pieces()[number];
    const bool is_boundary = piece.arc != invalid_index || !TurnedProfile::is_on_axis(piece);
    if (is_boundary) candidates_.push_back(number);
  });
  if (candidates_.empty()) return;
  std::size_t plain = 0;
  for (const std::uint32_t piece : candidates_) {
    const std::size_t before = walls_.size();
    if (!passes_corner(search, profile_.pieces()[piece]) && meet_wall(piece)) {
      candidates_[plain++] = piece;
    } else {
      walls_.resize(before);
      open_.push_back(piece);
    }
  }
  candidates_.resize(plain);
  const auto by_bodies = static_cast<std::ptrdiff_t>(walls_.size());
  meet_exactly(open_);
  if (!are_even()) {
    walls_.erase(walls_.begin(), walls_.begin() + by_bodies);
    meet_exactly(candidates_);
  }
  unify();
  meet_ends();
  sort_by_place();
  append_parts();
}

TurnedWall& TurnedWalls::add(const Crossing& crossing, std::uint32_t face, ShiftMask shifts,
                             bool along_normal) {
  walls_.push_back({crossing, shifts, along_normal, turned_.body_of_surface(face)});
  walls_.back().crossing.face = face;
  if (is_at_start(crossing)) root_at_start_ = crossing.root;
  largest_error_ = std::max(largest_error_, crossing.error);
  return walls_.back();
}

/// Returns whether the line passes a corner of a piece so near that only exact arithmetic says
/// which walls it crosses there. It may touch them in the corner alone, along a wall, and see
/// nothing of that. It may pass between the corner that an arc has and its circle, too, and cross
/// its chord there. And where the line leaves a body beside the corner at once, that is not seen.
/// The flatter a cone is, the farther from its rim it may be so.
bool TurnedWalls::passes_corner(const CandidateSearch& search, const Profile::Piece& piece) const {
  const Vec3 along = piece.to - piece.from;
  double off = search.shortest();
  if (piece.arc != invalid_index) {
    off += profile_.arcs()[piece.arc].margin * largest_component(along);
  } else if (along.y != 0) {
    off *= std::max(1.0, std::abs(along.x / along.y));
  }
  const auto passes = [&](const Vec3& corner) {
    return search.is_along(corner) || search.comes_near(Bounds{corner, corner}.grown(off));
  };
  return passes(piece.from) || passes(piece.to);
}

/// Returns whether both lines cross an even number of walls.
bool TurnedWalls::are_even() const {
  ShiftMask inside = 0;
  for (const TurnedWall& wall : walls_) inside ^= wall.shifts;
  return inside == 0;
}

/// Finds the crossings with a piece, or with its arc. Returns false if rounding leaves them open.
bool TurnedWalls::meet_wall(std::uint32_t number) {
  const Profile::Piece& piece = profile_.pieces()[number];
  const std::uint32_t body = end_count + number;
  const FaceStart start = turned_.start_on(body, ray_.start);
  met_.clear();
  tier_.meet(body, start, met_);
  for (const Crossing& crossing : met_) {
    // A ray that starts on a face starts on no other that is on the same surface.
    const bool is_start =
        start.face != invalid_index && is_at_start(crossing) && ray_.start.on_face;
    const std::optional<bool> is_in = is_start ? start.on_face : is_in_wall(piece, crossing);
    if (!is_in || (start.face == invalid_index && has_twin(crossing))) return false;
    if (*is_in) add(crossing, face_of_wall(number, false), both_shifts, !crossing.entering);
  }
  return true;
}

/// Returns whether a body is crossed once more so near that rounding may have made both crossings.
bool TurnedWalls::has_twin(const Crossing& crossing) const {
  return std::any_of(met_.begin(), met_.end(), [&](const Crossing& other) {
    return &other != &crossing && std::abs(other.t - crossing.t) <= other.error + crossing.error;
  });
}

PlaceInProfile TurnedWalls::place_of(const Profile::Piece& piece, const Crossing& crossing) const {
  const Vec3 p = ray_.from_center({0, piece.from.y, 0}, crossing.t, crossing.t_low);
  const double x = std::sqrt(p.x * p.x + p.z * p.z);
  return {.x = x,
          .y = p.y,
          .error = filter_rounding * std::max(x, std::abs(p.y)) +
                   2 * crossing.error * largest_component(ray_.direction)};
}

/// Returns whether a crossing with the body of a wall is in the wall, or nothing if rounding leaves
/// that open.
std::optional<bool> TurnedWalls::is_in_wall(const Profile::Piece& piece,
                                            const Crossing& crossing) const {
  const PlaceInProfile place = place_of(piece, crossing);
  const Vec3 along = piece.to - piece.from;
  const auto if_plain = [](bool is_plain, bool is_in) {
    return is_plain ? std::optional(is_in) : std::nullopt;
  };
  const auto is_off = [&](double a, double b) {
    return std::abs(a - b) > place.error + filter_rounding * std::abs(b);
  };
  if (piece.arc != invalid_index) {
    const double left = along.x * place.y - along.y * (place.x - piece.from.x);
    const double error = 2 * (place.error + filter_rounding * piece.from.x) *
                         (std::abs(along.x) + std::abs(along.y));
    return if_plain(std::abs(left) > error, (left < 0) == profile_.arcs()[piece.arc].is_right);
  }
  if (along.y == 0) {
    return if_plain(is_off(place.x, piece.from.x) && is_off(place.x, piece.to.x),
                    (place.x < piece.from.x) != (place.x < piece.to.x));
  }
  if (crossing.face == 0) return if_plain(is_off(place.y, 0) && is_off(place.y, along.y), true);
  // The line passes a corner inside, through the cap of a cone.
  const bool is_at_begin = std::abs(place.y) < std::abs(place.y - along.y);
  return if_plain(is_off(place.x, is_at_begin ? piece.from.x : piece.to.x), false);
}

void TurnedWalls::meet_ends() {
  for (std::uint32_t end = 0; end < turned_.planes; ++end) {
    met_.clear();
    is_behind_[end] = tier_.meet(end, turned_.start_on(end, ray_.start), met_);
    for (const Crossing& crossing : met_) add(crossing, end, 0, !crossing.entering);
  }
}

/// Gives a crossing with the surface that the ray starts on its t. One root is at the start, and
/// the others are those that are left.
void TurnedWalls::give_start(std::uint32_t wall, Crossing& crossing) {
  const std::uint32_t body = end_count + wall;
  const FaceStart start = turned_.start_on(body, ray_.start);
  met_.clear();
  tier_.meet(body, start, met_);
  for (const Crossing& met : met_) {
    if (met.face == 0 && met.root == crossing.root) {
      crossing.t = met.t;
      crossing.t_low = met.t_low;
      crossing.error = met.error;
    }
  }
}

/// Finds the crossings with some pieces and their arcs without rounding.
void TurnedWalls::meet_exactly(std::span<const std::uint32_t> pieces) {
  if (pieces.empty()) return;
  const ExactWalls exact(profile_, tier_.exact());
  std::vector<ExactWall> crossed;
  for (const std::uint32_t piece : pieces) exact.meet(piece, crossed);
  for (const ExactWall& wall : crossed) {
    const std::uint32_t face = face_of_wall(wall.wall, false);
    Crossing crossing{.face = face, .root = wall.root};
    tier_.place(wall.t, crossing);
    if (starts_on(face)) give_start(wall.wall, crossing);
    add(crossing, face, wall.shifts, wall.along_normal).corner = wall.corner;
  }
}

/// Gives walls on one surface, which the line crosses at once, one t: that which is known best.
void TurnedWalls::unify() {
  for (std::size_t i = 1; i < walls_.size(); ++i) {
    const Crossing& last = walls_[i].crossing;
    const auto others = std::span(walls_).first(i);
    const auto same = [&](const TurnedWall& wall) { return wall.is_one_with(walls_[i]); };
    const auto found = std::find_if(others.begin(), others.end(), same);
    if (found == others.end()) continue;
    const Crossing best = last.error < found->crossing.error ? last : found->crossing;
    for (TurnedWall& wall : std::span(walls_).first(i + 1)) {
      if (!same(wall)) continue;
      wall.crossing.t = best.t;
      wall.crossing.t_low = best.t_low;
      wall.crossing.error = best.error;
    }
  }
}

int TurnedWalls::order(const TurnedWall& a, const TurnedWall& b) const {
  return order_of_places(
      a.crossing, b.crossing, [this](std::uint32_t face) { return starts_on(face); },
      [&](const Crossing& one, const Crossing& other) {
        if (a.corner.is_known && b.corner.is_known) {
          return a.corner.order < b.corner.order ? -1 : (a.corner.order > b.corner.order ? 1 : 0);
        }
        const bool are_ends = one.face < end_count && other.face < end_count;
        if (!are_ends || one.face == other.face) return tier_.order(one, other);
        const int by_first = order_of_ends(tier_.exact(), turned_.normals);
        return one.face == 0 ? by_first : -by_first;
      });
}

void TurnedWalls::sort_by_place() {
  std::sort(walls_.begin(), walls_.end(), [this](const TurnedWall& a, const TurnedWall& b) {
    const int by_place = order(a, b);
    return by_place != 0 ? by_place < 0 : a.crossing.face < b.crossing.face;
  });
  for (std::size_t i = 1; i < walls_.size(); ++i) {
    const bool is_same = order(walls_[i - 1], walls_[i]) == 0;
    walls_[i].place = walls_[i - 1].place + (is_same ? 0 : 1);
  }
}

bool TurnedWalls::is_between_ends() const {
  if (turned_.planes == 0) return true;
  const bool second = is_behind_[turned_.planes - 1];
  return turned_.is_union ? is_behind_[0] || second : is_behind_[0] && second;
}

/// Returns the crossing that stands for all in one place. An end is crossed only as its normal
/// says.
const TurnedWall& TurnedWalls::chosen(Walls::const_iterator begin, Walls::const_iterator end,
                                      bool entering) const {
  const auto fits = [&](const TurnedWall& wall) {
    return wall.shifts != 0 || wall.along_normal != entering;
  };
  const auto start = std::find_if(begin, end, [&](const TurnedWall& wall) {
    return fits(wall) && starts_on(wall.crossing.face);
  });
  if (start != end) return *start;
  const auto first = std::find_if(begin, end, fits);
  return first != end ? *first : *begin;
}

/// Drops the last part of the line if t is beyond all doubles at one of its ends.
void TurnedWalls::drop_if_endless() {
  const auto part = out_.end() - 2;
  if (!std::isfinite(part->t) || !std::isfinite((part + 1)->t)) out_.erase(part, out_.end());
}

/// Follows the line from place to place. It is in the profile where both lines are that pass no
/// corner. What they cross in one place changes it at once.
void TurnedWalls::append_parts() {
  const std::size_t before = out_.size();
  ShiftMask inside = 0;
  bool was_inside = false;
  for (auto group = walls_.begin(); group != walls_.end();) {
    auto end = group;
    for (; end != walls_.end() && end->place == group->place; ++end) {
      if (end->shifts == 0) is_behind_[end->crossing.face] = !end->along_normal;
      inside ^= end->shifts;
    }
    const bool is_inside = inside == both_shifts && is_between_ends();
    if (is_inside != was_inside) {
      const TurnedWall& wall = chosen(group, end, is_inside);
      Crossing crossing = wall.crossing;
      crossing.entering = is_inside;
      if (!starts_on(crossing.face)) {
        const LongestError longest(unit_roundoff * turned_.size() /
                                   largest_component(ray_.direction));
        bound_beside(walls_, group, end, largest_error_, longest, crossing);
      }
      if (wall.shifts != 0 && wall.along_normal == is_inside) ++crossing.face;
      out_.push_back(crossing);
      if (!is_inside) drop_if_endless();
    }
    was_inside = is_inside;
    group = end;
  }
  // What a start on a surface changes may leave a part open.
  if (out_.size() % 2 != before % 2) out_.pop_back();
}

}  // namespace

void append_crossings(const TurnedProfile& turned, const ObjectRay& ray, const RevolutionTier& tier,
                      CrossingList& out) {
  const std::size_t begin = out.size();
  TurnedWalls walls(turned, ray, tier, out);
  walls.append();
  if (ray.start.face == invalid_index || !ray.start.on_face) return;
  const double shortest = unit_roundoff * turned.size() / largest_component(ray.direction);
  agree_with_start(ray, walls.root_at_start(), turned.profile->bounds().farthest(), shortest, begin,
                   out);
}

}  // namespace crt::core
