#include "core/geometry/mesh/shells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "core/geometry/mesh/met_triangles.hpp"
#include "core/geometry/triangle/triangle.hpp"
#include "core/math/vector.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

Vec3 middle_of(const Triangle& triangle) {
  return triangle.a / 3.0 + triangle.b / 3.0 + triangle.c / 3.0;
}

/// Returns where an edge passes through a triangle, but for rounding.
std::optional<Vec3> passage(const Vec3& from, const Vec3& to, const Triangle& triangle) {
  const Vec3 normal = unit_vector(rounded(precise_normal_of(triangle)));
  const double before = glm::dot(normal, from - triangle.a);
  const double after = glm::dot(normal, to - triangle.a);
  if (before * after > 0 || before == after) return std::nullopt;
  const Vec3 place = from + before / (before - after) * (to - from);
  const std::array<Vec3, 3> corners = {triangle.a, triangle.b, triangle.c};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& corner = corners[i];
    if (glm::dot(glm::cross(corners[(i + 1) % 3] - corner, place - corner), normal) < 0)
      return std::nullopt;
  }
  return place;
}

/// Returns a point in the middle of where two triangles pass through one another, or that of the
/// first.
Vec3 middle_of_meeting(const Triangle& one, const Triangle& other) {
  Vec3 sum(0.0);
  int count = 0;
  const auto add = [&](const Triangle& edges, const Triangle& triangle) {
    const std::array<Vec3, 3> corners = {edges.a, edges.b, edges.c};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto place = passage(corners[i], corners[(i + 1) % 3], triangle);
      if (!place) continue;
      sum += *place;
      ++count;
    }
  };
  add(one, other);
  add(other, one);
  return count == 0 ? middle_of(one) : sum / static_cast<double>(count);
}

/// Returns a place of a line that the mesh goes about more than once, the nearest to its origin.
std::optional<Vec3> place_of_overlap(const MeshTriangles& mesh, const ObjectRay& ray,
                                     CrossingList& crossings) {
  crossings.clear();
  all_met_triangles(mesh, ray, crossings);
  std::optional<double> nearest;
  int winding = 0;
  for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
    winding += crossings[i].entering ? 1 : -1;
    if (std::abs(winding) < 2 || highest(crossings[i]) >= lowest(crossings[i + 1])) continue;
    const double t = crossings[i].t / 2 + crossings[i + 1].t / 2;
    if (std::isfinite(t) && (!nearest || std::abs(t) < std::abs(*nearest))) nearest = t;
  }
  if (!nearest) return std::nullopt;
  return ray.origin + *nearest * ray.direction;
}

/// Returns a ray into what is behind both of two triangles, from where they meet.
ObjectRay ray_into(const Triangle& one, const Triangle& other) {
  const Vec3 normal = unit_vector(rounded(precise_normal_of(one)));
  const Vec3 sum = normal + unit_vector(rounded(precise_normal_of(other)));
  constexpr double least = 0x1p-10;  // or else they all but face each other
  return {.origin = middle_of_meeting(one, other),
          .direction = largest_component(sum) > least ? -sum : -normal};
}

/// Returns one more than the largest number of a shell.
std::uint32_t end_of(std::span<const std::uint32_t> shells) {
  return shells.empty() ? 0 : *std::max_element(shells.begin(), shells.end()) + 1;
}

std::string place_text(const Vec3& place) {
  return text::format("({:.6g}, {:.6g}, {:.6g})", place.x, place.y, place.z);
}

/// An OverlapCount marks shells that overlap others or themselves.
class OverlapCount {
 public:
  OverlapCount(std::span<const std::uint32_t> shells, MeshReport& report)
      : shells_(shells), marked_(end_of(shells)), report_(report) {}

  bool is_marked(std::uint32_t triangle) const { return marked_[shells_[triangle]]; }
  void mark(std::uint32_t triangle, const Vec3& place) {
    if (is_marked(triangle)) return;
    if (report_.overlapping_shells++ == 0) report_.first_overlap = place;
    marked_[shells_[triangle]] = true;
  }

