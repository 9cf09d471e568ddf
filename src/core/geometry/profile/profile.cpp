#include "core/geometry/profile/profile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "core/geometry/angles.hpp"
#include "core/geometry/canonical_plane.hpp"
#include "core/geometry/checks.hpp"
#include "core/geometry/exact_sides.hpp"
#include "core/geometry/profile_contours.hpp"
#include "core/math/vector.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt {

using namespace core;

namespace {

constexpr std::size_t max_pieces = std::size_t{1} << 26;

[[noreturn]] void reject_profile(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "profile: " + message, "profile");
}

std::string name_of(std::size_t contour, std::size_t corner) {
  return text::format("corner {} of contour {}", corner, contour);
}

Vec3 place_of(const ProfilePoint& point) {
  return {point.x, point.y, 0};
}

void check_corner(const ProfilePoint& point, const std::string& name) {
  constexpr double largest = 1e100;
  for (const double number : {point.x, point.y, point.bulge}) {
    if (!std::isfinite(number)) reject_profile(text::format("{} has {}", name, number));
  }
  if (largest_component(place_of(point)) > largest) {
    reject_profile(text::format("{} must be at most 1e100 in magnitude (it is ({}, {}))", name,
                                point.x, point.y));
  }
}

/// A PreciseStep is the way between two points, without rounding.
struct PreciseStep {
  DoubleDouble x;
  DoubleDouble y;

  PreciseStep(const Vec3& from, const Vec3& to)
      : x(two_sum(to.x, -from.x)), y(two_sum(to.y, -from.y)) {}
  DoubleDouble squared_length() const { return x * x + y * y; }
};

/// Returns how many times as long as its chord an arc is.
double arc_by_chord(double bulge) {
  const double size = std::abs(bulge);
  if (size == 0) return 1;
  return 2 * std::numbers::pi * quarter_turn(1.0, size) * (1 / size + size);
}

/// Finds the circle of an arc, if doubles can say it. It is the same for the reversed arc.
std::optional<Profile::Arc> arc_between(const Vec3& from, const Vec3& to, double bulge) {
  Profile::Arc arc{.is_right = bulge > 0};
  const PreciseStep chord(from, to);
  const DoubleDouble squared_chord = chord.squared_length();
  const DoubleDouble one = 1.0;
  const DoubleDouble half = 0.5;
  const DoubleDouble squared_bulge = two_product(bulge, bulge);
  const DoubleDouble height =
      (one - squared_bulge) / DoubleDouble(4 * bulge);  // of the center, in chords
  const DoubleDouble x = half * two_sum(from.x, to.x) - chord.y * height;
  const DoubleDouble y = half * two_sum(from.y, to.y) + chord.x * height;
  arc.center = {x.value(), y.value(), 0};
  const DoubleDouble radius_by_chord = (one + squared_bulge) / DoubleDouble(4 * std::abs(bulge));
  arc.radius = (sqrt(squared_chord) * radius_by_chord).value();
  const double moved = std::max(std::abs(x.lo), std::abs(y.lo));
  constexpr double nearly = 0x1p-48;
  for (const Vec3& center : {Vec3(from.x, to.y, 0), Vec3(to.x, from.y, 0)}) {
    if (largest_component(center - arc.center) > nearly * arc.radius) continue;
    arc.center = center;
    arc.radius = sqrt(half * squared_chord).value();  // of a quarter
    break;
  }
  double off = 0;
  for (const Vec3& corner : {from, to}) {
    const DoubleDouble squares =
        PreciseStep(arc.center, corner).squared_length() - two_product(arc.radius, arc.radius);
    off = std::max(off, std::abs(squares.value()) / (2 * arc.radius));
  }
  // The chord's line and the circle meet at an angle whose sine is half a chord by the radius.
  constexpr double least_margin = 0x1p-40;
  constexpr double safety = 8;
  const double by_distance = safety * (arc.radius / squared_chord.value());
  arc.margin = least_margin + by_distance * off;
  constexpr double largest_margin = 0x1p-6;
  if (!(by_distance * std::max(off, moved) < largest_margin)) return std::nullopt;
  return arc;
}

