#include "core/tessellate/simplify.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <queue>
#include <tuple>

namespace crt::core {

namespace {

/// A FlatStar says whether the triangles around a corner that moves cover the same planes as
/// before. Then they are as near to the surface as those were.
///
/// In each plane both are the same chain of triangles, since both have the same boundary: corners
/// that are not in the plane's middle move along the straight edge between two planes.
class FlatStar {
 public:
  /// Both places are those of the corner that moves. Other corners may be so far from a plane.
  FlatStar(const Vec3& from, const Vec3& to, double slack) : from_(from), to_(to), slack_(slack) {}

  /// Adds a triangle that was moved, with its other two corners. Returns false if it is not in the
  /// plane of what was there before.
  bool add(const Vec3& a, const Vec3& b) {
    const Vec3 across = glm::cross(a - to_, b - to_);
    const double length = glm::length(across);
    if (!(length > 0)) return false;
    const Vec3 normal = across / length;
    std::size_t number = 0;
    while (number < count_ && !(is_in(number, a) && is_in(number, b))) ++number;
    if (number == normals_.size()) return false;
    if (number == count_) normals_[count_++] = normal;
    for (const Vec3& corner : {a, b})
      if (!take(corner, number)) return false;
    return is_in(number, from_);
  }

 private:
  bool is_in(std::size_t plane, const Vec3& place) const {
    return std::abs(glm::dot(normals_[plane], place - to_)) <= slack_;
  }
  /// Takes a corner of a plane. One of two planes is on the line along which the other one moves.
  bool take(const Vec3& corner, std::size_t plane) {
    const auto found = std::ranges::find(corners_, corner, &PlaneCorner::place);
    if (found == corners_.end()) {
      corners_.push_back({corner, plane});
      return true;
    }
    if (found->plane == plane) return true;
    const Vec3 along = corner - to_;
    return glm::length(glm::cross(along, from_ - to_)) <= slack_ * glm::length(along);
  }

  struct PlaneCorner {
    Vec3 place;
    std::size_t plane;
  };
  Vec3 from_;
  Vec3 to_;
  double slack_;
  std::array<Vec3, 2> normals_;
  std::size_t count_ = 0;
  std::vector<PlaneCorner> corners_;
};

class Simplification {
 public:
  Simplification(const DualMesh& mesh, const SurfaceProof& proof, const std::vector<char>& kept,
                 MeasureClock& clock)
      : vertices_(mesh.vertices),
        triangles_(mesh.triangles),
        proof_(proof),
        kept_(kept),
        clock_(clock),
        around_(mesh.vertices.size()),
        version_(mesh.vertices.size(), 0),
        unproved_(mesh.triangles.size(), 0),
        is_gone_(mesh.triangles.size(), 0) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t)
      for (const std::uint32_t vertex : triangles_[t]) around_[vertex].push_back(t);
  }

