// Every primitive against the oracle, over 18 orders of size and 15 of distance.
#include <doctest/doctest.h>
#include <fmt/core.h>

#include "oracle/measure.hpp"

using namespace crt::test;

namespace {

constexpr std::array<std::uint64_t, primitive_kinds> ray_counts = {20'000, 20'000, 20'000, 20'000, 20'000,
                                                                   20'000, 20'000, 20'000, 20'000};

}  // namespace

TEST_CASE("every primitive keeps its bounds, and decides right but for close calls") {
  for (std::size_t kind = 0; kind < primitive_kinds; ++kind) {
    const std::string name(name_of_primitive(kind));
    CAPTURE(name);
    const Record record = measure_all(kind, 0, ray_counts[kind], {standard_tier()})[0];
    MESSAGE(fmt::format("{}: rays {} hits {} close {} wrong {} ratio {} claim {} ulps max {} 99.9 {}", name,
                        record.rays, record.hits, record.close_calls, record.wrong, record.largest_ratio,
                        record.largest_claim, record.ulps_by_kind[0].largest(),
                        record.ulps_by_kind[0].quantile(0.999)));
    for (const std::uint64_t number : record.failures) {
      FAIL_CHECK(fmt::format("ray {}: {}", number, description(make_ray(kind, number))));
    }
    CHECK(record.wrong == 0);
    CHECK(record.largest_ratio <= 1);
    CHECK(record.largest_claim <= 1);
  }
}
