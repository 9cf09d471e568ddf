#include "core/tessellate/cell_partition.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/measure/cell_reach.hpp"
#include "core/measure/entity_cells.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

constexpr std::size_t most_nodes = std::size_t{1} << 20;
constexpr std::size_t nodes_of_task = 32;

/// Returns the least that a face's function grows along a direction.
double least_growth(const std::array<Interval, 3>& slopes, const Vec3& direction, double sign) {
  Interval sum{0, 0};
  for (int axis = 0; axis < 3; ++axis)
    sum = sum + slopes[static_cast<std::size_t>(axis)] * Interval::of(direction[axis] * sign);
  return sum.lo;
}

}  // namespace

int sign_of_face(const CellLook& look, std::size_t face) {
  const std::uint32_t bit = 1U << face;
  const std::uint32_t count = 1U << look.faces.size();
  bool leaves = false;
  bool enters = false;
  for (std::uint32_t m = 0; m < count; ++m) {
    if ((m & bit) == 0) continue;
    const bool below = look.is_inside(m);
    const bool above = look.is_inside(m & ~bit);
    leaves = leaves || (below && !above);
    enters = enters || (!below && above);
  }
  return leaves == enters ? 0 : (leaves ? 1 : -1);
}

Vec3 common_direction(std::span<const Vec3> normals) {
  Vec3 sum(0, 0, 0);
  for (const Vec3& normal : normals) sum += normal;
  if (normals.size() == 1) return sum;
  constexpr int steps = 24;
  for (int step = 0; step < steps; ++step) {
    const Vec3* worst = normals.data();
    for (const Vec3& normal : normals)
      if (glm::dot(normal, sum) < glm::dot(*worst, sum)) worst = &normal;
    sum += *worst * (glm::length(sum) / (2.0 + step));
    if (!(glm::dot(sum, sum) > 0)) sum = *worst;
  }
  return glm::normalize(sum);
}

std::optional<Vec3> outward_direction(const CellLook& look) {
  std::array<Vec3, CellLook::max_faces> normals;
  std::array<double, CellLook::max_faces> signs{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    if (!look.faces[i].is_surface) continue;
    signs[i] = sign_of_face(look, i);
    const Vec3 slope = middle_of(look.faces[i].slopes);
    const double length = glm::length(slope);
    if (signs[i] == 0 || !(length > 0 && length < infinity)) return {};
    normals[count++] = slope * (signs[i] / length);
  }
  if (count == 0) return {};
  const Vec3 direction = common_direction(std::span(normals).first(count));
  for (std::size_t i = 0; i < look.faces.size(); ++i) {
    if (look.faces[i].is_surface && !(least_growth(look.faces[i].slopes, direction, signs[i]) > 0))
      return {};
  }
  return direction;
}

int dividing_axis(const CellSolid& solid, const Bounds& box, const CellLook& look,
                  bool takes_faces_apart, double least) {
  const CellFrame frame(box);
  int longest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (frame.half[axis] > frame.half[longest]) longest = axis;
  if (look.kind != CellLook::Kind::crossed) return longest;
  // This is how much the faces' slopes turn along each axis, and that for how long the axis is.
  double most_turned = 0;
  Vec3 turn(0, 0, 0);
  Vec3 reach(0, 0, 0);
  for (const CellFace& face : look.faces) {
    if (!face.is_surface) continue;
    const Vec3 slope = middle_of(face.slopes);
    const double length = glm::length(slope);
    if (!(length > 0)) return longest;
    for (int axis = 0; axis < 3; ++axis) {
      reach[axis] = std::max(reach[axis], std::abs(slope[axis]) / length * frame.half[axis]);
      std::array<Vec3, 2> at_ends;
      for (std::size_t end = 0; end < 2; ++end) {
        Vec3 place = frame.middle;
        place[axis] = end == 0 ? box.lower[axis] : box.upper[axis];
        at_ends[end] = middle_of(solid.value(face, jets_of(known_point(place))).slope);
      }
      const double turned = glm::length(at_ends[1] - at_ends[0]) / length;
      most_turned = std::max(most_turned, turned);
      turn[axis] = std::max(turn[axis], turned * frame.half[axis]);
    }
  }
  const auto largest = [&](const Vec3& v) {
    int most = longest;
    for (int axis = 0; axis < 3; ++axis)
      if (2 * frame.half[axis] > least && v[axis] > v[most]) most = axis;
    return most;
  };
  constexpr double far = 1;
  if (takes_faces_apart && most_turned < far) return largest(reach);
  constexpr double flat = 0x1p-30;
  return most_turned > flat ? largest(turn) : longest;
}

