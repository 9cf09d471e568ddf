#include "core/geometry/revolution/exact_walls.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/geometry/revolution/turned_walls.hpp"
#include "core/math/isolated_roots.hpp"

namespace crt::core {

namespace {

/// This is what holds of one line only: of that which is farther from the axis, or higher.
constexpr ShiftMask moved_up = 1;

DyadicPolynomial linear(const std::array<Dyadic, 2>& coefficients) {
  return DyadicPolynomial({coefficients[0], coefficients[1]});
}

/// Returns all roots of a polynomial in order. That of 0 has none.
std::vector<RealRoot> all_roots(const DyadicPolynomial& polynomial) {
  const IsolatedRoots isolated = isolated_roots(polynomial);
  std::vector<RealRoot> roots;
  for (const auto& [low, high] : isolated.brackets) {
    roots.emplace_back(isolated.polynomial, low, high);
  }
  return roots;
}

/// A DividingPlace is where a line may cross a circle or its chord.
struct DividingPlace {
  RealRoot root;
  std::optional<std::size_t> of_chord;  ///< the number of the chord's root, if it has one there
};

std::vector<DividingPlace> merged(std::vector<RealRoot> circle, std::vector<RealRoot> chord) {
  std::vector<DividingPlace> places;
  std::size_t next = 0;  // of the chord's roots
  for (RealRoot& root : circle) {
    int order_of_next = 1;
    while (next < chord.size() && (order_of_next = order(chord[next], root)) < 0) {
      places.push_back({chord[next], next});
      ++next;
    }
    places.push_back({std::move(root), std::nullopt});
    if (next < chord.size() && order_of_next == 0) places.back().of_chord = next++;
  }
  for (; next < chord.size(); ++next) places.push_back({chord[next], next});
  return places;
}

/// Returns what has the root of a linear polynomial alone.
ExactQuadratic quadratic_of(const Dyadic& constant, const Dyadic& rate) {
  constexpr double half = 0.5;
  return {Dyadic(), Dyadic(half) * rate, constant};
}

DoubleDouble quotient(const Dyadic& a, const Dyadic& b) {
  return (a.rounded() / b.rounded()).unscaled();
}

/// Returns a root to about 100 bits. There must be one.
DoubleDouble root_of(const ExactQuadratic& g, std::size_t number) {
  if (g.a.sign() == 0) return quotient(-g.c, g.b + g.b);
  return g.discriminant().sign() > 0 ? g.roots()[number] : quotient(-g.b, g.a);
}

/// Returns whether both neighbours of a line are not on one side of something.
bool is_divided(ShiftMask mask) {
  return mask != 0 && mask != both_shifts;
}

/// Returns about where a line is closest to what a profile makes, if that is far away, and 0 if
/// not. It has few digits.
double far_place(const ExactLine& line, const Bounds& box) {
  const Vec3 middle(0, 0.5 * box.lower.y + 0.5 * box.upper.y, 0);
  const double reach = std::max(box.upper.x, box.upper.y - box.lower.y);
  const Dyadic squared = dot(line.direction, line.direction);
  if (squared.sign() == 0) return 0;
  const Dyadic along = dot(line.direction, line.weight * exactly(middle) - line.origin);
  const double closest = quotient(along, squared).hi;
  const ScaledNumber in_t = (Dyadic(reach) * line.weight).rounded() / sqrt(squared.rounded());
  const double size = in_t.unscaled().hi;
  constexpr double far = 4;
  if (!(std::abs(closest) > far * size) || !std::isfinite(closest) || !(size > 0)) return 0;
  const double unit = power_of_two_below(size);
  return unit * std::round(closest / unit);
}

}  // namespace

ExactWalls::ExactWalls(const Profile& profile, const ExactLine& line)
    : profile_(profile),
      shift_(far_place(line, profile.bounds())),
      weight_(line.weight),
      origin_(line.origin + Dyadic(shift_) * line.direction),
      direction_(line.direction),
      height_(origin_[1]),
      climb_(direction_[1]) {
  const auto product = [](const DyadicVector& a, const DyadicVector& b) {
    return a[0] * b[0] + a[2] * b[2];
  };
  q_ = {product(direction_, direction_), product(direction_, origin_), product(origin_, origin_)};
}

ShiftMask ExactWalls::beyond(const Vec3& corner) const {
  const Dyadic above = weight_ * Dyadic(corner.y) - height_;
  if (climb_.sign() == 0) return mask_of_sign(above.sign(), complement(moved_up));
  if (corner.x == 0) return both_shifts;
  const Dyadic x = origin_[0] * climb_ + above * direction_[0];
  const Dyadic z = origin_[2] * climb_ + above * direction_[2];
  return mask_of_sign((square(x) + square(z) - square(weight_ * Dyadic(corner.x) * climb_)).sign(),
                      moved_up);
}

std::array<Dyadic, 2> ExactWalls::radius_times_height(const Profile::Piece& piece) const {
  const Dyadic x = Dyadic(piece.to.x) - Dyadic(piece.from.x);
  const Dyadic y = Dyadic(piece.to.y) - Dyadic(piece.from.y);
  return {x * (height_ - weight_ * Dyadic(piece.from.y)) + weight_ * Dyadic(piece.from.x) * y,
          x * climb_};
}

int ExactWalls::slope_at(const ExactQuadratic& g, const Vec3& corner) const {
  const Dyadic above = weight_ * Dyadic(corner.y) - height_;
  return (g.a * above + g.b * climb_).sign() * climb_.sign();
}

ExactWalls::PieceCut ExactWalls::level_cut(const Profile::Piece& piece) const {
  PieceCut cut;
  if (climb_.sign() == 0) return cut;
  cut.equation = quadratic_of(height_ - weight_ * Dyadic(piece.from.y), climb_);
  cut.shifts[0] = beyond(piece.from) ^ beyond(piece.to);
  cut.along_normal[0] = climb_.sign() > 0;
  return cut;
}

ExactWalls::PieceCut ExactWalls::cut(const Profile::Piece& piece) const {
  if (piece.from.y == piece.to.y) return level_cut(piece);
  const Dyadic height = Dyadic(piece.to.y) - Dyadic(piece.from.y);
  const auto radius = radius_times_height(piece);
  const Dyadic squared = square(height);
  const ExactQuadratic g{squared * q_.a - square(radius[1]), squared * q_.b - radius[1] * radius[0],
                         squared * q_.c - square(radius[0])};
  PieceCut cut{.equation = g, .along_normal = {false, true}};
  const int bend = g.a.sign();
  const int discriminant = g.discriminant().sign();
  const bool climbs = (piece.to.y > piece.from.y) == (climb_.sign() >= 0);
  const Vec3& first = climbs ? piece.from : piece.to;
  const Vec3& last = climbs ? piece.to : piece.from;
  const ShiftMask before = beyond(first);
  const ShiftMask after = beyond(last);
  if (climb_.sign() == 0) {
    if (discriminant > 0) cut.shifts = {before ^ after, before ^ after};
    return cut;
  }
  // Where g falls and rises is at the first root and at the last, if it is bent upwards.
  const ShiftMask falls = before & complement(after);
  const ShiftMask rises = after & complement(before);
  if (bend == 0 || discriminant == 0) {
    // A line along the side of a cone comes in and goes out through the apex.
    const Vec3& apex = piece.from.x == 0 ? piece.from : piece.to;
    if (bend == 0 && discriminant == 0 && g.c.sign() == 0) {
      cut.equation = quadratic_of(height_ - weight_ * Dyadic(apex.y), climb_);
      cut.apex = &apex;
    }
    cut.shifts[0] = falls | rises;
    cut.along_normal[0] = falls == 0;
    return cut;
  }
  cut.shifts = {bend > 0 ? falls : rises, bend > 0 ? rises : falls};
  if (bend < 0) cut.along_normal = {true, false};
  if (discriminant > 0 && slope_at(g, first) == -bend && slope_at(g, last) == bend) {
    const ShiftMask twice = bend > 0 ? before & after : complement(before | after);
    for (ShiftMask& shifts : cut.shifts) shifts |= twice;
  }
  return cut;
}

struct ExactWalls::Segment {
  bool is_sphere;
  bool is_lemon;
  bool is_right;
  DyadicPolynomial sum;      ///< q + (y - b)^2 + a^2 - r^2, for the center (a, b) and the radius r
  DyadicPolynomial quartic;  ///< its square, less 4 a^2 q
  DyadicPolynomial q;
  DyadicPolynomial radius;  ///< of the chord's line, times `height`
  Dyadic height;
  ShiftMask left_if_along;  ///< the lines that are left of the chord's line if they are on it

