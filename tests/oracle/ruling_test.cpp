// These tests ask rays along the straight lines of the sides of cylinders and cones (rulings):
// those that were answered wrong, by name, and what must be true of any.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "core/geometry/frustum/frustum.hpp"
#include "oracle/measure.hpp"
#include "oracle/ruling_rays.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Says whether the ray's answer is right, and within its bound.
bool holds(const Primitive& primitive, const Vec3& origin, const Vec3& direction) {
  Record record;
  return measure(truth_of({.primitive = primitive, .origin = origin, .direction = direction}),
                 standard_tier(), 0, record);
}

constexpr std::size_t cylinder_kind = 4;
constexpr std::size_t cone_kind = 5;
constexpr std::uint64_t rays = 100'000;

}  // namespace

TEST_CASE("a cylinder far from the origin is met by a ray along its side") {
  const Cylinder cylinder{
      .from = {0x1.35c41aedbd0b9p+29, -0x1.8244057bcaee6p+30, -0x1.cddbd0964c284p+29},
      .to = {0x1.35c460b768728p+29, -0x1.82441e08eaf95p+30, -0x1.cddcb4ebdd84cp+29},
      .radius = 0x1.1024947c3c167p+5};
  CHECK(holds(cylinder, {0x1.35c42076f6463p+29, -0x1.824407cfe441ap+30, -0x1.cddbe6556839fp+29},
              {0x1.1de04c1a9468ap-1, -0x1.9248a88d03868p-2, -0x1.d3ab908cf7cd5p+0}));
}

TEST_CASE("a line along the outside of a cylinder passes it") {
  const Cylinder cylinder{
      .from = {0x1.82192e6438866p+3, 0x1.1868522b8578dp+0, 0x1.c02e22cedafe8p-1},
      .to = {0x1.824b6a68ce19p+3, 0x1.17ead1edac675p+0, 0x1.befa212522257p-1},
      .radius = 0x1.0a037881985dfp-17};
  CHECK(holds(cylinder, {0x1.822dbc6f06de2p+3, 0x1.18353769e65fbp+0, 0x1.bfb1254309d3cp-1},
              {0x1.7616899dedc42p-1, -0x1.d34afd52d275p-3, -0x1.1eb5a29466551p-2}));
}

TEST_CASE("a line along the inside of a flat cylinder passes through its caps") {
  const Cylinder cylinder{
      .from = {-0x1.1fa85253e4398p+23, -0x1.011afbd78ae25p+23, -0x1.5e04680d047c8p+25},
      .to = {-0x1.1fcfe77f2c151p+23, -0x1.0135fc3eff389p+23, -0x1.5e0c90a49c15bp+25},
      .radius = 0x1.f000db197365bp+18};
  CHECK(holds(cylinder, {-0x1.2ae6650257312p+23, -0x1.f15bb35e90fe4p+22, -0x1.5c6167b64630dp+25},
              {0x1.d7d5c6522ec3bp-1, 0x1.41dd7e6f55987p-1, 0x1.85020d61eef6fp-1}));
}

TEST_CASE("a line along the inside of a cone passes through its caps") {
  const Cone tall{.from = {-0x1.71dbda4e9e1b2p-5, 0x1.879bdfdfb1023p-5, 0x1.159b6034c668cp-5},
                  .to = {-0x1.b6df8d6b6e413p+20, 0x1.fd55af76ba6a2p+21, -0x1.acda520132d8cp+23},
                  .radius = 0x1.ca1711751d50cp+19,
                  .radius2 = 0x1.58337bd249e81p+19};
  CHECK(holds(tall, {-0x1.f48784ad6d84ap+19, 0x1.113a0f2b685f9p+21, -0x1.27af08a204653p+22},
              {0x1.4f1591405f3p+11, -0x1.88b0caab972p+12, 0x1.5cd2cee966ep+14}));
  const Cone flat{.from = {0, -0x1.db506fa4ca7bbp+21, 0},
                  .to = {0x1.4c0769c628a52p-4, -0x1.db5071185ebcp+21, 0x1.19dca6942dfbbp-3},
                  .radius = 0x1.124611dd8e178p+7,
                  .radius2 = 0x1.0aaf959f9d1e8p+7};
  CHECK(holds(flat, {0x1.5d59c28144786p+5, -0x1.db527c938c646p+21, -0x1.c0e46b4c0f513p+6},
              {0x1.d1cecd09051dcp-3, -0x1.51a32a625c35p-2, -0x1.4f02c854363ep-1}));
}