 private:
  std::span<const std::uint32_t> shells_;
  std::vector<bool> marked_;
  MeshReport& report_;
};

}  // namespace

bool are_turned_outwards(const MeshTriangles& mesh, const Fronts& fronts,
                         std::span<const std::uint32_t> shells) {
  struct Shell {
    std::optional<Vec3> origin;
    double volume = 0;
    std::optional<int> front;
  };
  std::vector<Shell> all(end_of(shells));
  const double extent =
      power_of_two_below(largest_component(mesh.bounds().upper - mesh.bounds().lower));
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const Triangle triangle = mesh.triangle(i);
    Shell& shell = all[shells[i]];
    if (!shell.origin) shell.origin = triangle.a;
    const auto offset = [&](const Vec3& corner) { return (corner - *shell.origin) / extent; };
    shell.volume +=
        glm::dot(offset(triangle.a), glm::cross(offset(triangle.b), offset(triangle.c)));
    if (!shell.front) shell.front = fronts[i];
  }
  return std::all_of(all.begin(), all.end(), [](const Shell& shell) {
    const bool is_cavity = shell.front && *shell.front >= 0;
    return shell.volume >= 0 || is_cavity;
  });
}

void find_overlaps(const MeshTriangles& mesh, const SelfMeetings& meetings, const Fronts& fronts,
                   std::span<const std::uint32_t> shells, MeshReport& report) {
  OverlapCount count(shells, report);
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const bool is_deep = fronts[i] && (*fronts[i] >= 1 || *fronts[i] <= -2);
    if (is_deep) count.mark(i, middle_of(mesh.triangle(i)));
  }
  CrossingList crossings;
  int left = 4096;
  std::size_t work = 0;
  constexpr std::size_t max_work = std::size_t{1} << 24;  // crossings, some seconds of them
  for (std::uint32_t i = 0; i < mesh.size() && left > 0 && work < max_work; ++i) {
    const std::optional<std::uint32_t> met = meetings.met_by(i);
    if (!met || (count.is_marked(i) && count.is_marked(*met))) continue;
    --left;
    const ObjectRay ray = ray_into(mesh.triangle(i), mesh.triangle(*met));
    const std::optional<Vec3> place = place_of_overlap(mesh, ray, crossings);
    work += crossings.size();
    if (!place) continue;
    count.mark(i, *place);
    count.mark(*met, *place);
  }
}

void add_mesh_warnings(const MeshTriangles& mesh, const MeshEdges& edges, MeshReport& report) {
  std::vector<bool> seen(end_of(edges.shells));
  for (const std::uint32_t shell : edges.shells) {
    report.shells += seen[shell] ? 0 : 1;
    seen[shell] = true;
  }
  report.repeated_triangles = edges.repeated.size();
  if (!edges.repeated.empty())
    report.first_repeated = middle_of(mesh.triangle(edges.repeated.front()));
  if (!mesh.is_closed()) return;
  const bool is_nonzero = report.fill == FillRule::nonzero;
  if (report.repeated_triangles > 0) {
    report.warnings.push_back(
        text::format("{} of its {} triangles repeat others, the first at {}: {}",
                     report.repeated_triangles, mesh.size(), place_text(report.first_repeated),
                     is_nonzero ? "by 'nonzero' they change nothing if they are turned the same way"
                                : "by 'evenodd' they enclose nothing together with those"));
  }
  if (report.overlapping_shells > 0) {
    report.warnings.push_back(
        text::format("{} of its {} shells lie in others or overlap, the first at {}: {}",
                     report.overlapping_shells, report.shells, place_text(report.first_overlap),
                     is_nonzero ? "by 'nonzero' they are one solid"
                                : "by 'evenodd' what two of them share is hollow"));
  }
}

}  // namespace crt::core
