#include "core/contours/arrangement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/contours/biarcs.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

Arrangement::Arrangement(std::span<const Contour* const> contours, WindingRule rule, Budget& budget)
    : contours_(contours), rule_(rule), budget_(budget) {
  Vec2 lower(infinity, infinity);
  Vec2 upper = -lower;
  for (const Contour* contour : contours) {
    for (const ProfilePoint& corner : *contour) {
      lower = min(lower, {corner.x, corner.y});
      upper = max(upper, {corner.x, corner.y});
    }
  }
  const auto larger = [](const Vec2& v) { return std::max(std::abs(v.x), std::abs(v.y)); };
  origin_ = lower;
  unit_ = power_of_two_below(larger(upper - lower));
  const double magnitude = std::max(larger(lower), larger(upper)) / unit_;
  constexpr double share_of_size = 0x1p-38;
  constexpr double share_of_magnitude = 0x1p-50;
  tolerance_ = std::max(share_of_size, share_of_magnitude * magnitude);
  least_rise_ = least_share_of_rise * magnitude;
  for (std::uint32_t i = 0; i < contours.size(); ++i) {
    first_.push_back(static_cast<std::uint32_t>(pieces_.size()));
    const Contour& contour = *contours[i];
    for (std::size_t k = 0; k < contour.size(); ++k) {
      const ProfilePoint& from = contour[k];
      const ProfilePoint& to = contour[(k + 1) % contour.size()];
      const auto moved = [&](const ProfilePoint& p) {
        return Vec2((p.x - origin_.x) / unit_, (p.y - origin_.y) / unit_);
      };
      pieces_.emplace_back(moved(from), moved(to), to.bulge);
      begins_.push_back(from);
      contour_.push_back(i);
    }
  }
  first_.push_back(static_cast<std::uint32_t>(pieces_.size()));
  corners_.assign(pieces_.size(), none);
  find_meetings();
}

std::uint32_t Arrangement::next(std::uint32_t piece) const {
  const std::uint32_t contour = contour_[piece];
  return piece + 1 < first_[contour + 1] ? piece + 1 : first_[contour];
}

