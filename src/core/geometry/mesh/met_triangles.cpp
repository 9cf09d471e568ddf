#include "core/geometry/mesh/met_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/geometry/open_nodes.hpp"
#include "core/math/vector.hpp"

namespace crt::core {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// MetTriangles makes one list of crossings.
class MetTriangles {
 public:
  MetTriangles(const MeshTriangles& mesh, PassingLine& line, const MeshTier& tier,
               CrossingList& list)
      : mesh_(mesh), line_(line), ray_(line.near()), tier_(tier), list_(list) {}

  bool append();

 private:
  using Place = CrossingList::iterator;

  Place first() const { return list_.begin() + static_cast<std::ptrdiff_t>(begin_); }
  bool starts_on(std::uint32_t triangle) const {
    return ray_.start.face != no_face &&
           mesh_.plane_of(triangle).first == mesh_.plane_of(ray_.start.face).first;
  }
  void find();
  void meet(std::uint32_t triangle);
  void keep_in_triangle(const Triangle& triangle, Crossing& crossing) const;
  double start_slack() const;
  /// Returns the size of all coordinates, which their roundings are relative to.
  double place_size() const { return largest_component(ray_.origin) + mesh_.bounds().farthest(); }
  int order(const Crossing& a, const Crossing& b) const;
  void sort();
  void drop_empty_parts();
  void agree_with_start();
  bool is_through_origin(const Crossing& crossing) const;
  Place put_behind(Place met) const;
  void take_turns();