TEST_CASE("a line along the outside of a long cone passes it") {
  const Cone cone{.from = {-0x1.d59bc3be8ee5cp-33, -0x1.9195f6265d8d7p-27, 0x1.1a8ae391f11d4p-24},
                  .to = {-0x1.d59bc3be8ee5cp-33, -0x1.9195f6265d8d7p-27, 0x1.387caa7ad70f4p+24},
                  .radius = 0x1.fb4e71e132565p+7,
                  .radius2 = 0x1.756048a10a1c5p+6};
  CHECK(holds(cone, {0x1.6409f951be78bp+6, 0x1.b429ecf15c3b2p+6, 0x1.b821970178ffbp+23},
              {-0x1.5851d00fa62ddp-18, -0x1.a420fae8e33bbp-18, 0x1.08b5fc0f98671p+0}));
}

TEST_CASE("a line that is parallel to a ruling but for rounding leaves a cone by the cap") {
  const Cone cone{.from = {0x1.21d59811b6d81p-5, -0x1.8f32618050e48p-6, 0x1.360d6213aefd1p-4},
                  .to = {0x1.21dbed93064e7p-5, -0x1.8f1b30929c498p-6, 0x1.36099a92632aap-4},
                  .radius = 0x1.bae2b043f7533p-23,
                  .radius2 = 0x1.d756b2762159dp-16};
  CHECK(holds(cone, {0x1.21db9a5e8bf37p-5, -0x1.8edf4f666b068p-6, 0x1.3621381b713cfp-4},
              {-0x1.5b48a204e45f2p-4, -0x1.2a5b1dc93b296p-1, -0x1.1bfbee3d5abcfp-1}));
}

TEST_CASE(
    "a line along a ruling of a flat cone is known to leave next to the apex no worse than "
    "elsewhere") {
  const Cone cone{.from = {0, 0, 0x1.a81ff1bc3fe28p+28},
                  .to = {-0x1.a03722f6b2aa3p-47, -0x1.26f39db107136p-1, 0x1.a81ff1bc3fe28p+28},
                  .radius = 0x1.36002cbfa3ae5p+6,
                  .radius2 = 0};
  CHECK(holds(cone, {-0x1.2d6f8ba569131p+4, -0x1.6bca1e88f1f7cp-2, 0x1.a81ff32bbcde4p+28},
              {0x1.44b3825c914a1p-1, -0x1.e721a158e1f68p-8, -0x1.8bda0f1d53bb3p-1}));
}

TEST_CASE("a flat cone is met next to its apex by a line that comes from far behind it") {
  const Cone cone{.from = {0x1.ac6b995fb96b8p+4, 0, 0},
                  .to = {0x1.ac6b995fb9705p+4, 0x1.e885b412c6295p-44, 0x1.0351a4d839271p-46},
                  .radius = 0x1.5c18233bdcae4p-25,
                  .radius2 = 0};
  CHECK(holds(cone, {0x1.ac6b9963d3164p+4, -0x1.863eb0a40fc46p-26, -0x1.6484bc6fb0c93p-27},
              {-0x1.2ac18p-31, -0x1.b464798e8f9ap-27, -0x1.726c2e544632cp-29}));
}

