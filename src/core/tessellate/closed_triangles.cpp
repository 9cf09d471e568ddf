#include "core/tessellate/closed_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <tuple>

#include "core/geometry/mesh/connected.hpp"

#include "crt/elementary.hpp"

namespace crt::core {

namespace {

/// A SideOfTriangle is one of its three edges, from corner `side` to the next.
struct SideOfTriangle {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  std::uint32_t side = 0;
  bool goes_up = false;  ///< from low to high
  double angle = 0;      ///< about the edge

  std::uint32_t place() const { return 3 * triangle + side; }
};

class Closing {
 public:
  Closing(std::vector<DualVertex>& vertices, std::vector<std::array<std::uint32_t, 3>>& triangles)
      : vertices_(vertices), triangles_(triangles), fans_(3 * triangles.size()) {}

  void run(std::vector<std::uint32_t>& tangled) {
    for_each_edge([&](std::span<SideOfTriangle> sides) { pair_up(sides); });
    give_corners();
    for_each_edge([&](std::span<SideOfTriangle> sides) {
      if (sides.size() == 2) return;
      tangled.push_back(vertices_[sides[0].low].cell);
      tangled.push_back(vertices_[sides[0].high].cell);
    });
    constexpr int most_rounds = 64;
    for (int round = 0; round < most_rounds && split_shared_edges(); ++round) {
    }
  }

 private:
  template <class Visit>
  void for_each_edge(const Visit& visit) {
    std::vector<SideOfTriangle> sides;
    sides.reserve(3 * triangles_.size());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t from = triangles_[t][side];
        const std::uint32_t to = triangles_[t][(side + 1) % 3];
        sides.push_back({std::min(from, to), std::max(from, to), t, side, from < to});
      }
    }
    const auto key = [](const SideOfTriangle& side) {
      return std::tuple(side.low, side.high, side.place());
    };
    std::sort(sides.begin(), sides.end(),
              [&](const SideOfTriangle& a, const SideOfTriangle& b) { return key(a) < key(b); });
    for (std::size_t begin = 0; begin < sides.size();) {
      std::size_t end = begin;
      while (end < sides.size() && sides[end].low == sides[begin].low &&
             sides[end].high == sides[begin].high)
        ++end;
      visit(std::span(sides).subspan(begin, end - begin));
      begin = end;
    }
  }

  /// Joins the triangles at an edge in pairs, with the solid between.
  void pair_up(std::span<SideOfTriangle> sides) {
    if (sides.size() > 2) sort_by_angle(sides);
    // Counter-clockwise about the edge upwards, the solid begins behind a triangle that goes down.
    std::vector<const SideOfTriangle*> open;
    for (std::size_t i = 0; i < 2 * sides.size(); ++i) {
      const SideOfTriangle& side = sides[i % sides.size()];
      if (!side.goes_up) {
        if (i < sides.size()) open.push_back(&side);
      } else if (!open.empty() && !is_taken(side)) {
        join(side, *open.back());
        open.pop_back();
      }
    }
  }
  bool is_taken(const SideOfTriangle& side) const { return taken_[side.place()] != 0; }
  void join(const SideOfTriangle& up, const SideOfTriangle& down) {
    taken_[up.place()] = 1;
    const auto next = [](const SideOfTriangle& side) {
      return 3 * side.triangle + (side.side + 1) % 3;
    };
    fans_.connect(up.place(), next(down));
    fans_.connect(next(up), down.place());
  }
  void sort_by_angle(std::span<SideOfTriangle> sides) const {
    const Vec3 from = vertices_[sides[0].low].place;
    const Vec3 axis = vertices_[sides[0].high].place - from;
    const Vec3 x = glm::cross(axis, std::abs(axis.x) <= std::min(std::abs(axis.y), std::abs(axis.z))
                                        ? Vec3(1, 0, 0)
                                    : std::abs(axis.y) <= std::abs(axis.z) ? Vec3(0, 1, 0)
                                                                           : Vec3(0, 0, 1));
    const Vec3 y = glm::cross(axis, x);
    const double length = glm::length(axis);
    for (SideOfTriangle& side : sides) {
      const Vec3 apex = vertices_[triangles_[side.triangle][(side.side + 2) % 3]].place - from;
      side.angle = elementary::atan2(glm::dot(apex, y), glm::dot(apex, x) * length);
    }
    std::sort(sides.begin(), sides.end(), [](const SideOfTriangle& a, const SideOfTriangle& b) {
      return std::tuple(a.angle, a.place()) < std::tuple(b.angle, b.place());
    });
  }

