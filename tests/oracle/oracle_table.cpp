// Measures the accuracy of every primitive and writes docs/accuracy.md and its plot.
// usage: oracle_table RAYS PAGE PLOT
#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "oracle/accuracy_plot.hpp"
#include "oracle/measure.hpp"
#include "oracle/naive.hpp"

using namespace crt::test;

namespace {

/// Nanoseconds a ray: the best of many rounds, as other work may disturb some.
template <class Intersect>
double nanoseconds(std::size_t rays, const Intersect& intersect) {
  constexpr int rounds = 300;
  double best = std::numeric_limits<double>::infinity();
  for (int round = 0; round < rounds; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < rays; ++i) intersect(i);
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - start;
    best = std::min(best, spent.count() / static_cast<double>(rays));
  }
  return best;
}

Measured measured(std::size_t kind, std::uint64_t rays) {
  std::vector<Record> records = measure_all(kind, 0, rays, {standard_tier(), naive_formulas()});
  constexpr std::uint64_t timed_rays = 1000;
  std::vector<TestRay> timed;
  std::vector<std::unique_ptr<const crt::core::Shape>> shapes;
  std::vector<crt::core::ObjectRay> object_rays;
  for (std::uint64_t i = 0; i < timed_rays; ++i) {
    timed.push_back(make_ray(kind, i));
    shapes.push_back(crt::core::make_shape(timed.back().primitive));
    object_rays.push_back({.origin = timed.back().origin, .direction = timed.back().direction});
  }
  crt::core::CrossingList found;
  const double our_time = nanoseconds(timed.size(), [&](std::size_t i) {
    found.clear();
    shapes[i]->crossings(object_rays[i], found);
  });
  const double naive_time = nanoseconds(timed.size(), [&](std::size_t i) {
    found.clear();
    naive_crossings(timed[i].primitive, timed[i].origin, timed[i].direction, found);
  });
  return {kind, std::move(records[0]), std::move(records[1]), our_time, naive_time};
}

std::string number(double value) {
  if (value < 1000) return fmt::format("{:.3g}", value);
  return fmt::format("{:.1e}", value);
}

std::string rows(const Measured& of) {
  std::string result;
  for (const auto& [record, name, time] :
       {std::tuple{&of.ours, "standard", of.our_time}, {&of.naive, "naive", of.naive_time}}) {
    const Histogram& plain = record->ulps_by_kind[0];
    result +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {:.0f} |\n", name_of_primitive(of.kind), name,
                    record->rays, record->wrong, record->close_calls, number(record->largest_ratio),
                    number(plain.quantile(0.999)), number(plain.largest()), time);
  }
  return result;
}

std::string by_kind(const Measured& of) {
  std::string result = fmt::format("| {} |", name_of_primitive(of.kind));
  for (std::size_t i = 0; i < ray_kinds; ++i) {
    result += fmt::format(" {} / {} |", number(of.ours.ulps_by_kind[i].quantile(0.999)),
                          number(of.naive.ulps_by_kind[i].quantile(0.999)));
  }
  return result + "\n";
}

constexpr const char* introduction = R"(# Accuracy, measured

This page is written by `./dev oracle`: every primitive against an oracle that solves its implicit equation
along the line in MPFR arithmetic, with precision doubled and doubled again until the answer is certain (`tests/oracle`).

Sizes are 10^-9 to 10^9, the offset of the scene 10^-9 to 10^9, the distance of the ray's origin 10^-3 to 10^12 sizes. Half of the rays are
plain. A tenth each: grazing (along a tangent, moved in or out by 10^-16 to 0.1 sizes), parallel to a coordinate axis, aimed at edges
and corners, starting on the surface, and 10^-16 to 0.1 off parallel to a face or an axis.

*naive* are the formulas that everyone writes first, in plain doubles (`tests/oracle/naive.cpp`).

- **wrong**: rays that are told to be inside (or outside) of the solid at a point that is farther from its surface than
  8 u (R + |x|) and the spacing of t's doubles there; for surfaces, rays whose hit or miss differs from the true one though they meet
  the plane farther from the rim than the bound of t (below) and 8 u (R + |x|).
- **close calls**: rays decided otherwise than the truth, but within that.
- **error / bound**: the largest |t - true t|, over 0.5 ulp(t) + 8 u (R + |x|) / |n . d|, of all kinds of rays that were decided right.
- **ulps**: |t - true t| in units of the last place of t, for plain rays. What is above one half is what the place and the slant of the ray make
  unavoidable: the bound's second term. A start on the surface itself, where t is but rounding, is not counted.
- **ns**: nanoseconds a ray on one core, over all kinds of rays, each of another primitive; the best of many rounds.

u is 2^-53; R the radius of a ball that holds the primitive (0 for planes); x the point relative to its centre; n . d the cosine of the slant.

)";

bool write(const char* path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  return static_cast<bool>(file.flush());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: oracle_table RAYS PAGE PLOT\n");
    return 2;
  }
  const std::uint64_t rays = std::strtoull(argv[1], nullptr, 10);
  std::vector<Measured> all;
  bool kept = true;
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    all.push_back(measured(kind, rays));
    fmt::print("{}", rows(all.back()));
    for (const std::uint64_t failure : all.back().ours.failures) {
      kept = false;
      fmt::print("broken by ray {}: {}\n", failure, description(make_ray(kind, failure)));
    }
    std::fflush(stdout);
  }
  std::string page = introduction;
  page +=
      "| primitive | | rays | wrong | close calls | error / bound | ulps, 99.9 % | ulps, largest | ns |\n"
      "|---|---|---|---|---|---|---|---|---|\n";
  for (const Measured& one : all) page += rows(one);
  page +=
      "\n## By kind of ray\n\nThe error in ulps that 99.9 % of the crossings stay below, ours / naive:\n\n| "
      "primitive |";
  for (std::size_t i = 0; i < ray_kinds; ++i) page += fmt::format(" {} |", name_of(static_cast<RayKind>(i)));
  page += "\n|---|---|---|---|---|---|---|\n";
  for (const Measured& one : all) page += by_kind(one);
  page +=
      "\n## By distance\n\nThe same for plain rays by the distance of the origin, in sizes:\n\n![Error "
      "against distance](accuracy.svg)\n";
  if (!write(argv[2], page) || !write(argv[3], accuracy_plot(all))) {
    fmt::print(stderr, "cannot write {} or {}\n", argv[2], argv[3]);
    return 1;
  }
  return kept ? 0 : 1;
}