CellPartition::CellPartition(const CellSolid& solid, double deviation, MeasureClock& clock)
    : solid_(solid), deviation_(deviation), clock_(clock) {
  add(solid.cell(first_box(solid.bounds())));
}

void CellPartition::add(const Cell& cell) {
  waiting_.push_back(node_count());
  nodes_.emplace_back().box = cell.box;
  nodes_.back().look.program = cell.program;
}

void CellPartition::look_at(std::uint32_t number) {
  PartitionNode& node = nodes_[number];
  const std::shared_ptr<const OpenProgram> program = node.look.program;
  node.look = solid_.look({node.box, program});
  if (node.look.program == nullptr) node.look.program = program;
}

bool CellPartition::is_smaller(std::uint32_t number, double share_of_deviation) const {
  const Bounds& box = nodes_[number].box;
  return glm::length(box.upper - box.lower) <= share_of_deviation * deviation_;
}

bool CellPartition::is_simple(const PartitionNode& node) const {
  if (!node.look.is_open()) return true;
  if (node.look.kind != CellLook::Kind::crossed) return false;
  if (!outward_direction(node.look)) return false;
  constexpr double share = 2;
  return std::ranges::all_of(node.look.faces, [&](const CellFace& face) {
    return !face.is_surface ||
           face.error <= share * deviation_ * glm::length(middle_of(face.slopes));
  });
}

bool CellPartition::divide(std::uint32_t number, Aim aim) {
  constexpr double smallest = 0.05;
  const bool is_small_enough =
      aim == Aim::covered ? is_smaller(number, smallest) : is_small(number);
  if (!nodes_[number].is_leaf() || !nodes_[number].look.is_open() || is_small_enough) return false;
  const Bounds box = nodes_[number].box;
  constexpr double share_of_deviation = 0.2;
  constexpr double share_of_longest = 0.125;
  double least = (aim == Aim::covered ? share_of_gap : share_of_deviation) * deviation_;
  if (aim == Aim::apart || aim == Aim::near)
    least = std::max(least, share_of_longest * largest_component(box.upper - box.lower));
  const CellLook& look = nodes_[number].look;
  const bool takes_apart = aim == Aim::apart || (aim != Aim::near && !outward_direction(look));
  const int axis = dividing_axis(solid_, box, look, takes_apart, least);
  const double place = 0.5 * box.lower[axis] + 0.5 * box.upper[axis];
  if (!(place > box.lower[axis] && place < box.upper[axis])) return false;
  const std::shared_ptr<const OpenProgram> program = nodes_[number].look.program;
  PartitionNode& whole = nodes_[number];
  whole.axis = axis;
  whole.place = place;
  whole.lower_half = node_count();
  for (int half = 0; half < 2; ++half) {
    Bounds part = box;
    (half == 0 ? part.upper : part.lower)[axis] = place;
    add({part, program});
  }
  return true;
}

bool CellPartition::refine() {
  // All that wait are looked at, and then divided, so that the order does not depend on threads.
  std::vector<std::uint32_t> round = std::move(waiting_);
  waiting_.clear();
  while (!round.empty()) {
    if (nodes_.size() > most_nodes || clock_.is_over()) return false;
    std::vector<char> is_plain(round.size());
    for_ranges(round.size(), nodes_of_task, clock_.workers(),
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   look_at(round[i]);
                   is_plain[i] = is_simple(nodes_[round[i]]);
                 }
               });
    std::uint64_t looks = 0;
    for (const std::uint32_t number : round) looks += nodes_[number].look.program->leaves.size();
    clock_.count(looks);
    for (std::size_t i = 0; i < round.size(); ++i)
      if (is_plain[i] == 0) divide(round[i], Aim::simple);
    round = std::move(waiting_);
    waiting_.clear();
  }
  return true;
}