/// Returns a box around an arc, or around all that rounding may make of it.
Bounds bounds_of_arc(const Profile::Piece& chord, const Profile::Arc& arc) {
  Bounds box;
  box.include(chord.from);
  box.include(chord.to);
  const double size = largest_component(chord.to - chord.from);
  for (int axis = 0; axis < 2; ++axis) {
    for (const double way : {-arc.radius, arc.radius}) {
      Vec3 tip = arc.center;
      tip[axis] += way;
      if ((side_of(tip, chord.from, chord.to) < 0) != arc.is_right) continue;
      const double beyond = two_sum(arc.center[axis], way).lo;
      if (beyond != 0) tip[axis] = std::nextafter(tip[axis], std::copysign(infinity, way));
      box.include(tip);
    }
  }
  // The circle is within the margin of the corners, which is nothing if it passes through them.
  constexpr double least_margin = 0x1p-40;
  return arc.margin == least_margin ? box : box.grown(arc.margin * size);
}

/// A LineKey is the straight line of a piece. Equal lines have equal numbers.
struct LineKey {
  CanonicalPlane plane;
  std::uint32_t piece = 0;

  friend bool operator<(const LineKey& a, const LineKey& b) {
    return std::tie(a.plane.numbers, a.piece) < std::tie(b.plane.numbers, b.piece);
  }
};

LineKey line_key(const Profile::Piece& piece, std::uint32_t number) {
  const PreciseStep step(piece.from, piece.to);
  const DoubleDouble offset =
      step.y * DoubleDouble(piece.from.x) - step.x * DoubleDouble(piece.from.y);
  return {CanonicalPlane::of({step.y, -step.x, 0.0}, offset), number};
}

bool is_on_line(const Profile::Piece& piece, const Profile::Piece& of_line) {
  for (int axis = 0; axis < 2; ++axis) {
    const double place = of_line.from[axis];
    if (of_line.to[axis] == place) return piece.from[axis] == place && piece.to[axis] == place;
  }
  return side_of(piece.from, of_line.from, of_line.to) == 0 &&
         side_of(piece.to, of_line.from, of_line.to) == 0;
}

}  // namespace

std::shared_ptr<const Profile> make_profile(std::span<const Contour> contours) {
  return std::make_shared<const Profile>(contours);
}

ContourCorners core::corners_of(const Contour& contour) {
  ContourCorners corners;
  const auto is_at = [&](std::size_t corner, std::size_t other) {
    return place_of(contour[corner]) == place_of(contour[other]);
  };
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const bool is_repeated =
        !corners.kept.empty() && contour[i].bulge == 0 && is_at(i, corners.kept.back());
    if (!is_repeated) corners.kept.push_back(i);
  }
  if (corners.kept.size() > 1 && is_at(corners.kept.front(), corners.kept.back())) {
    corners.closing = corners.kept.back();
    corners.kept.pop_back();
  }
  return corners;
}

Profile::Profile(std::span<const Contour> contours) : contours_(contours.begin(), contours.end()) {
  if (contours.empty()) reject_profile("it must have a contour");
  std::size_t corners = 0;
  for (const Contour& contour : contours) corners += contour.size();
  if (corners > max_pieces) {
    reject_profile(text::format("it has at most {} corners (it has {})", max_pieces, corners));
  }
  for (std::size_t i = 0; i < contours.size(); ++i) add(contours[i], i);
  find_lines();
  find_circles();
  build_tree();
}

