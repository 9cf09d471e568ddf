// Offsets and hulls of regions.
#include <algorithm>
#include <cmath>
#include <crt/elementary.hpp>
#include <crt/error.hpp>
#include <numbers>

#include "import/arc.hpp"
#include "import/region.hpp"

namespace crt::importing {

namespace {

constexpr std::size_t most_discs = 20000;

struct Direction {
  double x = 0;
  double y = 0;
};

Direction turned(const Direction& d, double angle) {
  const double c = elementary::cos(angle), s = elementary::sin(angle);
  return {c * d.x - s * d.y, s * d.x + c * d.y};
}

/// A Piece is one side of a contour, with the directions in which it begins and ends.
struct Piece {
  ProfilePoint from{};
  ProfilePoint to{};
  Direction begins{};
  Direction ends{};
};

std::vector<Piece> pieces_of(const Contour& contour) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    Piece piece{.from = contour[i == 0 ? contour.size() - 1 : i - 1], .to = contour[i]};
    const double dx = piece.to.x - piece.from.x, dy = piece.to.y - piece.from.y;
    const double length = elementary::hypot(dx, dy);
    if (length == 0) continue;
    const double half = 2 * elementary::atan(piece.to.bulge);
    piece.begins = turned({dx / length, dy / length}, -half);
    piece.ends = turned({dx / length, dy / length}, half);
    pieces.push_back(piece);
  }
  return pieces;
}

/// Returns the point at a distance to the right of a direction.
ProfilePoint beside(const ProfilePoint& p, const Direction& d, double distance, double bulge = 0) {
  return {p.x + d.y * distance, p.y - d.x * distance, bulge};
}

ProfilePoint straight(ProfilePoint p) {
  p.bulge = 0;
  return p;
}

/// Makes what lies between a piece and where it is moved to. Returns nothing if it is an arc that
/// would become less than a point.
std::optional<Contour> strip_of(const Piece& piece, double distance) {
  const double bulge = piece.to.bulge;
  if (bulge < 0 && arc_between(piece.from, piece.to).radius <= distance) return {};
  ProfilePoint back = piece.from;
  back.bulge = -bulge;
  return Contour{back, beside(piece.from, piece.begins, distance),
                 beside(piece.to, piece.ends, distance, bulge), straight(piece.to)};
}

/// A Corner is a place where the contour turns to the left.
struct Corner {
  ProfilePoint at{};
  Direction before{};
  Direction after{};
  double angle = 0;
};

void add_round(Contour& contour, const Corner& corner, double distance, int fragments) {
  if (fragments == 0) {
    contour.push_back(beside(corner.at, corner.after, distance, elementary::tan(corner.angle / 4)));
    return;
  }
  // OpenSCAD has Clipper go in steps of a full circle's, and the last one is the rest.
  const double step = 2 * std::numbers::pi / fragments;
  const int steps = std::max(1, static_cast<int>(std::round(corner.angle / step)));
  for (int i = 1; i < steps; ++i)
    contour.push_back(beside(corner.at, turned(corner.before, i * step), distance));
  contour.push_back(beside(corner.at, corner.after, distance));
}

Contour wedge_of(const Corner& corner, double distance, OffsetCorner kind, int fragments) {
  Contour contour{straight(corner.at), beside(corner.at, corner.before, distance)};
  if (kind == OffsetCorner::round) {
    add_round(contour, corner, distance, fragments);
    return contour;
  }
  const double reach =
      distance * elementary::tan(corner.angle / (kind == OffsetCorner::miter ? 2 : 4));
  const auto along = [&](const Direction& d, double by) {
    ProfilePoint p = beside(corner.at, d, distance);
    p.x += d.x * by;
    p.y += d.y * by;
    return p;
  };
  contour.push_back(along(corner.before, reach));
  if (kind == OffsetCorner::chamfer) contour.push_back(along(corner.after, -reach));
  contour.push_back(beside(corner.at, corner.after, distance));
  return contour;
}

/// Adds what lies within a distance to the right of a contour. Returns whether it could.
bool add_band(std::vector<Region>& bands, const Contour& contour, double distance,
              OffsetCorner kind, int fragments) {
  const std::vector<Piece> pieces = pieces_of(contour);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::optional<Contour> strip = strip_of(pieces[i], distance);
    if (!strip) return false;
    bands.push_back({*strip});
    const Piece& next = pieces[(i + 1) % pieces.size()];
    const Direction& a = pieces[i].ends;
    const Direction& b = next.begins;
    const double angle = elementary::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
    if (angle < 1e-9) continue;
    const bool is_arc = pieces[i].to.bulge != 0 || next.to.bulge != 0;
    bands.push_back({wedge_of({pieces[i].to, a, b, angle}, distance,
                              is_arc && angle < 1e-3 ? OffsetCorner::miter : kind, fragments)});
  }
  return true;
}

