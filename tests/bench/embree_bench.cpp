// Compares CRT's queries for spheres with bare Embree's, on one thread, in turns. Writes JSON: for
// each number of spheres and flow of rays the seconds of each contender in each round.
#include <crt/crt.h>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <crt/prepared_scene.hpp>
#include <crt/query.hpp>
#include <crt/render.hpp>
#include <iostream>
#include <limits>
#include <memory>
#include <stdexcept>

#include "bare_embree.hpp"
#include "measuring.hpp"

namespace crt::bench {

namespace {

void require(crt_status status) {
  if (status != CRT_OK) throw std::runtime_error(crt_error_message());
}

PreparedScene prepared_in_cpp(const std::vector<Ball>& balls, int side) {
  Scene scene;
  for (const Ball& ball : balls) {
    scene.entities.emplace_back(
        Sphere{.center = {ball.center[0], ball.center[1], ball.center[2]}, .radius = ball.radius});
  }
  const double(&p)[3] = camera_position;
  scene.camera = {.position = {p[0], p[1], p[2]}, .pointing = {0, 0, 0}, .fov = camera_fov};
  scene.settings = {.width = side, .height = side, .head_light = false};
  return prepare(scene);
}

using PreparedInC = std::unique_ptr<crt_prepared, void (*)(crt_prepared*)>;

PreparedInC prepared_in_c(const std::vector<Ball>& balls) {
  crt_scene* scene = nullptr;
  require(crt_scene_create(&scene));
  for (const Ball& ball : balls) {
    crt_entity* entity = nullptr;
    require(crt_sphere_create(ball.center, ball.radius, &entity));
    require(crt_scene_add_entity(scene, entity));
    crt_entity_release(entity);
  }
  crt_prepared* prepared = nullptr;
  require(crt_scene_prepare(scene, &prepared));
  crt_scene_release(scene);
  return {prepared, crt_prepared_release};
}

/// A Comparison holds all that is asked for one number of spheres.
class Comparison {
 public:
  Comparison(int count, int side) : side_(side), balls_(balls_in_a_box(count)) {}

  /// Returns rows of JSON, one for each contender.
  std::vector<std::string> run(Flow flow, int rounds) {
    const std::vector<crt_ray> rays =
        flow == Flow::coherent ? camera_rays(side_) : scattered_rays(side_ * side_);
    answers_.resize(rays.size());
    hits_.resize(rays.size());
    distances_.resize(rays.size());
    ids_.resize(rays.size());
    hidden_.resize(rays.size());
    std::vector<Contender> contenders = embree(rays, flow);
    for (Contender& own : ours(rays, flow)) contenders.push_back(std::move(own));
    check(contenders, flow);
    const std::vector<std::vector<double>> seconds = take_turns(contenders, rounds);
    std::vector<std::string> rows;
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      std::cerr << fmt::format("  {:45} {:8.1f} ns a ray\n", contenders[i].name,
                               median(seconds[i]) / static_cast<double>(rays.size()) * 1e9);
      rows.push_back(fmt::format(
          R"({{"spheres": {}, "flow": "{}", "rays": {}, "name": "{}", "seconds": [{}]}})",
          balls_.size(), name_of(flow), rays.size(), contenders[i].name,
          fmt::join(seconds[i], ", ")));
    }
    return rows;
  }

 private:
  std::vector<Contender> embree(const std::vector<crt_ray>& rays, Flow flow) {
    std::vector<Contender> result;
    const auto add = [&](const char* name, const BareEmbree& world) {
      result.push_back({fmt::format("nearest: Embree, {}, one by one", name),
                        [&, flow] { world.intersect_one_by_one(rays, flow, answers_); }});
      result.push_back({fmt::format("nearest: Embree, {}, packets of 16", name),
                        [&, flow] { world.intersect_packets(rays, flow, answers_); }});
    };
    add("double callback", doubles_);
    add("float callback", floats_);
    add("SPHERE_POINT", points_);
    add("triangles", triangles_);
    result.push_back({"any: Embree, double callback, one by one",
                      [&, flow] { doubles_.occluded_one_by_one(rays, flow, hidden_); }});
    result.push_back({"any: Embree, double callback, packets of 16",
                      [&, flow] { doubles_.occluded_packets(rays, flow, hidden_); }});
    return result;
  }

