// Each piece of a contour is moved along its normals, so an arc becomes one about the same center.
// A gap at a corner is closed by an arc about it. Where pieces cross instead, the way from one to
// the next leads over the corner, and an arc whose radius would change its sign is two lines over
// its center. These loops go about nothing counterclockwise, so the new region is where the
// winding number is above 0.
// Source: Chen and McMains, Polygon offsetting by computing winding numbers, 2005.
// Tests: tests/contours/offset_test.cpp
#include "crt/offset.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/contours/fill.hpp"
#include "core/contours/winding.hpp"
#include "crt/error.hpp"

namespace crt {

namespace core {

namespace {

using Work = std::function<void(std::uint64_t)>;

Vec2 place_in_plane(const ProfilePoint& corner) {
  return {corner.x, corner.y};
}

/// Returns the tangent of a quarter of the angle from one direction to another, in [-1, 1].
double bulge_of_turn(const Vec2& from, const Vec2& to) {
  const double cosine = std::clamp(dot(from, to), -1.0, 1.0);
  const double half_sine = std::copysign(std::sqrt(0.5 - 0.5 * cosine), cross(from, to));
  const double half_cosine = std::sqrt(0.5 + 0.5 * cosine);
  return half_sine / (1 + half_cosine);
}

/// A ContourStep leads from one corner to the next, straight or by an arc of a quarter of a circle
/// at most.
struct ContourStep {
  Vec2 from{0, 0};
  Vec2 to{0, 0};
  double bulge = 0;
  Vec2 begin_normal{0, 0};  ///< to the right of the direction there
  Vec2 end_normal{0, 0};

  ContourStep(const Vec2& a, const Vec2& b, double arc) : from(a), to(b), bulge(arc) {
    const Vec2 right = -quarter_turned((b - a) / glm::length(b - a));
    // The direction at the ends is off that of the chord by half of the angle.
    const double square = arc * arc;
    const double cosine = (1 - square) / (1 + square);
    const double sine = 2 * arc / (1 + square);
    begin_normal = cosine * right - sine * quarter_turned(right);
    end_normal = cosine * right + sine * quarter_turned(right);
  }