  const DyadicPolynomial& boundary() const { return is_sphere ? sum : quartic; }

  bool is_in_disc(const Dyadic& t) const {
    const bool is_near = sum.value(t).sign() < 0;
    if (is_sphere || is_near != is_lemon) return is_near;
    return (quartic.value(t).sign() < 0) != is_lemon;
  }

  ShiftMask beyond_chord(const Dyadic& t) const {
    const Dyadic radius_here = radius.value(t);
    const int side = radius_here.sign();
    int left = side;
    if (height.sign() != 0) {
      const int aside = height.sign();
      const int nearer = (square(radius_here) - square(height) * q.value(t)).sign();
      left = side != aside ? -aside : side * nearer;
    }
    const ShiftMask on_left = mask_of_sign(left, left_if_along);
    return is_right ? complement(on_left) : on_left;
  }
};

void ExactWalls::meet_arc(const Profile::Arc& arc, std::vector<ExactWall>& walls) const {
  const Profile::Piece& chord = profile_.pieces()[arc.piece];
  const PieceCut piece_cut = cut(chord);
  const Dyadic height = Dyadic(chord.to.y) - Dyadic(chord.from.y);
  const Dyadic width = Dyadic(chord.to.x) - Dyadic(chord.from.x);
  const Dyadic ring(ring_of(arc));
  const DyadicPolynomial above = linear({height_ - weight_ * Dyadic(arc.center.y), climb_});
  const DyadicPolynomial q = q_.polynomial();
  const DyadicPolynomial sum =
      q + above * above +
      DyadicPolynomial({square(weight_) * (square(ring) - square(Dyadic(arc.radius)))});
  Segment segment{.is_sphere = ring.sign() == 0,
                  .is_lemon = ring.sign() < 0,
                  .is_right = arc.is_right,
                  .sum = sum,
                  .quartic = sum * sum - Dyadic(4) * square(weight_ * ring) * q,
                  .q = q,
                  .radius = linear(radius_times_height(chord)),
                  .height = height,
                  .left_if_along = 0};
  // A line that is farther from the axis is to the right of a piece that goes up, and one that is
  // higher to the left of a piece that goes away from the axis.
  const int up_is_left = climb_.sign() != 0 ? -height.sign() : width.sign();
  segment.left_if_along = up_is_left > 0 ? moved_up : complement(moved_up);

  std::vector<DividingPlace> places =
      merged(all_roots(segment.boundary()), roots_of(chord, piece_cut));

  bool was_in_disc = false;
  ShiftMask was_inside = 0;
  std::uint8_t disc_roots = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto& [root, of_chord] = places[i];
    const Dyadic next =
        i + 1 < places.size() ? RealRoot::between(root, places[i + 1].root) : root.above();
    const bool in_disc = segment.is_in_disc(next);
    const ShiftMask inside = in_disc ? segment.beyond_chord(next) : 0U;
    ShiftMask shifts = was_inside ^ inside;
    if (of_chord) shifts ^= piece_cut.shifts[*of_chord];
    const bool crosses_disc = in_disc != was_in_disc;
    if (shifts != 0 && (crosses_disc || of_chord)) {
      ExactWall wall{
          .wall = arc.piece, .root = disc_roots, .shifts = shifts, .along_normal = !in_disc};
      if (!crosses_disc) {
        wall.wall = profile_.chord_of(chord.arc);
        wall.root = static_cast<std::uint8_t>(*of_chord);
        wall.along_normal = piece_cut.along_normal[*of_chord];
      }
      if (of_chord && is_divided(piece_cut.shifts[*of_chord])) {
        place_at(crossed_corner(chord, piece_cut, *of_chord), *of_chord, wall);
      } else {
        wall.t = root.rounded();
      }
      walls.push_back(wall);
    }
    if (crosses_disc) ++disc_roots;
    was_in_disc = in_disc;
    was_inside = inside;
  }
}