  std::vector<Contender> ours(const std::vector<crt_ray>& rays, Flow flow) {
    std::vector<Contender> result = {
        {"nearest: CRT, batch (C)",
         [&] {
           require(crt_intersect(in_c_.get(), rays.data(), 0, rays.size(), hits_.data(), 0));
         }},
        {"nearest: CRT, distances (C)",
         [&] {
           require(crt_distances(in_c_.get(), rays.data(), 0, rays.size(), distances_.data(),
                                 ids_.data()));
         }},
        {"nearest: CRT, one by one (C++)", [&] { one_by_one(rays); }},
        {"any: CRT, batch (C)",
         [&] { require(crt_occluded(in_c_.get(), rays.data(), 0, rays.size(), hidden_.data())); }},
    };
    if (flow == Flow::coherent) {
      result.push_back(
          {"nearest: CRT, a picture without lights", [&] { render(in_cpp_, {.threads = 1}); }});
    }
    return result;
  }

  void one_by_one(const std::vector<crt_ray>& rays) {
    RayQueries queries(in_cpp_);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const crt_ray& ray = rays[i];
      const std::optional<Hit> hit =
          queries.intersect({.origin = {ray.origin[0], ray.origin[1], ray.origin[2]},
                             .direction = {ray.direction[0], ray.direction[1], ray.direction[2]},
                             .t_min = ray.t_min,
                             .t_max = ray.t_max});
      answers_[i] =
          hit ? Answer{hit->t, hit->entity_id} : Answer{std::numeric_limits<double>::infinity(), 0};
    }
  }

  /// Checks that those that compute in double find the same.
  void check(const std::vector<Contender>& contenders, Flow flow) {
    const auto t_of = [&](std::string_view name, std::size_t ray) {
      if (name == "nearest: CRT, batch (C)") return hits_[ray].t;
      return name == "nearest: CRT, distances (C)" ? distances_[ray] : answers_[ray].t;
    };
    const auto sum = [&](const char* name) {
      for (const Contender& contender : contenders) {
        if (contender.name == name) contender.work();
      }
      double total = 0;
      for (std::size_t i = 0; i < answers_.size(); ++i) {
        const double t = t_of(name, i);
        if (t < std::numeric_limits<double>::infinity()) total += 1 + t;
      }
      return total;
    };
    const double expected = sum("nearest: CRT, one by one (C++)");
    for (const char* name : {"nearest: CRT, batch (C)", "nearest: CRT, distances (C)",
                             "nearest: Embree, double callback, one by one",
                             "nearest: Embree, double callback, packets of 16"}) {
      // For a ray that grazes a sphere both answers are right.
      constexpr double grazing_share = 1e-4;
      const double found = sum(name);
      if (std::abs(found - expected) > grazing_share * expected) {
        throw std::runtime_error(fmt::format("{} finds other spheres ({} rays): {} and {}", name,
                                             name_of(flow), found, expected));
      }
    }
  }

  int side_;
  std::vector<Ball> balls_;
  BareEmbree doubles_{balls_, Stand::double_callback};
  BareEmbree floats_{balls_, Stand::float_callback};
  BareEmbree points_{balls_, Stand::sphere_point};
  BareEmbree triangles_{balls_, Stand::triangles};
  PreparedScene in_cpp_{prepared_in_cpp(balls_, side_)};
  PreparedInC in_c_{prepared_in_c(balls_)};
  std::vector<Answer> answers_;
  std::vector<crt_hit> hits_;
  std::vector<double> distances_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint8_t> hidden_;
};

std::vector<std::string> run(bool quick) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const int side = quick ? 400 : 1000;
  const int rounds = quick ? 3 : 11;
  std::vector<std::string> rows;
  for (const int count : {10'000, quick ? 100'000 : 1'000'000}) {
    std::cerr << fmt::format("{} spheres: building\n", count);
    Comparison comparison(count, side);
    run_flows(comparison, fmt::format("{} spheres", count), rounds, rows);
  }
  return rows;
}

}  // namespace

}  // namespace crt::bench

int main(int argc, char** argv) {
  return crt::bench::measured_main(argc, argv, crt::bench::run);
}