TEST_CASE(
    "the error of a root that is solved for from the far end of a needle is that of the far end") {
  const Cylinder first{.from = {0x1.f1acee27d082cp-9, -0x1.92632681f7628p-6, -0x1.c621790324f9ep-7},
                       .to = {0x1.f1ad439d5759bp-9, -0x1.926328c45a6f7p-6, -0x1.c62188a9bdae5p-7},
                       .radius = 0x1.2b499056641efp-41};
  CHECK(holds(first, {0x1.f1acee274d055p-9, -0x1.92632681e4743p-6, -0x1.c62179035c83p-7},
              {-0x1.dc1266b22e9cp-1, 0x1.92c1bc1bf1276p-3, 0x1.5cbf1e4a65aedp-1}));
  const Cylinder second{
      .from = {-0x1.ecc096f5102c2p-30, -0x1.70bcc7aa1c9d9p-29, -0x1.6606ddfc57c62p-29},
      .to = {0x1.0bddc83939ddp-12, -0x1.3b0fa56cb5305p-11, -0x1.8265fd030eed8p-13},
      .radius = 0x1.934a0dd602d68p-29};
  CHECK(holds(second, {0x1.0cfa4a4f5c3b8p+6, -0x1.3c5d59e15d5fp+7, -0x1.83fe4b36cd2fep+5},
              {-0x1.0cfa41f31321ap+6, 0x1.3c5d500c08cc1p+7, 0x1.83fe3f27475d4p+5}));
  const Cylinder third{
      .from = {-0x1.c60d65f69b9c7p-23, 0x1.f8500ecfbb346p-19, -0x1.2c687a24f99bbp-19},
      .to = {-0x1.f4104a8dd22a1p-8, -0x1.565110568e829p-7, -0x1.20c631828399p-7},
      .radius = 0x1.6420e67a2a335p-15};
  CHECK(holds(third, {-0x1.9caf507db109dp-12, -0x1.e8ad8051f853bp-12, -0x1.c6588477664f6p-12},
              {0x1.7d1462c1b16a5p-2, 0x1.04f7b9fc80b5bp-1, 0x1.b80740b0412f3p-2}));
}

namespace {

/// A SideStart is a ray that starts on the side of a solid of extreme proportions, as exactly as
/// rounding allows.
struct SideStart {
  Primitive primitive;
  core::ObjectRay ray;

  SideStart(Counted& random, std::size_t kind);

  /// Returns how far the reported inside or outside is wrong, beyond what is promised, over that.
  double wrong_by() const;
};

SideStart::SideStart(Counted& random, std::size_t kind) {
  const double size = random.power_of_ten(-9, 9);
  const double offset = size * random.power_of_ten(-9, 0);
  const Vec3 at = offset * random.in_cube();
  Cone solid{};
  if (kind == cone_kind) {
    make_extreme(random, at, size, solid);
    primitive = solid;
  } else {
    Cylinder cylinder;
    make_extreme(random, at, size, cylinder);
    solid = {.from = cylinder.from,
             .to = cylinder.to,
             .radius = cylinder.radius,
             .radius2 = cylinder.radius};
    primitive = cylinder;
  }
  const Ruling ruling(random, solid);
  const double tilt = random.power_of_ten(-16, 0);
  ray.origin =
      ruling.at(random.integer(0, 1) == 0 ? random.uniform(0, 1) : 1 - random.power_of_ten(-12, 0));
  ray.direction = random.sign() * ruling.direction;
  const double sign = random.sign();
  ray.direction += sign * tilt * (random.integer(0, 1) == 0 ? ruling.normal : random.direction());
  const bool enters = glm::dot(ruling.normal, ray.direction) < 0;
  ray.start = {.face = 0, .side = enters ? core::Side::inside : core::Side::outside};
}

double SideStart::wrong_by() const {
  constexpr double u = unit_of_rounding;
  const Question question{.primitive = primitive, .origin = ray.origin, .direction = ray.direction};
  const TrueLine truth = true_crossings(question);
  core::CrossingList found;
  const bool found_before = core::make_shape(primitive)->crossings(ray, found);
  std::vector<double> places = {0};
  for (const core::Crossing& crossing : found) places.push_back(crossing.t);
  for (const TrueCrossing& crossing : truth.crossings) places.push_back(crossing.t.value());
  std::sort(places.begin(), places.end());
  const auto passed = [](const auto& crossings, double t, const auto& t_of) {
    return std::count_if(crossings.begin(), crossings.end(),
                         [&](const auto& c) { return t_of(c) < t; }) %
               2 ==
           1;
  };
  const double speed = glm::length(ray.direction);
  const double off = std::abs(true_distance(question, 0));
  double result = 0;
  for (std::size_t i = 0; i + 1 < places.size(); ++i) {
    const double t = (places[i] + places[i + 1]) / 2;
    if (!(t > 0)) continue;
    const bool inside = passed(found, t, [](const auto& c) { return c.t; }) != found_before;
    const bool truly = passed(truth.crossings, t, [](const auto& c) { return c.t.value(); }) !=
                       truth.inside_before;
    if (inside == truly) continue;
    const double outside = true_distance(question, t);
    const double from_center = glm::length(ray.origin - center_of(primitive) + t * ray.direction);
    const double allowed = 8 * u * (size_of(primitive) + from_center) + ulp(t) * speed + 2 * off;
    result = std::max(result, (inside ? outside : -outside) / allowed);
  }
  return result;
}

}  // namespace