void ExactWalls::meet(std::uint32_t number, std::vector<ExactWall>& walls) const {
  const Profile::Piece& piece = profile_.pieces()[number];
  const std::size_t before = walls.size();
  if (piece.arc != invalid_index) {
    meet_arc(profile_.arcs()[piece.arc], walls);
  } else {
    meet_piece(number, walls);
  }
  for (std::size_t i = before; i < walls.size(); ++i) {
    walls[i].t = walls[i].t + DoubleDouble(shift_);
  }
}

void ExactWalls::meet_piece(std::uint32_t number, std::vector<ExactWall>& walls) const {
  const Profile::Piece& piece = profile_.pieces()[number];
  const PieceCut piece_cut = cut(piece);
  for (std::size_t i = 0; i < piece_cut.shifts.size(); ++i) {
    const ShiftMask shifts = piece_cut.shifts[i];
    if (shifts == 0) continue;
    ExactWall wall{.wall = number,
                   .root = static_cast<std::uint8_t>(i),
                   .shifts = shifts,
                   .along_normal = piece_cut.along_normal[i]};
    if (is_divided(shifts)) {
      place_at(crossed_corner(piece, piece_cut, i), i, wall);
    } else {
      wall.t = root_of(piece_cut.equation, i);
    }
    walls.push_back(wall);
  }
}