  DualMesh run() {
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) add(v);
    for (std::size_t step = 0; !moves_.empty(); ++step) {
      constexpr std::size_t steps_per_poll = 64;
      if (step % steps_per_poll == 0 && clock_.is_over()) break;
      const Move move = moves_.top();
      moves_.pop();
      if (version_[move.from] != move.version || around_[move.from].empty()) continue;
      double unproved = 0;
      if (can_move(move.from, move.to, unproved)) take(move.from, move.to, unproved);
    }
    return rest();
  }

 private:
  /// A Move takes a corner away.
  struct Move {
    double cost = 0;    ///< how far the corner it goes to is from the triangles around it
    double length = 0;  ///< how far that is
    std::uint32_t from = 0;
    std::uint32_t to = 0;
    std::uint32_t version = 0;

    friend bool operator<(const Move& a, const Move& b) {
      return std::tuple(a.cost, a.length, a.from, a.to) >
             std::tuple(b.cost, b.length, b.from, b.to);
    }
  };
  using Triangle = std::array<std::uint32_t, 3>;
  /// So much of what triangles may be farther away is used by one move.
  static constexpr double share_of_slack = 0x1p-12;

  static bool has(const Triangle& triangle, std::uint32_t vertex) {
    return triangle[0] == vertex || triangle[1] == vertex || triangle[2] == vertex;
  }
  Vec3 across(const Triangle& t) const {
    const Vec3& a = vertices_[t[0]].place;
    return glm::cross(vertices_[t[1]].place - a, vertices_[t[2]].place - a);
  }
  /// Returns the corners beside one, in order.
  std::vector<std::uint32_t> neighbours_of(std::uint32_t vertex) const {
    std::vector<std::uint32_t> result;
    result.reserve(2 * around_[vertex].size());
    for (const std::uint32_t t : around_[vertex])
      for (const std::uint32_t other : triangles_[t])
        if (other != vertex) result.push_back(other);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

  /// Lists the moves of a corner.
  void add(std::uint32_t from) {
    if (kept_[from] != 0 || around_[from].empty() || vertices_[from].sharpness > 2) return;
    for (const std::uint32_t to : neighbours_of(from)) {
      if (!keeps_sharp_edges(from, to)) continue;
      const Vec3 way = vertices_[to].place - vertices_[from].place;
      double cost = 0;
      for (const std::uint32_t t : around_[from]) {
        const Vec3 normal = across(triangles_[t]);
        if (is_narrow(triangles_[t], normal)) continue;
        cost = std::max(cost, std::abs(glm::dot(normal, way)) / glm::length(normal));
      }
      constexpr double hopeless = 4;
      if (cost > hopeless * proof_.deviation()) continue;
      // Of those that move nothing the short ones come first, which make no long fans.
      if (cost <= share_of_slack * proof_.slack()) cost = 0;
      moves_.push({cost, glm::length(way), from, to, version_[from]});
    }
  }
  bool keeps_sharp_edges(std::uint32_t from, std::uint32_t to) const {
    const DualVertex& vertex = vertices_[from];
    if (vertex.sharpness < 2) return true;
    if (vertices_[to].sharpness < 2) return false;
    constexpr double along = 0.9;
    const Vec3 way = vertices_[to].place - vertex.place;
    return std::abs(glm::dot(way, vertex.edge)) >= along * glm::length(way);
  }

  /// Returns whether a corner can go to another, and how much farther than is proved the triangles
  /// around may then be from the surface.
  bool can_move(std::uint32_t from, std::uint32_t to, double& unproved) const {
    const std::vector<std::uint32_t> beside_from = neighbours_of(from);
    const std::vector<std::uint32_t> beside_to = neighbours_of(to);
    std::vector<std::uint32_t> common;
    std::set_intersection(beside_from.begin(), beside_from.end(), beside_to.begin(),
                          beside_to.end(), std::back_inserter(common));
    // Long fans are slow, and hard to tell from one another near their tip.
    constexpr std::size_t most_around = 40;
    if (common.size() != 2 || beside_to.size() > most_around) return false;
    for (const std::uint32_t vertex : common)
      if (around_[vertex].size() <= 3) return false;
    const Vec3& place = vertices_[from].place;
    const double slack = share_of_slack * proof_.slack();
    FlatStar star(place, vertices_[to].place, slack);
    bool is_flat = true;
    std::vector<DualTriangle> moved;
    moved.reserve(around_[from].size());
    for (const std::uint32_t t : around_[from]) {
      Triangle triangle = triangles_[t];
      unproved = std::max(unproved, unproved_[t]);
      if (has(triangle, to)) continue;
      const Vec3 normal = across(triangle);
      const Vec3 before = is_narrow(triangle, normal) ? Vec3(0, 0, 0) : normal;
      std::replace(triangle.begin(), triangle.end(), from, to);
      const Vec3 after = across(triangle);
      if (!keeps_direction(before, after, triangle)) return false;
      moved.push_back({&vertices_[triangle[0]], &vertices_[triangle[1]], &vertices_[triangle[2]]});
      const auto at = std::find(triangle.begin(), triangle.end(), to) - triangle.begin();
      const auto other = [&](std::ptrdiff_t i) {
        return vertices_[triangle[static_cast<std::size_t>((at + i) % 3)]].place;
      };
      is_flat = is_flat && star.add(other(1), other(2));
    }
    unproved += 2 * slack;
    if (is_flat && unproved <= proof_.slack()) return true;
    unproved = 0;
    return std::ranges::all_of(moved,
                               [&](const auto& t) { return proof_.may_be_near_surface(t); }) &&
           std::ranges::all_of(moved, [&](const auto& t) { return proof_.is_near_surface(t); });
  }
  bool keeps_direction(const Vec3& before, const Vec3& after, const Triangle& triangle) const {
    if (is_narrow(triangle, after)) return false;
    const double length = glm::length(after);
    constexpr double upright = 0.05;
    constexpr double least_turn = 0.2;
    if (glm::dot(before, after) < least_turn * glm::length(before) * length) return false;
    return std::ranges::all_of(triangle, [&](std::uint32_t vertex) {
      return glm::dot(after, vertices_[vertex].outwards) > upright * length;
    });
  }
  /// Returns whether a triangle is so narrow that only rounding says where its normal points.
  bool is_narrow(const Triangle& triangle, const Vec3& normal) const {
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, glm::length(vertices_[triangle[(i + 1) % 3]].place -
                                              vertices_[triangle[i]].place));
    }
    constexpr double narrow = 1e-6;
    return !(glm::length(normal) > narrow * longest * longest);
  }

  void take(std::uint32_t from, std::uint32_t to, double unproved) {
    const std::vector<std::uint32_t> changed = neighbours_of(from);
    for (const std::uint32_t t : around_[from]) {
      if (has(triangles_[t], to)) {
        is_gone_[t] = 1;
        continue;
      }
      std::replace(triangles_[t].begin(), triangles_[t].end(), from, to);
      unproved_[t] = unproved;
      around_[to].push_back(t);
    }
    around_[from].clear();
    for (const std::uint32_t vertex : changed) {
      std::erase_if(around_[vertex], [&](std::uint32_t t) { return is_gone_[t] != 0; });
      ++version_[vertex];
    }
    for (const std::uint32_t vertex : changed) add(vertex);
  }

  DualMesh rest() const {
    DualMesh mesh;
    std::vector<std::uint32_t> numbers(vertices_.size(), invalid_index);
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
      if (around_[v].empty()) continue;
      numbers[v] = static_cast<std::uint32_t>(mesh.vertices.size());
      mesh.vertices.push_back(vertices_[v]);
    }
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (is_gone_[t] != 0) continue;
      const Triangle& triangle = triangles_[t];
      mesh.triangles.push_back({numbers[triangle[0]], numbers[triangle[1]], numbers[triangle[2]]});
    }
    return mesh;
  }

  std::vector<DualVertex> vertices_;
  std::vector<Triangle> triangles_;
  const SurfaceProof& proof_;
  const std::vector<char>& kept_;
  MeasureClock& clock_;
  std::vector<std::vector<std::uint32_t>> around_;  ///< the triangles at each corner
  std::vector<std::uint32_t> version_;              ///< how often what is around a corner changed
  std::vector<double> unproved_;  ///< how much farther than is proved a triangle may be
  std::vector<char> is_gone_;
  std::priority_queue<Move> moves_;
};

}  // namespace

DualMesh simplified(const DualMesh& mesh, const SurfaceProof& proof, const std::vector<char>& kept,
                    MeasureClock& clock) {
  return Simplification(mesh, proof, kept, clock).run();
}

}  // namespace crt::core
