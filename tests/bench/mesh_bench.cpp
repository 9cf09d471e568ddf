// Compares CRT's queries for a closed mesh with bare Embree's, on one thread, in turns, and a mesh
// with a thousand spheres cut out of it with the mesh alone. Writes JSON: for each number of
// triangles and flow of rays the seconds of each contender in each round, and its speed as a share
// of its yardstick's.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <cmath>
#include <crt/prepared_scene.hpp>
#include <crt/query.hpp>
#include <crt/scene.hpp>
#include <iostream>
#include <memory>
#include <numbers>
#include <stdexcept>

#include "bare_embree.hpp"
#include "measuring.hpp"

namespace crt::bench {

namespace {

constexpr double radius = 2.5;

/// Returns a place on a ball with bumps, in a direction.
std::array<double, 3> bumpy(double x, double y, double z) {
  const double bumps = 1 + 0.15 * std::sin(9 * x) * std::sin(8 * y) * std::cos(7 * z);
  const double distance = radius * bumps;
  return {distance * x, distance * y, distance * z};
}

/// Returns the ball as rings of triangles about the y axis, some 4 n^2 of them.
Surface ball(int n) {
  Surface surface;
  const int around = 2 * n;
  const auto index = [&](int ring, int place) {
    return static_cast<std::uint32_t>(1 + ring * around + place % around);
  };
  surface.positions.push_back(bumpy(0, 1, 0));
  for (int ring = 0; ring < n; ++ring) {
    const double polar = std::numbers::pi * (ring + 1) / (n + 1);
    for (int place = 0; place < around; ++place) {
      const double angle = 2 * std::numbers::pi * place / around;
      surface.positions.push_back(bumpy(std::sin(polar) * std::cos(angle), std::cos(polar),
                                        std::sin(polar) * std::sin(angle)));
    }
  }
  const auto last = static_cast<std::uint32_t>(surface.positions.size());
  surface.positions.push_back(bumpy(0, -1, 0));
  for (int place = 0; place < around; ++place) {
    surface.triangles.push_back({0, index(0, place), index(0, place + 1)});
    for (int ring = 0; ring + 1 < n; ++ring) {
      surface.triangles.push_back(
          {index(ring, place), index(ring + 1, place), index(ring + 1, place + 1)});
      surface.triangles.push_back(
          {index(ring, place), index(ring + 1, place + 1), index(ring, place + 1)});
    }
    surface.triangles.push_back({index(n - 1, place), last, index(n - 1, place + 1)});
  }
  return surface;
}

Entity entity_of(const Surface& surface) {
  std::vector<Vec3> positions;
  for (const auto& [x, y, z] : surface.positions) positions.emplace_back(x, y, z);
  return triangle_mesh(positions, surface.triangles);
}

/// Returns the entity less a thousand spheres about its surface.
Entity cut(const Entity& entity) {
  Stream stream(3);
  std::vector<Entity> spheres;
  for (int i = 0; i < 1000; ++i) {
    const double z = stream.between(-1, 1);
    const double angle = stream.between(0, 2 * std::numbers::pi);
    const double level = std::sqrt(1 - z * z);
    const double distance = stream.between(0.7, 1.2) * radius;
    spheres.emplace_back(Sphere{.center = {distance * level * std::cos(angle),
                                           distance * level * std::sin(angle), distance * z},
                                .radius = 0.04 * radius});
  }
  return csg_difference(entity, spheres);
}

PreparedScene prepared(const Entity& entity) {
  Scene scene;
  scene.entities = {entity};
  return prepare(scene);
}

/// A Named contender is compared with another, its yardstick.
struct Named {
  Contender contender;
  std::string yardstick;
};

/// A Comparison holds all that is asked for one number of triangles.
class Comparison {
 public:
  Comparison(int n, int side) : side_(side), surface_(ball(n)) {}

