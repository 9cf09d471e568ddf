#include "core/tessellate/surface_place.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace crt::core {

namespace {

/// Returns the shortest step to the tangent planes of all faces, or to those of them that are
/// surely not parallel to others before.
Vec3 step_to(std::span<const FacePull> pulls) {
  // Gram and Schmidt's method, with the normal that is least along those before taken next.
  struct Row {
    Vec3 rest;
    double wanted;
    bool taken;
  };
  std::vector<Row> rows;
  rows.reserve(pulls.size());
  for (const FacePull& pull : pulls) rows.push_back({pull.normal, -pull.distance, false});
  Vec3 step(0, 0, 0);
  for (int rank = 0; rank < 3; ++rank) {
    Row* best = nullptr;
    for (Row& row : rows) {
      if (row.taken) continue;
      constexpr double clearly = 1 + 1e-9;
      if (best == nullptr || glm::length(row.rest) > clearly * glm::length(best->rest)) best = &row;
    }
    constexpr double parallel = 0.02;
    if (best == nullptr || !(glm::length(best->rest) > parallel)) break;
    best->taken = true;
    const double length = glm::length(best->rest);
    const Vec3 unit = best->rest / length;
    const double along = best->wanted / length;
    step += along * unit;
    for (Row& row : rows) {
      if (row.taken) continue;
      const double share = glm::dot(row.rest, unit);
      row.rest -= share * unit;
      row.wanted -= share * along;
    }
  }
  return step;
}

}  // namespace

bool SurfacePlaces::is_inside(const Vec3& place) const {
  if (!node_.look.is_open()) return node_.look.kind == CellLook::Kind::full;
  if (!knows_faces())
    return solid_.look({{place, place}, node_.look.program}).kind == CellLook::Kind::full;
  std::uint32_t negative = 0;
  for (std::size_t i = 0; i < node_.look.faces.size(); ++i) {
    if (solid_.value(node_.look.faces[i], known_point(place)).middle() < 0) negative |= 1U << i;
  }
  return node_.look.is_inside(negative);
}

Vec3 SurfacePlaces::between(Vec3 inside, Vec3 outside) const {
  constexpr int halvings = 52;
  for (int i = 0; i < halvings; ++i) {
    const Vec3 middle = 0.5 * inside + 0.5 * outside;
    if (middle == inside || middle == outside) break;
    (is_inside(middle) ? inside : outside) = middle;
  }
  return 0.5 * inside + 0.5 * outside;
}

std::vector<FacePull> SurfacePlaces::pulls_at(const Vec3& place) const {
  std::vector<FacePull> pulls;
  if (!knows_faces()) return pulls;
  pulls.reserve(node_.look.faces.size());
  for (std::size_t i = 0; i < node_.look.faces.size(); ++i) {
    const Jet jet = solid_.value(node_.look.faces[i], jets_of(known_point(place)));
    const Vec3 slope = middle_of(jet.slope);
    const double length = glm::length(slope);
    if (!(length > 0 && length < infinity)) return {};
    const double sign = sign_of_face(node_.look, i) < 0 ? -1 : 1;
    pulls.push_back({i, slope * (sign / length), sign * jet.value.middle() / length});
  }
  return pulls;
}

const FacePull* SurfacePlaces::nearest(std::span<const FacePull> pulls, double& distance) const {
  std::uint32_t negative = 0;
  std::array<const FacePull*, CellLook::max_faces> order{};
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    order[i] = &pulls[i];
    const bool grows = sign_of_face(node_.look, i) >= 0;
    if ((pulls[i].distance < 0) == grows) negative |= 1U << i;
  }
  std::sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(pulls.size()),
            [](const FacePull* a, const FacePull* b) {
              return std::abs(a->distance) < std::abs(b->distance);
            });
  const bool here = node_.look.is_inside(negative);
  // Within a distance any of the faces may be passed that are as near.
  std::uint32_t passed = 0;
  for (std::size_t i = 0; i < pulls.size(); ++i) {
    const std::uint32_t bit = 1U << order[i]->face;
    for (std::uint32_t some = passed;; some = (some - 1) & passed) {
      if (node_.look.faces[order[i]->face].is_surface &&
          node_.look.is_inside(negative ^ bit ^ some) != here) {
        distance = std::abs(order[i]->distance);
        return order[i];
      }
      if (some == 0) break;
    }
    passed |= bit;
  }
  distance = infinity;
  return nullptr;
}

bool SurfacePlaces::meet(std::span<const std::size_t> faces, int side, Vec3& place) const {
  const CellFrame frame(node_.box);
  const double size = largest_component(frame.half);
  Vec3 there = place;
  constexpr int steps = 16;
  constexpr double enough = 0x1p-46;
  double before = infinity;
  for (int i = 0; i < steps; ++i) {
    std::vector<FacePull> pulls = pulls_at(there);
    if (pulls.empty()) return false;
    std::vector<FacePull> wanted;
    wanted.reserve(faces.size() + 1);
    for (const std::size_t face : faces) wanted.push_back(pulls[face]);
    // Of faces that are parallel here that one counts which is surface.
    double distance = infinity;
    const FacePull* const surface = nearest(pulls, distance);
    for (FacePull& pull : wanted)
      if (surface != nullptr && pull.face == surface->face) std::swap(pull, wanted.front());
    if (side != invalid_side) {
      const int axis = side / 2;
      Vec3 across(0, 0, 0);
      across[axis] = 1;
      const Vec3& corner = side % 2 == 0 ? node_.box.lower : node_.box.upper;
      wanted.push_back({0, across, there[axis] - corner[axis]});
    }
    const Vec3 step = step_to(wanted);
    const double length = glm::length(step);
    if (!(length < 4 * glm::length(frame.half))) return false;
    there += step;
    if (length <= enough * size || (i > 3 && length >= before)) break;
    before = length;
  }
  // An edge that passes just beside a cell may be all that joins the faces in it.
  const double margin = side == invalid_side && faces.size() > 1 ? 0.5 : 1e-9;
  for (int axis = 0; axis < 3; ++axis)
    if (std::abs(there[axis] - frame.middle[axis]) > (1 + margin) * frame.half[axis]) return false;
  const std::vector<FacePull> pulls = pulls_at(there);
  double off = infinity;
  if (pulls.empty() || nearest(pulls, off) == nullptr) return false;
  constexpr double rounding = 1e-11;
  if (!(off <= rounding * (size + largest_component(frame.middle)))) return false;
  place = there;
  return true;
}

bool SurfacePlaces::meet_on_the_way(std::span<const std::size_t> faces, Vec3& place) const {
  Vec3 sum(0, 0, 0);
  Vec3 last(0, 0, 0);
  double count = 0;
  for (int side = 0; side < invalid_side; ++side) {
    Vec3 on_side = place;
    if (!meet(faces, side, on_side)) continue;
    last = on_side;
    sum += on_side;
    ++count;
  }
  if (count == 0) return false;
  place = sum / count;
  if (!meet(faces, place)) place = last;
  return true;
}

}  // namespace crt::core
