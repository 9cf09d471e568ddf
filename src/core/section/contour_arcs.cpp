#include "core/section/contour_arcs.hpp"

#include "core/section/circle_fit.hpp"
#include "crt/elementary.hpp"

namespace crt::core {

double ContourPiece::chord() const {
  return distance_between(from, to);
}

PlanePoint ContourPiece::center() const {
  // It is on the left of the chord for a bulge from 0 to 1.
  const double share = (1 - bulge * bulge) / (4 * bulge);
  return {0.5 * from.x + 0.5 * to.x - share * (to.y - from.y),
          0.5 * from.y + 0.5 * to.y + share * (to.x - from.x)};
}

double ContourPiece::angle() const {
  return 4 * elementary::atan(bulge);
}

PlanePoint ContourPiece::at(double share) const {
  if (share <= 0) return from;
  if (share >= 1) return to;
  if (!is_arc()) return {from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
  const PlanePoint middle = center();
  const double turn = share * angle();
  const double sine = elementary::sin(turn);
  const double cosine = elementary::cos(turn);
  const double x = from.x - middle.x;
  const double y = from.y - middle.y;
  return {middle.x + x * cosine - y * sine, middle.y + x * sine + y * cosine};
}

ContourPiece piece_of(const Contour& contour, std::size_t i) {
  const ProfilePoint& from = contour[i];
  const ProfilePoint& to = contour[(i + 1) % contour.size()];
  return {{from.x, from.y}, {to.x, to.y}, to.bulge};
}

double enclosed_area(const Contour& contour) {
  double sum = 0;
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPiece piece = piece_of(contour, i);
    const double x = piece.from.x - contour[0].x;
    const double y = piece.from.y - contour[0].y;
    sum += 0.5 * (x * (piece.to.y - contour[0].y) - y * (piece.to.x - contour[0].x));
    if (!piece.is_arc()) continue;
    const double angle = piece.angle();
    const double radius = piece.radius();
    sum += 0.5 * radius * radius * (angle - elementary::sin(angle));
  }
  return sum;
}

void include_contour(const Contour& contour, Bounds& bounds) {
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ContourPiece piece = piece_of(contour, i);
    bounds.include({piece.from.x, piece.from.y, 0});
    if (!piece.is_arc()) continue;
    const PlanePoint center = piece.center();
    const double radius = piece.radius();
    const double sign = piece.bulge > 0 ? 1 : -1;
    for (const PlanePoint& way :
         {PlanePoint{1, 0}, PlanePoint{0, 1}, PlanePoint{-1, 0}, PlanePoint{0, -1}}) {
      // Beyond the chord, as seen from within, is the arc.
      const PlanePoint end{center.x + radius * way.x, center.y + radius * way.y};
      const double side = (piece.to.x - piece.from.x) * (end.y - piece.from.y) -
                          (piece.to.y - piece.from.y) * (end.x - piece.from.x);
      if (side * sign <= 0) bounds.include({end.x, end.y, 0});
    }
  }
}

}  // namespace crt::core