void Profile::add(const Contour& contour, std::size_t number) {
  for (std::size_t i = 0; i < contour.size(); ++i) check_corner(contour[i], name_of(number, i));
  const ContourCorners names = corners_of(contour);
  std::vector<ProfilePoint> corners;
  for (const std::size_t corner : names.kept) corners.push_back(contour[corner]);
  if (!corners.empty()) corners.front().bulge = contour[names.closing].bulge;
  const std::size_t first_piece = pieces_.size();
  bool has_area = false;
  double length = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    // The piece that leads to the first corner comes last.
    const std::size_t next = (i + 1) % corners.size();
    const double bulge = corners[next].bulge;
    Piece piece{.from = place_of(corners[i]), .to = place_of(corners[next])};
    if (largest_component(piece.to - piece.from) < smallest_length) {
      reject_profile(text::format("{} and {} must be at least 1e-100 apart",
                                  name_of(number, names.kept[i]),
                                  name_of(number, names.kept[next])));
    }
    piece.share_from = length;
    const double chord = glm::length(piece.to - piece.from);
    length += chord * arc_by_chord(bulge);
    piece.share_to = length;
    if (bulge != 0) {
      std::optional<Arc> arc = arc_between(piece.from, piece.to, bulge);
      if (!arc) {
        reject_profile(
            text::format("the arc to {} is too flat, or too small at its place, for "
                         "doubles to say its circle (its bulge is {})",
                         name_of(number, names.kept[next]), bulge));
      }
      arc->piece = static_cast<std::uint32_t>(pieces_.size());
      piece.arc = static_cast<std::uint32_t>(arcs_.size());
      arcs_.push_back(*arc);
    }
    has_area = has_area || bulge != 0 ||
               side_of(piece.to, place_of(corners[0]), place_of(corners[1 % corners.size()])) != 0;
    pieces_.push_back(piece);
  }
  if (!has_area) {
    reject_profile(text::format("contour {} must enclose an area (its {} corners are on one line)",
                                number, corners.size()));
  }
  for (std::size_t i = first_piece; i < pieces_.size(); ++i) {
    pieces_[i].share_from /= length;
    pieces_[i].share_to /= length;
  }
}

void Profile::find_lines() {
  std::vector<LineKey> keys;
  keys.reserve(pieces_.size());
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) keys.push_back(line_key(pieces_[i], i));
  std::sort(keys.begin(), keys.end());
  std::vector<const LineKey*> firsts;  // of the lines with the same key
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const LineKey& key = keys[i];
    if (i == 0 || key.plane.numbers != keys[i - 1].plane.numbers) firsts.clear();
    const auto found = std::find_if(firsts.begin(), firsts.end(), [&](const LineKey* first) {
      return is_on_line(pieces_[key.piece], pieces_[first->piece]);
    });
    const LineKey& first = found != firsts.end() ? **found : key;
    if (found == firsts.end()) firsts.push_back(&key);
    pieces_[key.piece].first = first.piece;
    pieces_[key.piece].turned = key.plane.flipped != first.plane.flipped;
  }
}

void Profile::find_circles() {
  const auto key_of = [this](std::uint32_t arc) {
    return std::tuple(arcs_[arc].center.x, arcs_[arc].center.y, arcs_[arc].radius);
  };
  std::vector<std::uint32_t> order(arcs_.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(key_of(a), a) < std::tuple(key_of(b), b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && key_of(order[i]) == key_of(order[i - 1]);
    arcs_[order[i]].first = is_same ? arcs_[order[i - 1]].first : order[i];
  }
}

Bounds Profile::bounds_of(std::uint32_t piece) const {
  const Piece& chord = pieces_[piece];
  Bounds box;
  box.include(chord.from);
  box.include(chord.to);
  if (chord.arc != invalid_index) box.include(arcs_[chord.arc].bounds);
  return box;
}

void Profile::build_tree() {
  for (Arc& arc : arcs_) arc.bounds = bounds_of_arc(pieces_[arc.piece], arc);
  std::vector<Bounds> boxes(pieces_.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i] = bounds_of(static_cast<std::uint32_t>(i));
    bounds_.include(boxes[i]);
  }
  // The heuristic weighs the boxes' surfaces, which shall be as their sides in the plane.
  const double height = largest_component(bounds_.upper - bounds_.lower);
  for (Bounds& box : boxes) {
    box.lower.z = -height;
    box.upper.z = height;
  }
  constexpr std::uint32_t pieces_a_leaf = 2;
  constexpr int one_thread = 1;
  tree_ = Bvh(boxes, pieces_a_leaf, one_thread);
}

std::size_t Profile::bytes() const {
  std::size_t corners = 0;
  for (const Contour& contour : contours_) corners += contour.capacity();
  return sizeof *this + contours_.capacity() * sizeof(Contour) + corners * sizeof(ProfilePoint) +
         pieces_.capacity() * sizeof(Piece) + arcs_.capacity() * sizeof(Arc) + tree_.bytes();
}

namespace core {

const std::vector<Contour>& contours_of(const Profile& profile) {
  return profile.contours();
}
const Bounds& bounds_of(const Profile& profile) {
  return profile.bounds();
}

}  // namespace core

}  // namespace crt
