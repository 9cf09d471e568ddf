#include "core/section/boundary_edges.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/vector.hpp"
#include "core/section/face_root.hpp"
#include "core/tasks/parallel.hpp"

namespace crt::core {

namespace {

constexpr std::size_t edges_of_task = 16;

/// Returns whether a point is in the solid. What is on its surface is not.
bool is_in_solid(const BoundaryLooks& looks, const BoundaryCell& cell, const PlanePoint& point) {
  const Vec3 place = looks.grid().in_space(point);
  return looks.solid().look({{place, place}, cell.program}).kind == CellLook::Kind::full;
}

/// Finds what crosses an edge by halving it.
class EdgeSearch {
 public:
  EdgeSearch(const BoundaryLooks& looks, const BoundaryCell& cell, BoundaryEdge& edge)
      : looks_(looks), cell_(cell), edge_(edge) {}

  std::uint64_t run(bool from_inside, bool to_inside) {
    const BoundaryGrid& grid = looks_.grid();
    const PlanePoint from = grid.at(edge_.begin());
    across_ = edge_.along == 0 ? from.y : from.x;
    const PlanePoint to = grid.at(edge_.end());
    const End begin{edge_.along == 0 ? from.x : from.y, from_inside};
    const End end{edge_.along == 0 ? to.x : to.y, to_inside};
    tiny_ = edge_.is_precise ? 2 * grid.rounding() : infinity;
    if (begin.place < end.place) search(begin, end);
    return looks_taken_;
  }

 private:
  /// An edge along a face that lies in it would be halved for ever.
  static constexpr std::size_t most_looks = 1U << 11;

  struct End {
    double place = 0;
    bool is_inside = false;
  };
  PlanePoint at(double place) const {
    return edge_.along == 0 ? PlanePoint{place, across_} : PlanePoint{across_, place};
  }

  void search(const End& from, const End& to) {
    const double middle = 0.5 * from.place + 0.5 * to.place;
    const bool is_tiny = !(middle > from.place && middle < to.place) ||
                         to.place - from.place <= tiny_ || looks_taken_ >= most_looks;
    const std::size_t axis = looks_.grid().axis(edge_.along);
    if (!is_tiny) {
      const CellLook look =
          looks_.solid().look({looks_.grid().box(at(from.place), at(to.place)), cell_.program});
      ++looks_taken_;
      const bool is_one = look.kind == CellLook::Kind::crossed && look.faces.size() == 1 &&
                          is_steep(look.faces[0], axis);
      if (is_one && from.is_inside != to.is_inside) return add_root(from, to, look.faces[0]);
      if (!look.is_open() && from.is_inside != to.is_inside)
        return add((look.kind == CellLook::Kind::full) == from.is_inside ? to.place : from.place,
                   to.is_inside, no_surface);
      if (is_one || !look.is_open()) return;
      const End between{middle, is_in_solid(looks_, cell_, at(middle))};
      ++looks_taken_;
      search(from, between);
      search(between, to);
      return;
    }
    if (from.is_inside != to.is_inside) add(middle, to.is_inside, no_surface);
  }
  void add_root(const End& from, const End& to, const CellFace& face) {
    const FaceOnLine line{looks_.solid(), looks_.grid(), face, edge_.along, across_};
    add(line.root(from.place, to.place), to.is_inside, face.surface);
  }
  void add(double place, bool enters, std::uint64_t surface) {
    edge_.crossings.push_back({.place = place, .enters = enters, .surface = surface});
  }

  const BoundaryLooks& looks_;
  const BoundaryCell& cell_;
  BoundaryEdge& edge_;
  double across_ = 0;
  double tiny_ = 0;  ///< parts so small are not looked into
  std::uint64_t looks_taken_ = 0;
};

GridPoint swapped(const GridPoint& p) {
  return {p[1], p[0]};
}

}  // namespace

void BoundaryEdges::find_vertices(std::span<const BoundaryCell> cells, const Workers& workers) {
  std::vector<Vertex> vertices;
  vertices.reserve(4 * cells.size());
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const GridPoint& low = cells[i].lower;
    const GridPoint& high = cells[i].upper;
    for (const GridPoint& point :
         {low, GridPoint{high[0], low[1]}, high, GridPoint{low[0], high[1]}})
      vertices.push_back({.point = point, .cell = i});
  }
  const auto less = [](const Vertex& a, const Vertex& b) {
    return a.point != b.point ? a.point < b.point : a.cell < b.cell;
  };
  std::sort(vertices.begin(), vertices.end(), less);
  const auto same = [](const Vertex& a, const Vertex& b) { return a.point == b.point; };
  vertices.erase(std::unique(vertices.begin(), vertices.end(), same), vertices.end());
  for_ranges(vertices.size(), edges_of_task, workers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Vertex& vertex = vertices[i];
      const auto known =
          std::lower_bound(vertices_.begin(), vertices_.end(), vertex.point,
                           [](const Vertex& a, const GridPoint& point) { return a.point < point; });
      if (known != vertices_.end() && known->point == vertex.point) {
        vertex.is_inside = known->is_inside;
      } else {
        vertex.is_inside = is_in_solid(looks_, cells[vertex.cell], looks_.grid().at(vertex.point));
      }
    }
  });
  looks_taken_ += vertices.size() - std::min(vertices.size(), vertices_.size());
  vertices_ = std::move(vertices);
  by_lines_.clear();
  by_lines_.reserve(vertices_.size());
  for (const Vertex& vertex : vertices_) by_lines_.push_back(swapped(vertex.point));
  std::sort(by_lines_.begin(), by_lines_.end());
}