TEST_CASE("a ray that starts on a side next to a ruling is inside for as long as it is") {
  for (const std::size_t kind : {cylinder_kind, cone_kind}) {
    for (std::uint64_t i = 0; i < rays; ++i) {
      Counted random(79 + kind, i);
      const SideStart start(random, kind);
      CAPTURE(kind);
      CAPTURE(i);
      REQUIRE(start.wrong_by() <= 1);
    }
  }
}

namespace {

/// Returns what span() says of where a ray enters, after a comparison with all crossings.
core::ShapeSpan<double> checked_entry(const TestRay& ray) {
  const auto shape = core::make_shape(ray.primitive);
  const core::ObjectRay object_ray{.origin = ray.origin, .direction = ray.direction};
  core::ShapeSpan<double> entry;
  shape->span(object_ray, {.enter = true, .leave = false}, entry);
  core::CrossingList found;
  const bool inside_before = shape->crossings(object_ray, found);
  if (entry.misses) REQUIRE(found.empty());
  if (entry.misses || entry.enter.known) REQUIRE_FALSE(inside_before);
  if (entry.enter.known) {
    REQUIRE(!found.empty());
    REQUIRE(found[0].t == entry.enter.t);
    REQUIRE(found[0].error == entry.enter.error);
    REQUIRE(found[0].face == core::FrustumShape::side_face);
  }
  return entry;
}

}  // namespace

TEST_CASE(
    "where a ray plainly enters a side, or misses the solid, is reported as all its crossings "
    "are") {
  for (const std::size_t kind : {cylinder_kind, cone_kind}) {
    std::uint64_t known = 0;
    std::uint64_t missed = 0;
    for (std::uint64_t i = 0; i < rays; ++i) {
      CAPTURE(kind);
      CAPTURE(i);
      const auto entry = checked_entry(make_ray(kind, i));
      known += entry.enter.known ? 1 : 0;
      missed += entry.misses ? 1 : 0;
    }
    CHECK(known > rays / 10);
    CHECK(missed > rays / 20);
  }
}

TEST_CASE(
    "a ray is not said to enter a cone from so far away that t does not tell where it leaves") {
  const Cone cone{.from = {0x1.459324afccdf7p+1, -0x1.58f98780a6457p+1, -0x1.2c146990db89dp+1},
                  .to = {0x1.5a36ae8421773p+1, -0x1.58f98780a6457p+1, -0x1.2c146990db89dp+1},
                  .radius = 0x1.ead260ced97ecp-20,
                  .radius2 = 0x1.0841905d7058dp-39};
  const TestRay ray{
      .primitive = cone,
      .origin = {0x1.24065a816a2b1p+32, 0x1.2c0b0b6dd69fcp+24, 0x1.f31c3c9519bcep+23},
      .direction = {-0x1.24065a7eb5c0ap+32, -0x1.2c0b0e1fc9aecp+24, -0x1.f31c41456b632p+23}};
  CHECK_FALSE(checked_entry(ray).enter.known);
}
