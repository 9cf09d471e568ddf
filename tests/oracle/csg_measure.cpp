#include "oracle/csg_measure.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "oracle/prepared_tree.hpp"

namespace crt::test {
namespace {

constexpr std::size_t max_failures = 20;

/// Says whether the flips alternate, and so make sense at all.
bool alternates(const FoundFlips& found) {
  bool inside = found.inside_before;
  return std::all_of(found.flips.begin(), found.flips.end(), [&](const FoundFlip& flip) {
    inside = !inside;
    return flip.entering == inside;
  });
}

bool is_exactly(const FoundFlips& found, const TreeOracle::Flips& truth) {
  if (found.inside_before != truth.inside_before || found.flips.size() != truth.flips.size())
    return false;
  return std::equal(found.flips.begin(), found.flips.end(), truth.flips.begin(),
                    [](const FoundFlip& a, const TreeOracle::Flip& b) {
                      const double error = std::abs((b.t - Ball<4>(a.t)).value());
                      return a.entering == b.entering && error <= ulp(b.t.value()) + b.t.radius();
                    });
}

template <class FlipList, class Time>
bool is_inside_at(double t, bool inside_before, const FlipList& flips, const Time& time) {
  const auto passed =
      std::count_if(flips.begin(), flips.end(), [&](const auto& flip) { return time(flip) < t; });
  return (passed % 2 == 1) != inside_before;
}

/// Says how an answer of the standard tier differs from the truth.
enum class Difference { none, within_bounds, beyond };

Difference difference(const FoundFlips& found, const TreeOracle::Flips& truth,
                      const TreeOracle& tree, const GridRay& ray) {
  std::vector<double> places;
  for (const FoundFlip& flip : found.flips) places.push_back(flip.t);
  for (const TreeOracle::Flip& flip : truth.flips) places.push_back(flip.t.value());
  std::sort(places.begin(), places.end());
  std::vector<double> samples = {0};
  if (!places.empty()) samples = {places.front() - 1, places.back() + 1};
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    for (const double share : {0.25, 0.5, 0.75})
      samples.push_back(places[i] + share * (places[i + 1] - places[i]));
  }
  for (const double t : samples) {
    const bool reported =
        is_inside_at(t, found.inside_before, found.flips, [](const auto& f) { return f.t; });
    const bool is = is_inside_at(t, truth.inside_before, truth.flips,
                                 [](const auto& f) { return f.t.value(); });
    if (reported != is && tree.certain_side(ray, t) != 0) return Difference::beyond;
  }
  const bool same =
      found.inside_before == truth.inside_before && found.flips.size() == truth.flips.size();
  return same ? Difference::none : Difference::within_bounds;
}

void measure_tree(std::uint64_t number, std::uint64_t rays, CsgRecord& record) {
  const SolidTree tree = random_tree(number);
  const TreeOracle oracle(tree);
  const Entity entity = tree.entity();
  PreparedTree standard(entity, Precision::standard);
  PreparedTree exact(entity, Precision::exact);
  ++record.trees;
  record.faces += static_cast<std::uint64_t>(oracle.faces());
  record.coincident_faces += static_cast<std::uint64_t>(oracle.coincident_faces());
  const auto fail = [&](const char* tier, std::uint64_t ray) {
    if (record.failures.size() < max_failures)
      record.failures.push_back(fmt::format("{}: tree {}, ray {}", tier, number, ray));
  };
  for (std::uint64_t i = 0; i < rays; ++i) {
    const GridRay ray = random_ray(number, i);
    const TreeOracle::Flips truth = oracle.flips(ray);
    ++record.rays;
    record.crossings += truth.flips.size();
    const FoundFlips rough = standard.flips(ray);
    const Difference how =
        alternates(rough) ? difference(rough, truth, oracle, ray) : Difference::beyond;
    if (how == Difference::within_bounds) ++record.standard.close_calls;
    if (how == Difference::beyond) {
      ++record.standard.wrong;
      fail("standard", i);
    }
    const FoundFlips fine = exact.flips(ray);
    if (is_exactly(fine, truth)) continue;
    ++record.exact.wrong;
    fail("exact", i);
  }
  record.exact.escalations += exact.escalations();
}

}  // namespace

void CsgRecord::add(const CsgRecord& other) {
  trees += other.trees;
  rays += other.rays;
  faces += other.faces;
  coincident_faces += other.coincident_faces;
  crossings += other.crossings;
  const auto add_tier = [](Tier& to, const Tier& from) {
    to.close_calls += from.close_calls;
    to.wrong += from.wrong;
    to.escalations += from.escalations;
  };
  add_tier(standard, other.standard);
  add_tier(exact, other.exact);
  failures.insert(failures.end(), other.failures.begin(), other.failures.end());
  std::sort(failures.begin(), failures.end());
  if (failures.size() > max_failures) failures.resize(max_failures);
}

CsgRecord measure_csg(std::uint64_t first, std::uint64_t last, std::uint64_t rays_per_tree) {
  const unsigned threads = std::max(1u, std::thread::hardware_concurrency());
  std::vector<CsgRecord> parts(threads);
  std::atomic<std::uint64_t> next = first;
  const auto work = [&](CsgRecord& record) {
    for (std::uint64_t number = next++; number < last; number = next++)
      measure_tree(number, rays_per_tree, record);
    mpfr_free_cache();
  };
  std::vector<std::thread> workers;
  for (CsgRecord& record : parts) workers.emplace_back(work, std::ref(record));
  for (std::thread& worker : workers) worker.join();
  CsgRecord result;
  for (const CsgRecord& record : parts) result.add(record);
  return result;
}

}  // namespace crt::test