  /// Returns the center of the arc.
  Vec2 center() const {
    return 0.5 * (from + to) + (1 - bulge * bulge) / (4 * bulge) * quarter_turned(to - from);
  }
  /// Returns how far away it is, above 0 to the left of the direction.
  double signed_radius() const {
    return glm::length(to - from) * (1 + bulge * bulge) / (4 * bulge);
  }
};

/// Appends the piece between two corners, in parts of at most a quarter of a circle.
void append_steps(const Vec2& from, const Vec2& to, double bulge, std::vector<ContourStep>& steps) {
  constexpr double quarter = 0.41421356237309515;  // the tangent of 22.5 degrees, rounded up
  if (std::abs(bulge) <= quarter) {
    steps.emplace_back(from, to, bulge);
    return;
  }
  // The top of an arc is half a chord times the bulge away from it.
  const Vec2 middle = 0.5 * (from + to) - 0.5 * bulge * quarter_turned(to - from);
  const double half = bulge / (1 + std::sqrt(1 + bulge * bulge));
  append_steps(from, middle, half, steps);
  append_steps(middle, to, half, steps);
}

std::vector<ContourStep> contour_steps(const Contour& contour) {
  std::vector<ContourStep> steps;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ProfilePoint& to = contour[(i + 1) % contour.size()];
    const Vec2 begin = place_in_plane(contour[i]);
    const Vec2 end = place_in_plane(to);
    if (begin != end) append_steps(begin, end, to.bulge, steps);
  }
  return steps;
}

/// Moves the pieces of a contour that has the region to its left. The last corner repeats the
/// first.
Contour moved_by(const std::vector<ContourStep>& steps, double distance) {
  Contour result;
  const auto add = [&result](const Vec2& place, double bulge = 0) {
    const bool is_there = !result.empty() && place_in_plane(result.back()) == place;
    if (!is_there) result.push_back({.x = place.x, .y = place.y, .bulge = bulge});
  };
  add(steps.front().from + distance * steps.front().begin_normal);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const ContourStep& step = steps[i];
    const ContourStep& next = steps[(i + 1) % steps.size()];
    const double turn = cross(step.end_normal, next.begin_normal);
    constexpr double smooth = 0x1p-40;
    const bool is_straight = std::abs(turn) < smooth;
    const bool goes_back = is_straight && dot(step.end_normal, next.begin_normal) < 0;
    const bool is_joined = is_straight && !goes_back;
    // Where the direction does not change, the next piece begins where this one ends.
    const Vec2 begin = step.to + distance * next.begin_normal;
    const Vec2 end = is_joined ? begin : step.to + distance * step.end_normal;
    const bool turns_over = step.bulge != 0 && (1 + distance / step.signed_radius()) * 0x1p40 < 1;
    if (turns_over) add(step.center());
    add(end, turns_over ? 0 : step.bulge);
    if (is_joined) continue;
    const bool is_gap = turn * distance > 0 || goes_back;
    if (!is_gap) {
      add(step.to);
      add(begin);
    } else {
      const double bulge = bulge_of_turn(step.end_normal, next.begin_normal);
      add(begin, goes_back ? std::copysign(1, distance) : bulge);
    }
  }
  return result;
}

/// Returns whether a moved contour has shrunk to a point, but for rounding.
bool is_point(const Contour& contour, double distance) {
  constexpr double share = 0x1p-36;
  const auto is_near = [&](const ProfilePoint& corner) {
    return glm::length(place_in_plane(corner) - place_in_plane(contour[0])) <=
           share * std::abs(distance);
  };
  return std::ranges::all_of(contour, is_near);
}

Contour reversed(const Contour& contour) {
  Contour result;
  for (std::size_t i = contour.size(); i-- > 0;)
    result.push_back({contour[i].x, contour[i].y, -contour[(i + 1) % contour.size()].bulge});
  return result;
}

std::vector<PlanePiece> pieces_of(const Contour& contour) {
  std::vector<PlanePiece> pieces;
  for (const ContourStep& step : contour_steps(contour))
    pieces.emplace_back(step.from, step.to, step.bulge);
  return pieces;
}

/// Returns contours that do not cross so that the region is to the left of each.
std::vector<Contour> turned_to_the_region(const std::vector<Contour>& contours, Budget& budget) {
  std::vector<PlanePiece> all;
  for (const Contour& contour : contours)
    for (const PlanePiece& piece : pieces_of(contour)) all.push_back(piece);
  const WindingIndex index(all, budget);
  std::vector<Contour> result;
  for (const Contour& contour : contours) {
    const std::vector<PlanePiece> pieces = pieces_of(contour);
    const auto& longest = *std::ranges::max_element(pieces, {}, &PlanePiece::length_of_chord);
    constexpr double share = 0x1p-30;
    const Vec2 middle = longest.middle();
    const Vec2 beside = middle - share * longest.length_of_chord() * longest.normal_at(middle);
    const bool is_left = is_inside(WindingRule::odd, index.winding_of(beside));
    result.push_back(is_left ? contour : reversed(contour));
  }
  return result;
}

}  // namespace

}  // namespace core

std::vector<Contour> offset_contours(std::span<const Contour> contours, double distance,
                                     const std::function<void(std::uint64_t)>& work) {
  constexpr double largest = 1e100;
  if (!(std::abs(distance) <= largest))
    throw Error(ErrorCode::invalid_argument,
                "distance must be finite and at most 1e100 in magnitude", "distance");
  make_profile(contours);  // checks them
  core::Budget budget(work);
  std::vector<Contour> result = core::turned_to_the_region(
      core::fill_contours(contours, core::WindingRule::odd, work), budget);
  if (distance == 0) return result;
  for (Contour& contour : result) contour = core::moved_by(core::contour_steps(contour), distance);
  std::erase_if(result, [&](const Contour& contour) {
    return core::is_point(contour, distance) || !core::encloses_area(contour);
  });
  result = core::fill_contours(result, core::WindingRule::positive, work);
  result = core::turned_to_the_region(result, budget);
  budget.report();
  return result;
}

}  // namespace crt