  /// Splits edges that several pairs of triangles share, where each pair has a corner of its own
  /// then. Returns false if there are none. A triangle is split at one side at a time.
  bool split_shared_edges() {
    bool found = false;
    std::vector<char> is_split(triangles_.size(), 0);
    std::vector<std::pair<SideOfTriangle, SideOfTriangle>> pairs;
    for_each_edge([&](std::span<SideOfTriangle> sides) {
      found = found || sides.size() > 2;
      for (std::size_t i = 0; sides.size() > 2 && i < sides.size(); ++i) {
        const SideOfTriangle& up = sides[i];
        if (!up.goes_up || is_split[up.triangle] != 0) continue;
        const auto down = std::ranges::find_if(sides, [&](const SideOfTriangle& side) {
          return !side.goes_up && is_split[side.triangle] == 0;
        });
        if (down == sides.end()) continue;
        is_split[up.triangle] = is_split[down->triangle] = 1;
        pairs.emplace_back(up, *down);
      }
    });
    for (const auto& [up, down] : pairs) {
      const auto middle = static_cast<std::uint32_t>(vertices_.size());
      DualVertex vertex = vertices_[up.low];
      vertex.place = 0.5 * vertex.place + 0.5 * vertices_[up.high].place;
      vertices_.push_back(vertex);
      for (const SideOfTriangle& side : {up, down}) {
        std::array<std::uint32_t, 3> rest = triangles_[side.triangle];
        triangles_[side.triangle][(side.side + 1) % 3] = middle;
        rest[side.side] = middle;
        triangles_.push_back(rest);
      }
    }
    return found;
  }

  void give_corners() {
    std::vector<std::uint32_t> number_of(3 * triangles_.size(), invalid_index);
    std::vector<char> used(vertices_.size(), 0);
    for (std::uint32_t place = 0; place < number_of.size(); ++place) {
      std::uint32_t& corner = triangles_[place / 3][place % 3];
      std::uint32_t& number = number_of[fans_.lowest(place)];
      if (number == invalid_index) {
        number = corner;
        if (used[corner] != 0) {
          number = static_cast<std::uint32_t>(vertices_.size());
          vertices_.push_back(vertices_[corner]);
          used.push_back(0);
        }
        used[number] = 1;
      }
      corner = number;
    }
  }

  std::vector<DualVertex>& vertices_;
  std::vector<std::array<std::uint32_t, 3>>& triangles_;
  Connected fans_;  ///< corners of triangles that are one
  std::vector<char> taken_ = std::vector<char>(3 * triangles_.size(), 0);
};

/// Takes away pairs of triangles that have the same corners the other way round.
void drop_films(std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> open;
  std::vector<char> is_gone(triangles.size(), 0);
  const auto from_least = [](std::array<std::uint32_t, 3> triangle) {
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                triangle.end());
    return triangle;
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::array<std::uint32_t, 3> here = from_least(triangles[t]);
    const auto back = open.find({here[0], here[2], here[1]});
    if (back == open.end() || back->second.empty()) {
      open[here].push_back(t);
      continue;
    }
    is_gone[t] = is_gone[back->second.back()] = 1;
    back->second.pop_back();
  }
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (is_gone[t] == 0) triangles[kept++] = triangles[t];
  triangles.resize(kept);
}

void drop_unused(std::vector<DualVertex>& vertices,
                 std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::vector<std::uint32_t> numbers(vertices.size(), invalid_index);
  for (const auto& triangle : triangles)
    for (const std::uint32_t corner : triangle) numbers[corner] = 0;
  std::uint32_t count = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (numbers[v] == invalid_index) continue;
    vertices[count] = vertices[v];
    numbers[v] = count++;
  }
  vertices.resize(count);
  for (auto& triangle : triangles)
    for (std::uint32_t& corner : triangle) corner = numbers[corner];
}

}  // namespace

void close(std::vector<DualVertex>& vertices, std::vector<std::array<std::uint32_t, 3>>& triangles,
           std::vector<std::uint32_t>& tangled) {
  drop_films(triangles);
  Closing(vertices, triangles).run(tangled);
  drop_unused(vertices, triangles);
}

}  // namespace crt::core