  /// Returns rows of JSON, one for each contender.
  std::vector<std::string> run(Flow flow, int rounds) {
    const std::vector<crt_ray> given =
        flow == Flow::coherent ? camera_rays(side_) : scattered_rays(side_ * side_);
    std::vector<Ray> rays;
    for (const crt_ray& ray : given) {
      rays.push_back({.origin = {ray.origin[0], ray.origin[1], ray.origin[2]},
                      .direction = {ray.direction[0], ray.direction[1], ray.direction[2]}});
    }
    const std::size_t count = rays.size();
    std::vector<Answer> answers(count);
    std::vector<std::uint8_t> hidden(count);
    std::vector<PlainHit> hits(count);
    std::vector<double> distances(count);
    const std::unique_ptr<bool[]> blocked(new bool[count]);
    RayQueries own(mesh_);
    RayQueries less(cut_);
    const std::string nearest = "nearest: Embree";
    const std::string any = "any: Embree";
    const std::vector<Named> all = {
        {{nearest, [&] { embree_.intersect_one_by_one(given, flow, answers); }}, nearest},
        {{"nearest: CRT", [&] { own.intersect(rays, hits); }}, nearest},
        {{"nearest: CRT, distances", [&] { own.distances(rays, distances); }}, nearest},
        {{any, [&] { embree_.occluded_one_by_one(given, flow, hidden); }}, any},
        {{"any: CRT",
          [&] {
            own.occluded(rays, {blocked.get(), count});
          }},
         any},
        {{"nearest: CRT, less spheres", [&] { less.intersect(rays, hits); }}, "nearest: CRT"}};
    check(all, answers, distances);
    std::vector<Contender> contenders;
    for (const Named& named : all) contenders.push_back(named.contender);
    const std::vector<std::vector<double>> seconds = take_turns(contenders, rounds);
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const double share = median(shares(all, seconds, i));
      const std::string& name = contenders[i].name;
      std::cerr << fmt::format("  {:32} {:8.1f} ns a ray, {:5.2f} of the speed of {}\n", name,
                               median(seconds[i]) / static_cast<double>(count) * 1e9, share,
                               all[i].yardstick);
      rows.push_back(fmt::format(
          R"({{"triangles": {}, "flow": "{}", "rays": {}, "name": "{}", "yardstick": "{}", )"
          R"("ratio": {}, "seconds": [{}]}})",
          surface_.triangles.size(), name_of(flow), count, name, all[i].yardstick, share,
          fmt::join(seconds[i], ", ")));
    }
    return rows;
  }

 private:
  /// Returns the speed of a contender as a share of its yardstick's, in each round.
  static std::vector<double> shares(const std::vector<Named>& all,
                                    const std::vector<std::vector<double>>& seconds,
                                    std::size_t contender) {
    std::size_t yardstick = 0;
    while (all[yardstick].contender.name != all[contender].yardstick) ++yardstick;
    std::vector<double> result;
    for (std::size_t round = 0; round < seconds[contender].size(); ++round) {
      result.push_back(seconds[yardstick][round] / seconds[contender][round]);
    }
    return result;
  }

  /// Checks that both find the same, but for what rounding to float may do at a silhouette.
  static void check(const std::vector<Named>& all, std::span<const Answer> answers,
                    std::span<const double> distances) {
    all[0].contender.work();
    all[2].contender.work();
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < answers.size(); ++i) {
      const bool is_alike = std::isfinite(distances[i])
                                ? std::abs(answers[i].t - distances[i]) < 1e-3 * distances[i]
                                : !std::isfinite(answers[i].t);
      if (!is_alike) ++unlike;
    }
    if (1000 * unlike > answers.size()) {
      throw std::runtime_error(fmt::format("{} rays find other triangles", unlike));
    }
  }

  int side_;
  Surface surface_;
  Entity entity_{entity_of(surface_)};
  BareEmbree embree_{surface_};
  PreparedScene mesh_{prepared(entity_)};
  PreparedScene cut_{prepared(cut(entity_))};
};

std::vector<std::string> run(bool quick) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const int side = quick ? 400 : 1000;
  const int rounds = quick ? 3 : 11;
  std::vector<std::string> rows;
  for (const int n : {142, 500}) {  // 8e4 and 1e6 triangles
    Comparison comparison(n, side);
    run_flows(comparison, fmt::format("{} triangles", 4 * n * n), rounds, rows);
  }
  return rows;
}

}  // namespace

}  // namespace crt::bench

int main(int argc, char** argv) {
  return crt::bench::measured_main(argc, argv, crt::bench::run);
}