  const MeshTriangles& mesh_;
  PassingLine& line_;
  const ObjectRay& ray_;
  const MeshTier& tier_;
  CrossingList& list_;
  std::size_t begin_ = 0;
};

bool MetTriangles::append() {
  begin_ = list_.size();
  find();
  sort();
  if (!mesh_.is_closed()) return false;
  if (ray_.start.face != no_face) agree_with_start();
  drop_empty_parts();
  take_turns();
  return (list_.size() - begin_) % 2 != 0;
}

/// Returns how far before its begin a ray that starts on a triangle may meet others that rounding
/// has put there.
double MetTriangles::start_slack() const {
  if (ray_.start.face == no_face) return 0;
  constexpr double share = 0x1p-30;
  return share * place_size() / largest_component(ray_.direction);
}

void MetTriangles::find() {
  const RaySlabs slabs(ray_.origin, ray_.direction, line_.origin_error());
  LineSpan part{ray_.begin - start_slack(), infinity};
  const bool first_is_enough = !mesh_.is_closed() && ray_.first_above < infinity;
  for_leaves(mesh_.tree(), slabs, part, [&](std::span<const std::uint32_t> triangles) {
    for (const std::uint32_t triangle : triangles) meet(triangle);
    if (first_is_enough && list_.size() > begin_) {
      const Crossing& met = list_.back();
      if (ray_.is_first_asked(met)) part.leave = std::min(part.leave, met.t + met.error);
    }
  });
}

void MetTriangles::meet(std::uint32_t triangle) {
  const Triangle corners = mesh_.triangle(triangle);
  const int side = line_.crosses(corners.a, corners.b, corners.c);
  if (side == 0) return;
  Crossing crossing{.face = triangle, .entering = side < 0};
  if (starts_on(triangle)) {
    crossing.t = 0;
  } else if (tier_.meet(mesh_.plane_of(triangle).first, crossing)) {
    keep_in_triangle(corners, crossing);
  } else {
    const double ahead = glm::dot(corners.a - ray_.origin, ray_.direction);
    crossing.t = std::copysign(infinity, ahead);
  }
  list_.push_back(crossing);
}

/// A line that all but grazes a triangle still meets it between its corners, and nowhere else.
void MetTriangles::keep_in_triangle(const Triangle& triangle, Crossing& crossing) const {
  const double scale = inverse_of_power(power_of_two_below(largest_component(ray_.direction)));
  const Vec3 direction = scale * ray_.direction;
  const double squared_length = glm::dot(direction, direction);
  double low = infinity;
  double high = -infinity;
  double reach = 0;
  for (const Vec3* corner : {&triangle.a, &triangle.b, &triangle.c}) {
    const Vec3 offset = *corner - ray_.origin;
    const double t = glm::dot(offset, direction) / squared_length * scale;
    low = std::min(low, t);
    high = std::max(high, t);
    reach = std::max(reach, largest_component(offset));
  }
  constexpr double roundings = 16;
  const double slack = roundings * unit_roundoff * reach * scale;
  if (!(crossing.error > high - low + slack)) return;
  crossing.t = std::clamp(crossing.t, low, high);
  crossing.t_low = 0;
  crossing.error = high - low + slack;
}

int MetTriangles::order(const Crossing& a, const Crossing& b) const {
  const auto compared = [](double x, double y) { return x < y ? -1 : (x > y ? 1 : 0); };
  if (!std::isfinite(a.t) || !std::isfinite(b.t)) return compared(a.t, b.t);
  const double distance = (a.t - b.t) + (a.t_low - b.t_low);
  const bool is_start = starts_on(a.face) || starts_on(b.face);
  if (!is_start && std::abs(distance) <= a.error + b.error) return tier_.order(a, b);
  return compared(distance, 0);
}

void MetTriangles::sort() {
  std::sort(first(), list_.end(), [this](const Crossing& a, const Crossing& b) {
    const int by_place = order(a, b);
    return by_place != 0 ? by_place < 0 : a.face < b.face;
  });
}

/// Drops what the line is in or out of for no length. Of several crossings in one place one is
/// left if they are odd in number: it is against their normals, or along these, as most are.
void MetTriangles::drop_empty_parts() {
  auto kept = first();
  for (auto group = first(); group != list_.end();) {
    auto end = group;
    std::ptrdiff_t entering = 0;
    bool is_start = false;
    for (; end != list_.end() && order(*group, *end) == 0; ++end) {
      entering += end->entering ? 1 : -1;
      is_start = is_start || starts_on(end->face);
    }
    if ((end - group) % 2 != 0 || is_start) {
      const auto chosen = std::find_if(group, end, [&](const Crossing& crossing) {
        return is_start ? starts_on(crossing.face) : crossing.entering == (entering > 0);
      });
      *kept++ = *chosen;
    }
    group = end;
  }
  list_.erase(kept, list_.end());
}

/// Returns whether the origin is in a triangle's plane but for what rounding may have moved it by.
bool MetTriangles::is_through_origin(const Crossing& crossing) const {
  const Triangle corners = mesh_.triangle(crossing.face);
  const Vec3 normal = unit_vector(glm::cross(corners.b - corners.a, corners.c - corners.a));
  constexpr double roundings = 64;
  const double tolerance = roundings * unit_roundoff * place_size();
  return std::abs(glm::dot(normal, corners.a - ray_.origin)) <= tolerance;
}

/// Makes the list agree with the side to which the ray leaves. Next to an edge rounding may have
/// put its origin beyond another triangle of that edge, which it then meets too often or too
/// rarely. From an edge itself it may leave past all triangles, without being inside: then it does
/// not meet its own either.
void MetTriangles::agree_with_start() {
  const RayStart& start = ray_.start;
  const auto is_start = [&](const Crossing& crossing) { return starts_on(crossing.face); };
  auto found = std::find_if(first(), list_.end(), is_start);
  if (found == list_.end()) {
    if (!start.on_face) return;
    found = std::find_if(first(), list_.end(), [](const Crossing& met) { return met.t >= 0; });
    found =
        list_.insert(found, {.t = 0, .face = start.face, .entering = start.side == Side::inside});
  }
  const bool is_turned = mesh_.plane_of(found->face).turned != mesh_.plane_of(start.face).turned;
  const bool goes_inside = (start.side == Side::inside) != is_turned;
  const auto ahead = std::count_if(first(), list_.end(), [&](const Crossing& crossing) {
    return crossing.t > 0 && !is_start(crossing);
  });
  if ((ahead % 2 != 0) == goes_inside) return;
  auto nearest = list_.end();
  for (auto met = first(); met != list_.end(); ++met) {
    if (is_start(*met) || !is_through_origin(*met)) continue;
    if (nearest == list_.end() || std::abs(met->t) < std::abs(nearest->t)) nearest = met;
  }
  if (nearest == list_.end()) {
    list_.erase(std::remove_if(first(), list_.end(), is_start), list_.end());
    return;
  }
  Crossing moved = *nearest;
  const bool was_ahead = moved.t > 0;
  list_.erase(nearest);
  if (was_ahead) return;
  const Vec3 size = mesh_.bounds().upper - mesh_.bounds().lower;
  moved.t = unit_roundoff * largest_component(size) / largest_component(ray_.direction);
  moved.t_low = 0;
  moved.error = moved.t;
  list_.push_back(moved);
  sort();
}

/// Returns the crossing that rounding may have put behind another one, whose turn it is not. There
/// is none where triangles plainly come in this order, as they pass through one another, and where
/// normals say nothing.
MetTriangles::Place MetTriangles::put_behind(Place met) const {
  if (!mesh_.is_oriented() || starts_on(met->face)) return list_.end();
  for (auto later = met + 1; later != list_.end(); ++later) {
    if (later->t - later->error > met->t + met->error) break;
    if (later->entering != met->entering) return starts_on(later->face) ? list_.end() : later;
  }
  return list_.end();
}

/// Makes the line enter and leave by turns. Where triangles nearly coincide, rounding may have put
/// the end of a part before its begin. Such a part is left out, as is one of no length.
void MetTriangles::take_turns() {
  bool inside = (list_.size() - begin_) % 2 != 0;
  for (auto met = first(); met != list_.end();) {
    if (met->entering == inside) {
      const auto later = put_behind(met);
      if (later != list_.end()) {
        list_.erase(later);
        met = list_.erase(met);
        continue;
      }
      met->entering = !inside;
    }
    inside = !inside;
    ++met;
  }
}

}  // namespace

bool append_crossings(const MeshTriangles& mesh, PassingLine& line, const MeshTier& tier,
                      CrossingList& out) {
  return MetTriangles(mesh, line, tier, out).append();
}

}  // namespace crt::core
