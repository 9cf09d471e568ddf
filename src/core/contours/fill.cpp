#include "core/contours/fill.hpp"

#include <algorithm>
#include <numeric>

#include "core/contours/arrangement.hpp"
#include "core/math/dyadic_vector.hpp"

namespace crt::core {

namespace {

/// A Box holds a contour.
struct Box {
  Vec2 lower{0, 0};
  Vec2 upper{0, 0};
};

Box box_of(const Contour& contour) {
  const Vec2 corner(contour[0].x, contour[0].y);
  Box box{corner, corner};
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const ProfilePoint& from = contour[i];
    const ProfilePoint& to = contour[(i + 1) % contour.size()];
    const PlanePiece piece({from.x, from.y}, {to.x, to.y}, to.bulge);
    box.lower = min(box.lower, piece.lower());
    box.upper = max(box.upper, piece.upper());
  }
  // Contours that nearly touch are near each other, too.
  constexpr double share = 0x1p-30;
  const Vec2 margin = share * (box.upper - box.lower);
  return {box.lower - margin, box.upper + margin};
}

/// Returns the contours in groups, of which each is apart from all others.
std::vector<std::vector<const Contour*>> groups_of(std::span<const Contour> contours,
                                                   Budget& budget) {
  std::vector<Box> boxes;
  for (const Contour& contour : contours) boxes.push_back(box_of(contour));
  std::vector<std::size_t> order(contours.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<std::size_t> firsts = order;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(boxes[a].lower.x, a) < std::pair(boxes[b].lower.x, b);
  });
  const auto first_of = [&](std::size_t i) {
    while (firsts[i] != i) i = firsts[i] = firsts[firsts[i]];
    return i;
  };
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Box& a = boxes[order[i]];
    std::size_t k = i + 1;
    for (; k < order.size() && boxes[order[k]].lower.x <= a.upper.x; ++k) {
      const Box& b = boxes[order[k]];
      if (a.lower.y > b.upper.y || b.lower.y > a.upper.y) continue;
      const std::size_t one = first_of(order[i]);
      const std::size_t other = first_of(order[k]);
      firsts[std::max(one, other)] = std::min(one, other);
    }
    budget.spend(k - i);
  }
  std::vector<std::vector<const Contour*>> groups(contours.size());
  for (std::size_t i = 0; i < contours.size(); ++i) groups[first_of(i)].push_back(&contours[i]);
  std::erase_if(groups, [](const auto& group) { return group.empty(); });
  return groups;
}

}  // namespace

std::vector<Contour> fill_contours(std::span<const Contour> contours, WindingRule rule,
                                   const std::function<void(std::uint64_t)>& work) {
  Budget budget(work);
  // A last corner that repeats the first is the piece back to it.
  std::vector<Contour> open(contours.begin(), contours.end());
  for (Contour& contour : open) {
    if (contour.front().x != contour.back().x || contour.front().y != contour.back().y) continue;
    contour.front().bulge = contour.back().bulge;
    contour.pop_back();
  }
  std::vector<Contour> result;
  for (const std::vector<const Contour*>& group : groups_of(open, budget)) {
    Arrangement(group, rule, budget).append_boundary(result);
  }
  budget.report();
  return result;
}

bool encloses_area(const Contour& contour) {
  const auto place = [](const ProfilePoint& corner) {
    return exactly(Vec3(corner.x, corner.y, 0));
  };
  if (contour.empty()) return false;
  const DyadicVector first = place(contour[0]);
  const ProfilePoint* other = nullptr;
  for (const ProfilePoint& corner : contour) {
    const bool is_first = corner.x == contour[0].x && corner.y == contour[0].y;
    if (corner.bulge != 0 && contour.size() > 1) return true;
    if (is_first) continue;
    if (!other) other = &corner;
    const DyadicVector along = place(*other) - first;
    const DyadicVector offset = place(corner) - first;
    if ((along[0] * offset[1] - along[1] * offset[0]).sign() != 0) return true;
  }
  return false;
}

}  // namespace crt::core