bool BoundaryEdges::is_inside(const GridPoint& point) const {
  const auto found =
      std::lower_bound(vertices_.begin(), vertices_.end(), point,
                       [](const Vertex& a, const GridPoint& p) { return a.point < p; });
  return found != vertices_.end() && found->point == point && found->is_inside;
}

void BoundaryEdges::list_edges(std::span<const BoundaryCell> cells) {
  edges_.clear();
  const auto add_side = [&](std::uint32_t cell, std::size_t along, std::int64_t line,
                            std::int64_t from, std::int64_t to) {
    // Points are sought among those of the same line, in either order of coordinates.
    const auto each = [&](auto place_of, auto next) {
      std::int64_t begin = from;
      for (; begin < to; ++next) {
        const std::int64_t place = place_of(*next);
        if (place <= begin) continue;
        edges_.push_back({.along = along,
                          .line = line,
                          .from = begin,
                          .to = place,
                          .cell = cell,
                          .is_precise = cells[cell].is_simple});
        begin = place;
      }
    };
    if (along == 1) {
      each([](const Vertex& v) { return v.point[1]; },
           std::lower_bound(vertices_.begin(), vertices_.end(), GridPoint{line, from},
                            [](const Vertex& a, const GridPoint& p) { return a.point < p; }));
    } else {
      each([](const GridPoint& p) { return p[1]; },
           std::lower_bound(by_lines_.begin(), by_lines_.end(), GridPoint{line, from}));
    }
  };
  for (std::uint32_t i = 0; i < cells.size(); ++i) {
    const BoundaryCell& cell = cells[i];
    for (std::size_t along = 0; along < 2; ++along) {
      for (const std::int64_t line : {cell.lower[1 - along], cell.upper[1 - along]})
        add_side(i, along, line, cell.lower[along], cell.upper[along]);
    }
  }
  std::stable_sort(edges_.begin(), edges_.end());
  std::size_t kept = 0;
  for (std::size_t i = 1; i < edges_.size(); ++i) {
    if (edges_[kept] < edges_[i]) {
      edges_[++kept] = edges_[i];
    } else {
      edges_[kept].is_precise = edges_[kept].is_precise || edges_[i].is_precise;
    }
  }
  if (!edges_.empty()) edges_.resize(kept + 1);
}

void BoundaryEdges::find(std::span<const BoundaryCell> cells, const Workers& workers) {
  find_vertices(cells, workers);
  std::vector<BoundaryEdge> known = std::move(edges_);
  list_edges(cells);
  std::vector<std::uint64_t> looks(edges_.size());
  for_ranges(edges_.size(), edges_of_task, workers, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      BoundaryEdge& edge = edges_[i];
      const auto earlier = std::lower_bound(known.begin(), known.end(), edge);
      const bool is_known = earlier != known.end() && !(edge < *earlier) &&
                            earlier->to == edge.to && (earlier->is_precise || !edge.is_precise);
      if (is_known) {
        edge.is_precise = earlier->is_precise;
        edge.crossings = std::move(earlier->crossings);
      } else {
        looks[i] = EdgeSearch(looks_, cells[edge.cell], edge)
                       .run(is_inside(edge.begin()), is_inside(edge.end()));
      }
    }
  });
  crossing_count_ = 0;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    edges_[i].first = crossing_count_;
    crossing_count_ += static_cast<std::uint32_t>(edges_[i].crossings.size());
    looks_taken_ += looks[i];
  }
}

void BoundaryEdges::add_side(const BoundaryCell& cell, std::size_t along, std::int64_t line,
                             bool backwards, std::vector<BorderCrossing>& list) const {
  const auto begin = static_cast<std::ptrdiff_t>(list.size());
  const BoundaryEdge key{.along = along, .line = line, .from = cell.lower[along]};
  const double across = looks_.grid().at(1 - along, line);
  for (auto edge = std::lower_bound(edges_.begin(), edges_.end(), key);
       edge != edges_.end() && edge->along == along && edge->line == line &&
       edge->from < cell.upper[along];
       ++edge) {
    for (std::uint32_t i = 0; i < edge->crossings.size(); ++i) {
      const EdgeCrossing& crossing = edge->crossings[i];
      list.push_back({.number = edge->first + i,
                      .point = along == 0 ? PlanePoint{crossing.place, across}
                                          : PlanePoint{across, crossing.place},
                      .enters = crossing.enters != backwards,
                      .surface = crossing.surface});
    }
  }
  if (backwards) std::reverse(list.begin() + begin, list.end());
}

std::vector<BorderCrossing> BoundaryEdges::around(const BoundaryCell& cell) const {
  std::vector<BorderCrossing> list;
  add_side(cell, 0, cell.lower[1], false, list);
  add_side(cell, 1, cell.upper[0], false, list);
  add_side(cell, 0, cell.upper[1], true, list);
  add_side(cell, 1, cell.lower[0], true, list);
  return list;
}

std::uint64_t BoundaryEdges::take_looks() {
  return std::exchange(looks_taken_, 0);
}

}  // namespace crt::core
