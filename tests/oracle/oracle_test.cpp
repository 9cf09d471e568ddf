// These tests compare every primitive with the oracle, over 18 orders of size and 15 of distance.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include <string_view>

#include "oracle/measure.hpp"

using namespace crt::test;

namespace {

// `./dev oracle` takes more rays. Tori and revolutions of the exact tier cost up to a hundred times
// what others do. A build that is slow by intent gets a sixth.
#if defined(__OPTIMIZE__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr std::uint64_t rays = 300'000;
#else
constexpr std::uint64_t rays = 50'000;
#endif
constexpr std::uint64_t slow_rays = rays / 10;
constexpr std::uint64_t placed_rays = rays / 20;

std::uint64_t rays_for(std::size_t kind) {
  const std::string_view name = name_of_primitive(kind);
  return name == "torus" || name == "revolution" ? slow_rays : rays;
}

void check(std::size_t kind, std::uint64_t count, const std::vector<Contestant>& tiers,
           RayMaker maker) {
  const std::string name(name_of_primitive(kind));
  CAPTURE(name);
  const std::vector<Record> records = measure_all(kind, 0, count, tiers, maker);
  for (std::size_t i = 0; i < tiers.size(); ++i) {
    const std::string tier = tiers[i].name;
    CAPTURE(tier);
    const Record& record = records[i];
    std::string failures;
    for (const std::uint64_t number : record.failures) {
      failures += fmt::format("ray {}: {}\n", number, description(maker(kind, number)));
    }
    INFO(failures);
    CHECK(record.hits > count / 3);
    CHECK(record.wrong == 0);
    CHECK(record.largest_ratio <= 1);
    CHECK(record.largest_claim <= 1);
  }
}

}  // namespace

TEST_CASE("every primitive keeps its bounds, and decides right but for close calls") {
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind)
    check(kind, rays_for(kind), {standard_tier(), exact_tier()}, make_ray);
}

TEST_CASE("the exact tier is right about transformed primitives") {
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind)
    check(kind, placed_rays, {exact_tier()}, make_placed_ray);
}