void Arrangement::find_meetings() {
  std::vector<std::uint32_t> order(pieces_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto left = [this](std::uint32_t piece) { return pieces_[piece].lower().x; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(left(a), a) < std::pair(left(b), b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const PlanePiece& a = pieces_[order[i]];
    std::size_t k = i + 1;
    for (; k < order.size() && left(order[k]) <= a.upper().x + tolerance_; ++k) {
      const PlanePiece& b = pieces_[order[k]];
      if (a.lower().y <= b.upper().y + tolerance_ && b.lower().y <= a.upper().y + tolerance_) {
        meet(order[i], order[k]);
      }
    }
    budget_.spend(k - i);
  }
  join_close_meetings();
}

void Arrangement::meet(std::uint32_t a, std::uint32_t b) {
  constexpr std::size_t steps_of_pair = 256;
  budget_.spend(steps_of_pair);
  // Pieces that follow one another meet at their corner, and near it if the corner is smooth.
  constexpr double near_corner = 0x1p-16;
  const double near =
      near_corner * std::min(pieces_[a].length_of_chord(), pieces_[b].length_of_chord());
  for (const Vec2& place : common_points(pieces_[a], pieces_[b], tolerance_)) {
    const bool is_corner = (next(a) == b && glm::length(place - pieces_[b].from()) <= near) ||
                           (next(b) == a && glm::length(place - pieces_[a].from()) <= near);
    if (!is_corner) add_meeting(place, a, b);
  }
}

void Arrangement::add_meeting(const Vec2& place, std::uint32_t a, std::uint32_t b) {
  const auto meeting = static_cast<std::uint32_t>(meetings_.size());
  meetings_.push_back({.place = place, .first = meeting});
  add_to(a, meeting);
  add_to(b, meeting);
}

void Arrangement::add_to(std::uint32_t piece, std::uint32_t meeting) {
  const Vec2& place = meetings_[meeting].place;
  const PlanePiece& at = pieces_[piece];
  if (glm::length(place - at.from()) <= tolerance_) return mark_corner(piece, meeting);
  if (glm::length(place - at.to()) <= tolerance_) return mark_corner(next(piece), meeting);
  cuts_.push_back({.piece = piece, .order = at.order_of(place), .meeting = meeting});
}

void Arrangement::mark_corner(std::uint32_t piece, std::uint32_t meeting) {
  meetings_[meeting].corner = piece;
  if (corners_[piece] == none) corners_[piece] = meeting;
  unite(corners_[piece], meeting);
}

std::uint32_t Arrangement::first_of(std::uint32_t meeting) {
  while (meetings_[meeting].first != meeting) {
    meetings_[meeting].first = meetings_[meetings_[meeting].first].first;
    meeting = meetings_[meeting].first;
  }
  return meeting;
}

void Arrangement::unite(std::uint32_t a, std::uint32_t b) {
  a = first_of(a);
  b = first_of(b);
  if (a == b) return;
  if (b < a) std::swap(a, b);
  meetings_[b].first = a;
  if (meetings_[a].corner == none) meetings_[a].corner = meetings_[b].corner;
}

void Arrangement::join_close_meetings() {
  std::vector<std::uint32_t> order(meetings_.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto x_of = [this](std::uint32_t meeting) { return meetings_[meeting].place.x; };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(x_of(a), a) < std::pair(x_of(b), b);
  });
  const double close = 2 * tolerance_;
  for (std::size_t i = 0; i < order.size(); ++i) {
    std::size_t k = i + 1;
    for (; k < order.size() && x_of(order[k]) <= x_of(order[i]) + close; ++k) {
      const Vec2 offset = meetings_[order[k]].place - meetings_[order[i]].place;
      if (glm::length(offset) <= close) unite(order[i], order[k]);
    }
    constexpr std::size_t steps_of_pair = 4;
    budget_.spend(steps_of_pair * (k - i));
  }
  for (std::uint32_t i = 0; i < meetings_.size(); ++i) meetings_[i].first = first_of(i);
  for (Meeting& meeting : meetings_) {
    const Meeting& first = meetings_[meeting.first];
    meeting.place = first.corner == none ? first.place : pieces_[first.corner].from();
  }
  for (std::uint32_t& corner : corners_) {
    if (corner != none) corner = meetings_[corner].first;
  }
  for (Cut& cut : cuts_) cut.meeting = meetings_[cut.meeting].first;
  std::sort(cuts_.begin(), cuts_.end(), [](const Cut& a, const Cut& b) {
    return std::tie(a.piece, a.order, a.meeting) < std::tie(b.piece, b.order, b.meeting);
  });
}

std::vector<Arrangement::Part> Arrangement::parts_of(std::size_t contour) const {
  std::vector<Part> parts;
  auto cut = std::lower_bound(cuts_.begin(), cuts_.end(), first_[contour],
                              [](const Cut& a, std::uint32_t piece) { return a.piece < piece; });
  for (std::uint32_t piece = first_[contour]; piece < first_[contour + 1]; ++piece) {
    const PlanePiece& whole = pieces_[piece];
    std::uint32_t begin = corners_[piece];
    Vec2 from = whole.from();
    const auto add = [&](std::uint32_t end, const Vec2& to) {
      constexpr double negligible = 8;  // tolerances
      const bool is_nothing =
          begin != none && begin == end && glm::length(to - from) <= negligible * tolerance_;
      if (!is_nothing) {
        const bool is_whole = from == whole.from() && to == whole.to();
        parts.push_back({.from = from,
                         .to = to,
                         .bulge = is_whole ? whole.bulge() : whole.bulge_between(from, to),
                         .begin = begin,
                         .end = end,
                         .piece = piece});
      }
      begin = end;
      from = to;
    };
    for (; cut != cuts_.end() && cut->piece == piece; ++cut) {
      add(cut->meeting, meetings_[cut->meeting].place);
    }
    add(corners_[next(piece)], whole.to());
  }
  return parts;
}

}  // namespace crt::core