const Vec3& ExactWalls::crossed_corner(const Profile::Piece& piece, const PieceCut& cut,
                                       std::size_t root) const {
  if (cut.apex != nullptr) return *cut.apex;
  const bool passes_from = is_divided(beyond(piece.from));
  if (!passes_from || !is_divided(beyond(piece.to))) return passes_from ? piece.from : piece.to;
  const bool climbs = (piece.to.y > piece.from.y) == (climb_.sign() > 0);
  return climbs == (root == 0) ? piece.from : piece.to;
}

std::vector<RealRoot> ExactWalls::roots_of(const Profile::Piece& piece, const PieceCut& cut) const {
  std::vector<RealRoot> roots = all_roots(cut.equation.polynomial());
  if (climb_.sign() == 0) return roots;
  for (std::size_t i = 0; i < std::min(roots.size(), cut.shifts.size()); ++i) {
    if (!is_divided(cut.shifts[i])) continue;
    const Vec3& corner = crossed_corner(piece, cut, i);
    roots[i] = all_roots(linear({height_ - weight_ * Dyadic(corner.y), climb_}))[0];
  }
  return roots;
}

void ExactWalls::place_at(const Vec3& corner, std::size_t root, ExactWall& wall) const {
  wall.corner.is_known = true;
  if (climb_.sign() != 0) {
    wall.t = quotient(weight_ * Dyadic(corner.y) - height_, climb_);
    wall.corner.order = climb_.sign() > 0 ? corner.y : -corner.y;
    return;
  }
  wall.t = root_of({q_.a, q_.b, q_.c - square(weight_ * Dyadic(corner.x))}, root);
  wall.corner.order = root == 0 ? -corner.x : corner.x;
}

}  // namespace crt::core
