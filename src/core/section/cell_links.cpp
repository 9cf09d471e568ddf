#include "core/section/cell_links.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/face_functions.hpp"

namespace crt::core {

namespace {

/// Finds the place where the functions of two faces are 0, by Newton's iteration.
class CornerSearch {
 public:
  CornerSearch(const BoundaryLooks& looks, const BoundaryCell& cell)
      : looks_(looks), lower_(looks.grid().at(cell.lower)), upper_(looks.grid().at(cell.upper)) {}

  std::optional<PlanePoint> find(const CellFace& first, const CellFace& second) const {
    PlanePoint p{0.5 * lower_.x + 0.5 * upper_.x, 0.5 * lower_.y + 0.5 * upper_.y};
    const double width = upper_.x - lower_.x;
    const double height = upper_.y - lower_.y;
    constexpr int most_steps = 40;
    for (int i = 0; i < most_steps; ++i) {
      const Linear f = linear(first, p);
      const Linear g = linear(second, p);
      const double turn = f.x * g.y - f.y * g.x;
      const double dx = (g.value * f.y - f.value * g.y) / turn;
      const double dy = (f.value * g.x - g.value * f.x) / turn;
      if (!(std::isfinite(dx) && std::isfinite(dy))) return {};
      const PlanePoint next = clamped({p.x + dx, p.y + dy}, 0.5);
      const double step = std::abs(next.x - p.x) / width + std::abs(next.y - p.y) / height;
      p = next;
      if (step < 0x1p-48) break;
    }
    const double off = looks_.grid().rounding();
    const double tolerance = 0x1p-30;
    if (p.x < lower_.x - tolerance * width - off || p.x > upper_.x + tolerance * width + off ||
        p.y < lower_.y - tolerance * height - off || p.y > upper_.y + tolerance * height + off)
      return {};
    return clamped(p, 0);
  }

 private:
  struct Linear {
    double value;
    double x;
    double y;
  };
  Linear linear(const CellFace& face, const PlanePoint& p) const {
    const Jet jet = looks_.solid().value(face, jets_of(known_point(looks_.grid().in_space(p))));
    const auto middle = [](const Interval& i) { return 0.5 * i.lo + 0.5 * i.hi; };
    return {middle(jet.value), middle(jet.slope[looks_.grid().axis(0)]),
            middle(jet.slope[looks_.grid().axis(1)])};
  }
  /// Keeps a place in the cell, with a margin as a share of its size.
  PlanePoint clamped(const PlanePoint& p, double margin) const {
    const double width = margin * (upper_.x - lower_.x);
    const double height = margin * (upper_.y - lower_.y);
    return {std::clamp(p.x, lower_.x - width, upper_.x + width),
            std::clamp(p.y, lower_.y - height, upper_.y + height)};
  }

  const BoundaryLooks& looks_;
  PlanePoint lower_;
  PlanePoint upper_;
};

/// Makes a link of two crossings, of which one leaves the solid along the border, and the other
/// enters it.
std::optional<CellLink> link_of(const BorderCrossing& a, const BorderCrossing& b,
                                std::size_t face_of_a, std::size_t face_of_b) {
  if (a.enters == b.enters) return {};
  CellLink link{.from = a.number,
                .to = b.number,
                .begin = a.point,
                .end = b.point,
                .first_face = face_of_a,
                .last_face = face_of_b};
  if (a.enters) {
    std::swap(link.from, link.to);
    std::swap(link.begin, link.end);
    std::swap(link.first_face, link.last_face);
  }
  return link;
}

/// Links the crossings of a face, which is a graph over an axis. Along that it enters the cell and
/// leaves it by turns.
bool link_graph(const BoundaryLooks& looks, const CellFace& face, std::size_t number,
                std::vector<BorderCrossing>& crossings, std::vector<CellLink>& links) {
  if (crossings.size() % 2 != 0) return false;
  const bool is_over_first = is_steep(face, looks.grid().axis(1));
  std::stable_sort(crossings.begin(), crossings.end(),
                   [&](const BorderCrossing& a, const BorderCrossing& b) {
                     return is_over_first ? a.point.x < b.point.x : a.point.y < b.point.y;
                   });
  for (std::size_t k = 0; k < crossings.size(); k += 2) {
    const std::optional<CellLink> link = link_of(crossings[k], crossings[k + 1], number, number);
    if (!link) return false;
    links.push_back(*link);
  }
  return true;
}

}  // namespace

std::optional<std::vector<CellLink>> links_of(const BoundaryLooks& looks, const BoundaryCell& cell,
                                              std::span<const BorderCrossing> border) {
  const std::vector<CellFace>& faces = cell.look.faces;
  std::vector<std::vector<BorderCrossing>> of_face(faces.size());
  for (const BorderCrossing& crossing : border) {
    auto face = std::ranges::find(faces, crossing.surface, &CellFace::surface);
    if (face == faces.end()) {
      // What could not be distinguished on an edge is of the only face.
      if (faces.size() != 1) return {};
      face = faces.begin();
    }
    of_face[static_cast<std::size_t>(face - faces.begin())].push_back(crossing);
  }
  std::vector<CellLink> links;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::vector<BorderCrossing>& crossings = of_face[i];
    if (i == cell.first && !crossings.empty() && !of_face[cell.second].empty()) {
      const std::vector<BorderCrossing>& others = of_face[cell.second];
      if (crossings.size() != 1 || others.size() != 1) return {};
      std::optional<CellLink> link = link_of(crossings[0], others[0], i, cell.second);
      if (!link) return {};
      const auto corner = CornerSearch(looks, cell).find(faces[i], faces[cell.second]);
      if (!corner) return {};
      link->corner = *corner;
      links.push_back(*link);
      of_face[cell.second].clear();
      continue;
    }
    if (!link_graph(looks, faces[i], i, crossings, links)) return {};
  }
  return links;
}

std::vector<CellLink> straight_links(std::span<const BorderCrossing> border) {
  // Each stretch of the border that is in the solid is cut off by a line.
  std::vector<CellLink> links;
  for (std::size_t i = 0; i < border.size(); ++i) {
    if (!border[i].enters) continue;
    const BorderCrossing& next = border[(i + 1) % border.size()];
    if (next.enters) continue;
    links.push_back(
        {.from = next.number, .to = border[i].number, .begin = next.point, .end = border[i].point});
  }
  return links;
}

}  // namespace crt::core