std::shared_ptr<const OpenProgram> CellPartition::program_in(const Bounds& box) const {
  const PartitionNode* node = nodes_.data();
  const auto holds = [&](const Bounds& outer) {
    for (int axis = 0; axis < 3; ++axis)
      if (box.lower[axis] < outer.lower[axis] || box.upper[axis] > outer.upper[axis]) return false;
    return true;
  };
  if (!holds(node->box)) return solid_.cell(box).program;
  while (!node->is_leaf()) {
    const PartitionNode* const half = &nodes_[node->lower_half];
    if (!holds(half[0].box) && !holds(half[1].box)) break;
    node = holds(half[0].box) ? half : half + 1;
  }
  return node->look.program;
}

// ---- edges ------------------------------------------------------------------------------------

/// An EdgeWalk goes through cells, the faces between them, and the edges between these. Source: Ju,
/// Losasso, Schaefer, Warren, Dual contouring of Hermite data, 2002 (for octrees).
class CellPartition::EdgeWalk {
 public:
  EdgeWalk(const CellPartition& partition, const std::function<void(const GridEdge&)>& visit)
      : nodes_(partition.nodes_), visit_(visit) {}

  void in_cell(std::uint32_t number) {
    const PartitionNode& node = nodes_[number];
    if (node.is_leaf()) return;
    in_cell(node.lower_half);
    in_cell(node.lower_half + 1);
    between(node.lower_half, node.lower_half + 1, node.axis, node.place, node.box);
  }

 private:
  /// Returns the half of a node on one side of a place that is in the node, or at its end.
  std::uint32_t half_at(const PartitionNode& node, double place, bool above) const {
    const bool upper = above ? node.place <= place : node.place < place;
    return node.lower_half + (upper ? 1 : 0);
  }

  /// Visits the edges in a face between nodes, which is that of a box across an axis.
  void between(std::uint32_t below, std::uint32_t above, int axis, double place,
               const Bounds& box) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    while (!nodes_[below].is_leaf() || !nodes_[above].is_leaf()) {
      const bool takes_below = !nodes_[below].is_leaf();
      const PartitionNode& node = nodes_[takes_below ? below : above];
      std::uint32_t& side = takes_below ? below : above;
      if (node.axis == axis) {
        side = half_at(node, place, !takes_below);
        continue;
      }
      if (!(node.place > box.lower[node.axis])) {
        side = node.lower_half + 1;
        continue;
      }
      if (!(node.place < box.upper[node.axis])) {
        side = node.lower_half;
        continue;
      }
      Bounds lower = box;
      Bounds upper = box;
      lower.upper[node.axis] = node.place;
      upper.lower[node.axis] = node.place;
      Vec3 from = box.lower;
      from[axis] = place;
      from[node.axis] = node.place;
      if (node.axis == u)
        around(v, from, box.upper[v], {below, above, above, below});
      else
        around(u, from, box.upper[u], {below, below, above, above});
      between(below, above, axis, place, lower);
      between(below, above, axis, place, upper);
      return;
    }
  }

  /// Visits the parts of an edge between four nodes.
  void around(int axis, Vec3 from, double to, std::array<std::uint32_t, 4> cells) {
    const int a = (axis + 1) % 3;
    const int b = (axis + 2) % 3;
    for (std::size_t i = 0; i < 4; ++i) {
      while (!nodes_[cells[i]].is_leaf()) {
        const PartitionNode& node = nodes_[cells[i]];
        if (node.axis == a) {
          cells[i] = half_at(node, from[a], i == 1 || i == 2);
        } else if (node.axis == b) {
          cells[i] = half_at(node, from[b], i >= 2);
        } else if (node.place <= from[axis]) {
          cells[i] = node.lower_half + 1;
        } else if (node.place >= to) {
          cells[i] = node.lower_half;
        } else {
          around(axis, from, node.place, cells);
          from[axis] = node.place;
        }
      }
    }
    const bool is_open =
        std::ranges::any_of(cells, [&](std::uint32_t cell) { return nodes_[cell].look.is_open(); });
    if (is_open) visit_({.axis = axis, .from = from, .to = to, .cells = cells});
  }

  const std::vector<PartitionNode>& nodes_;
  const std::function<void(const GridEdge&)>& visit_;
};

void CellPartition::for_each_edge(const std::function<void(const GridEdge&)>& visit) const {
  EdgeWalk(*this, visit).in_cell(0);
}

}  // namespace crt::core