/// A Disc is a circle of a hull, or a point.
struct Disc {
  double x = 0;
  double y = 0;
  double radius = 0;
};

void add_discs(std::vector<Disc>& discs, const Contour& contour) {
  const bool is_circle = contour.size() == 2 && contour[0].bulge == contour[1].bulge &&
                         std::abs(contour[0].bulge) == 1;
  if (is_circle) {
    const Arc arc = arc_between(contour[0], contour[1]);
    discs.push_back({arc.x, arc.y, arc.radius});
    return;
  }
  for (const ProfilePoint& corner : contour) {
    if (corner.bulge != 0)
      throw Error(ErrorCode::unsupported,
                  "the hull of arcs that are no whole circles is not known");
    discs.push_back({corner.x, corner.y, 0});
  }
}

/// Says whether one disc holds another.
bool holds(const Disc& a, const Disc& b) {
  return elementary::hypot(a.x - b.x, a.y - b.y) + b.radius <= a.radius;
}

std::vector<Disc> without_held(std::vector<Disc> discs) {
  if (discs.size() > most_discs) throw Error(ErrorCode::limit, "a hull has too many corners");
  std::sort(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) {
    return a.radius != b.radius ? a.radius > b.radius : a.x != b.x ? a.x < b.x : a.y < b.y;
  });
  std::vector<Disc> kept;
  for (const Disc& disc : discs) {
    if (std::none_of(kept.begin(), kept.end(), [&](const Disc& k) { return holds(k, disc); }))
      kept.push_back(disc);
  }
  return kept;
}

/// A Turn is the next disc around a hull, and the angle of the normal of the line to it.
struct Turn {
  std::size_t to = 0;
  double by = 0;
};

Turn next_turn(const std::vector<Disc>& discs, std::size_t at, double normal) {
  const double circle = 2 * std::numbers::pi;
  Turn best{at, circle};
  double best_way = 0;
  for (std::size_t j = 0; j < discs.size(); ++j) {
    if (j == at) continue;
    const double dx = discs[j].x - discs[at].x, dy = discs[j].y - discs[at].y;
    const double way = elementary::hypot(dx, dy);
    const double tilt =
        elementary::acos(std::clamp((discs[at].radius - discs[j].radius) / way, -1.0, 1.0));
    double by = elementary::atan2(dy, dx) - tilt - normal;
    by -= circle * std::floor(by / circle);
    if (by > circle - 1e-9) by = 0;
    if (by < best.by - 1e-12 || (by < best.by + 1e-12 && way > best_way)) {
      best = {j, by};
      best_way = way;
    }
  }
  return best;
}

}  // namespace

std::optional<Region> offset_region(const Region& region, double distance, OffsetCorner corner,
                                    int fragments) {
  if (distance == 0 || region.empty()) return region;
  std::vector<Region> bands;
  for (const Contour& contour : region) {
    if (!add_band(bands, distance < 0 ? reversed(contour) : contour, std::abs(distance), corner,
                  fragments))
      return {};
  }
  if (distance < 0) return subtracted(region, bands);
  bands.push_back(region);
  return united(bands);
}

Region hull_of(const std::vector<Region>& regions) {
  std::vector<Disc> discs;
  for (const Region& region : regions)
    for (const Contour& contour : region) add_discs(discs, contour);
  discs = without_held(std::move(discs));
  if (discs.empty()) return {};
  if (discs.size() == 1) {
    const Disc& only = discs.front();
    return only.radius > 0 ? Region{circle_contour(only.x, only.y, only.radius, 0)} : Region{};
  }
  const auto start = std::min_element(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) {
    const double low_a = a.y - a.radius, low_b = b.y - b.radius;
    return low_a != low_b ? low_a < low_b : a.x < b.x;
  });
  auto at = static_cast<std::size_t>(start - discs.begin());
  const double first = -std::numbers::pi / 2;
  double normal = first;
  double gone = 0;
  Contour contour;
  const auto add = [&](double angle, double bulge) {
    const Disc& disc = discs[at];
    contour.push_back({disc.x + disc.radius * elementary::cos(angle),
                       disc.y + disc.radius * elementary::sin(angle), bulge});
  };
  add(normal, 0);
  const double circle = 2 * std::numbers::pi;
  for (std::size_t step = 0; step < 2 * discs.size() + 2; ++step) {
    const Turn turn = next_turn(discs, at, normal);
    const double by = std::min(turn.by, circle - gone);
    if (discs[at].radius > 0 && by > 0) add(normal + by, elementary::tan(by / 4));
    normal += by;
    gone += by;
    if (gone >= circle - 1e-9) break;
    at = turn.to;
    add(normal, 0);
  }
  // The last corner is the first one.
  if (contour.size() > 1) {
    contour.front().bulge = contour.back().bulge;
    contour.pop_back();
  }
  return {contour};
}

}  // namespace crt::importing
