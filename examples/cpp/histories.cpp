// Follows neutral particles through nested cells in a room whose walls reflect, and counts how much
// of their way is in each. In such a room that share is the share of the volume. No particle is
// lost: each ray begins on the surface where the one before has ended, by the start of its hit.
//
//     histories [HOW MANY [SEED]]
#include <algorithm>
#include <array>
#include <cmath>
#include <crt/crt.hpp>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <random>
#include <vector>

namespace {

// The cells, from the outermost to the innermost. A point is in the innermost one around it.
enum Cell : std::uint32_t { air, tank, water, fuel, cell_count };
constexpr std::array<const char*, cell_count> names = {"air", "tank", "water", "fuel"};
constexpr double mean_free_path = 0.4;
constexpr int most_collisions = 10;

crt::Scene cells() {
  crt::Scene scene;
  scene.entities = {crt::Box{.corner_a = {-1, -1, -1}, .corner_b = {1, 1, 1}},
                    crt::Cylinder{.from = {0, -0.8, 0}, .to = {0, 0.8, 0}, .radius = 0.7},
                    crt::Cylinder{.from = {0, -0.7, 0}, .to = {0, 0.7, 0}, .radius = 0.6},
                    crt::Sphere{.center = {0.1, 0, 0}, .radius = 0.4}};
  return scene;
}

std::array<double, cell_count> true_shares() {
  const double pi = std::numbers::pi;
  const double within[] = {8, pi * 0.49 * 1.6, pi * 0.36 * 1.4, pi * 4 / 3 * 0.064, 0};
  std::array<double, cell_count> shares;
  for (std::size_t i = 0; i < cell_count; ++i) shares[i] = (within[i] - within[i + 1]) / within[0];
  return shares;
}

// A particle flies to its next collision, and scatters there in any direction.
struct Particle {
  std::uint32_t cell = air;
  int collisions = 0;
  double left = 0;  // of the way to the next collision
};

class Histories {
 public:
  explicit Histories(const crt::PreparedScene& scene, std::uint64_t seed)
      : queries_(scene), random_(seed) {}

  // Follows so many particles at once until all have ended.
  void follow(std::size_t count) {
    particles_.assign(count, {});
    rays_.assign(count, {});
    starts_.assign(count, {});
    hits_.assign(count, {});
    for (std::size_t i = 0; i < count; ++i) {
      rays_[i].origin = {within(-1, 1), within(-1, 1), within(-1, 1)};
      particles_[i].cell = cell_at(rays_[i].origin);
      scatter(i);
    }
    while (!particles_.empty()) {
      hits_.resize(rays_.size());
      queries_.trace(rays_, starts_, hits_);
      for (std::size_t i = particles_.size(); i-- > 0;) {
        if (!go_on(i)) remove(i);
      }
    }
  }

  const std::array<double, cell_count>& paths() const { return paths_; }
  std::uint64_t lost() const { return lost_; }
  std::uint64_t steps() const { return steps_; }

 private:
  double within(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  std::uint32_t cell_at(const crt::Vec3& point) {
    crt::Location in;
    queries_.locate(std::span(&point, 1), std::span(&in, 1));
    return in.entity_id;
  }
  void scatter(std::size_t i) {
    const double z = within(-1, 1);
    const double angle = within(0, 2 * std::numbers::pi);
    const double r = std::sqrt(1 - z * z);
    rays_[i].direction = {r * std::cos(angle), r * std::sin(angle), z};
    particles_[i].left = std::exponential_distribution<double>(1 / mean_free_path)(random_);
    rays_[i].t_max = particles_[i].left;
    starts_[i] = {};
  }

  // Takes a particle to its hit or collision. Returns whether its history goes on.
  bool go_on(std::size_t i) {
    Particle& particle = particles_[i];
    crt::Ray& ray = rays_[i];
    const crt::FullHit& hit = hits_[i];
    const double way = std::min(hit.t, particle.left);
    ++steps_;
    paths_[particle.cell] += way;
    if (!hit.found()) {
      ray.origin = ray.origin + way * ray.direction;
      if (cell_at(ray.origin) != particle.cell) {
        ++lost_;
        return false;
      }
      if (++particle.collisions == most_collisions) return false;
      scatter(i);
      return true;
    }
    ray.origin = hit.position;
    starts_[i] = hit.start;
    particle.left -= way;
    ray.t_max = particle.left;
    if (hit.entity_id == air) {  // the room's walls
      ray.direction = ray.direction - 2 * glm::dot(ray.direction, hit.normal) * hit.normal;
    } else {
      particle.cell = hit.side == crt::HitSide::entering ? hit.entity_id : hit.entity_id - 1;
    }
    return true;
  }

  void remove(std::size_t i) {
    particles_[i] = particles_.back();
    rays_[i] = rays_.back();
    starts_[i] = starts_.back();
    hits_[i] = hits_.back();
    particles_.pop_back();
    rays_.pop_back();
    starts_.pop_back();
    hits_.pop_back();
  }

  crt::RayQueries queries_;
  std::mt19937_64 random_;
  std::vector<Particle> particles_;
  std::vector<crt::Ray> rays_;
  std::vector<crt::RayStart> starts_;
  std::vector<crt::FullHit> hits_;
  std::array<double, cell_count> paths_{};
  std::uint64_t lost_ = 0;
  std::uint64_t steps_ = 0;
};

}  // namespace

int main(int argc, char** argv) try {
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  const std::uint64_t seed = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  Histories histories(crt::prepare(cells()), seed);
  constexpr std::size_t together = 4096;
  for (std::size_t done = 0; done < count; done += together)
    histories.follow(std::min(together, count - done));

  double total = 0;
  for (const double path : histories.paths()) total += path;
  const std::array<double, cell_count> shares = true_shares();
  std::cout << std::fixed << std::setprecision(4);
  for (std::size_t i = 0; i < cell_count; ++i) {
    std::cout << names[i] << ": " << histories.paths()[i] / total << " of all paths, " << shares[i]
              << " of the volume\n";
  }
  std::cout << count << " histories, " << histories.steps() << " steps, " << histories.lost()
            << " lost\n";
  return histories.lost() == 0 ? 0 : 1;
} catch (const crt::Error& error) {
  std::cerr << "histories: " << error.what() << '\n';
  return 2;
}
