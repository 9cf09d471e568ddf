// These are rays that the oracle found to be answered wrong, by name.
#include <doctest/doctest.h>

#include "oracle/measure.hpp"
#include "oracle/prepared_tree.hpp"

using namespace crt;
using namespace crt::test;

namespace {

/// Says whether the ray's answer is right, and within its bound.
bool holds(const Primitive& primitive, const Vec3& origin, const Vec3& direction,
           const Contestant& tier = standard_tier()) {
  Record record;
  return measure(truth_of({.primitive = primitive, .origin = origin, .direction = direction}), tier,
                 0, record);
}

}  // namespace

TEST_CASE("a plane seen from afar at a grazing angle is met where it is") {
  const Plane plane{
      .normal = {0x1.4bb8389b04732p-1, 0x1.84ed32eaf6d2ep+0, 0x1.8e92be912bbc9p-1},
      .position = {0x1.1fdac6d7c3d49p+8, -0x1.376fdaa9e5289p+10, -0x1.38655ebc3fbbcp+9}};
  CHECK(holds(plane, {-0x1.603a5289347bdp+38, 0x1.bfc77a65ee94ap+38, -0x1.225e21a165416p+39},
              {0x1.603a528db440dp+38, -0x1.bfc77a7965b22p+38, 0x1.225e219c83a59p+39}));
}

TEST_CASE(
    "a line that is parallel to a cylinder's caps to rounding passes beyond them or between them") {
  const Cylinder beyond{
      .from = {-0x1.6caa3f4779539p-3, -0x1.59fa5946585c7p-3, 0x1.ad93919a2882ep-6},
      .to = {0x1.beccf05c88723p+11, -0x1.5941c4da1e7cp+12, -0x1.9e2c484555c55p+10},
      .radius = 0x1.9c442d0ba4135p+12};
  CHECK(holds(beyond, {0x1.33a64ee273487p+45, 0x1.38f5f350233c8p+45, -0x1.7bb382d8e338bp+45},
              {-0x1.33a64ee277bd7p+45, -0x1.38f5f34ff3bccp+45, 0x1.7bb382d849fd3p+45}));
  const Cylinder between{
      .from = {0x1.8c8f71f3563d3p+7, -0x1.0b5529a925bd9p+8, 0x1.19b71bf6decdp+6},
      .to = {0x1.4fc762129fcbcp+17, -0x1.d73fdac1dcac1p+17, 0x1.7af67850778b1p+17},
      .radius = 0x1.d838442abbd62p+17};
  CHECK(holds(between, {0x1.7ce05c90532d5p+31, 0x1.1366c6e4efab6p+32, 0x1.5b389886402fp+31},
              {-0x1.7ce11c9de4d9cp+31, -0x1.1365d58e5e382p+32, -0x1.5b350250019e4p+31}));
}

TEST_CASE("a cone is left where it is by a line nearly along its axis") {
  const Cone cone{.from = {-0x1.065ff98ccb147p+24, -0x1.d32557d311218p+22, -0x1.46b9557835d09p+24},
                  .to = {-0x1.05ed83d6d95eep+24, -0x1.d69ca4c6600c2p+22, -0x1.46a3e02c8b136p+24},
                  .radius = 0x1.daf5d664aa4e7p+16};
  CHECK(holds(cone, {-0x1.866bb09416ba2p+38, 0x1.7a4d5224a98ddp+39, -0x1.24d787939f8f6p+36},
              {0x1.8667982ec3644p+38, -0x1.7a4e3bd12c20dp+39, 0x1.24c31ea423e91p+36}));
}

TEST_CASE("a cone's apex is met from afar no worse than the rest of it") {
  const Cone cone{.from = {0x1.96840205468b8p-28, -0x1.4943ac4cfdd95p-25, -0x1.fe43d86889c07p-23},
                  .to = {0x1.03791fe4435a6p+21, -0x1.052252ce08a68p+23, 0x1.5905d4c4bd655p+22},
                  .radius = 0x1.02d7fa8354e51p+25};
  CHECK(holds(cone, {0x1.03791fe4435a6p+21, -0x1.052252ce08a68p+23, 0x1.2204568a72bdap+41},
              {0, 0, -1}));
}

TEST_CASE("a cone is met where it is by a line that grazes it next to a ruling") {
  const Cone cone{.from = {-0x1.db94b90343c75p-6, 0, 0},
                  .to = {0x1.5a353b94e2f65p+10, -0x1.19358edd08722p+14, 0x1.d8bc64adf9c7ep+11},
                  .radius = 0x1.48e8186279c44p+14,
                  .radius2 = 0x1.25d18c671d123p+13};
  CHECK(holds(cone, {0x1.4d0a6e95d27e6p+26, -0x1.bd0e51c47431dp+26, 0x1.a2dc59bfeeabep+25},
              {-0x1.4d12d46a6bb59p+26, 0x1.bcfd0c06f7469p+26, -0x1.a2dcad20945f3p+25}));
}

TEST_CASE("a line that is parallel to a cylinder's axis to rounding stays within it") {
  const Cylinder cylinder{
      .from = {-0x1.3931771d9440fp+29, 0, 0},
      .to = {-0x1.3931771d9440fp+29, 0x1.1947de971bcecp-28, -0x1.35b4f3084aff7p-27},
      .radius = 0x1.26cdda7f2b8e4p-24};
  CHECK(holds(cylinder, {-0x1.3931771d9440fp+29, -0x1.503ca3af0151cp-8, 0x1.7238e43b1be3bp-7},
              {0, 0x1.503d9ee226e76p-8, -0x1.723895265c9aap-7}));
}

TEST_CASE("a triangle is not hit by lines in its plane but for rounding that pass it") {
  const Triangle triangle{
      .a = {-0x1.2be50114a5ebap-14, -0x1.43dd991aa04bbp-13, -0x1.9f87fc576b2bbp-3},
      .b = {-0x1.e2057cc9b1febp-15, -0x1.37ed19504e16p-13, -0x1.9f9f132dadf0fp-3},
      .c = {-0x1.81c8bf1a62da1p-14, -0x1.3956d94c506dep-14, -0x1.9f6b3fce8b3c4p-3}};
  CHECK(holds(triangle, {-0x1.bb8ef40a8a274p-12, -0x1.d6efa755989bp-13, -0x1.9d863451b8d58p-3},
              {0x1.4a35762203f2bp-12, 0x1.0bd0f6a48f4d8p-13, -0x1.02f599f2b678p-10}));
}

TEST_CASE("a solid is met where it is, though the ray grazes another one there") {
  // The ball is met some 1e-8 before and after the box's face, with an error as long in the
  // standard tier. Such an error joins nothing.
  const Box box{.corner_a = {0, 0, 0}, .corner_b = {1, 1, 1}};
  const Sphere ball{.center = {1, 1.5, 0.5}, .radius = 1 + 0x1p-52};
  const GridRay ray{{3, 0.5, 0.5}, {-1, 0, 0}};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    const FoundFlips joined = PreparedTree(Entity(box) + Entity(ball), precision).flips(ray);
    const FoundFlips cut = PreparedTree(Entity(box) - Entity(ball), precision).flips(ray);
    REQUIRE(joined.flips.size() == 2);
    REQUIRE(cut.flips.size() == 2);
    CHECK(joined.flips[1] == FoundFlip{3, false});
    CHECK(cut.flips[1] == FoundFlip{3, false});
    const double before = joined.flips.front().t;
    const double after = cut.flips.front().t;
    CHECK(before < 2);
    CHECK(after > 2);
    CHECK(after - before < 1e-7);
  }
}

TEST_CASE("a solid that is cut off where it is grazed ends where the cut is") {
  // The ray goes along the outside of a torus, to where a box begins that is taken away.
  const Torus torus{.center = {1, 0, -1}, .axis = {0, -1, 0}, .radius = 1, .thickness = 1};
  const Box box{.corner_a = {1, 0, -1}, .corner_b = {2, 2, 2}};
  const GridRay ray{{-0x1.d116ba8835b24p+0, -0x1.d6733410226a9p+2, 0x1.f3d7f61a347bp-1},
                    {0x1.688b5d441ad92p+1, 0x1.d6733410226a9p+2, 0x1.85013cb970ap-6}};
  for (const Precision precision : {Precision::standard, Precision::exact}) {
    PreparedTree cut(Entity(torus) - Entity(box), precision);
    const FoundFlips found = cut.flips(ray);
    REQUIRE(found.flips.size() == 2);
    CHECK(found.flips[1] == FoundFlip{1, false});
  }
}

TEST_CASE(
    "the exact tier's error of t is a bound next to a torus's axis and to a cylinder's side") {
  constexpr std::size_t cylinder = 4;
  constexpr std::size_t torus = 6;
  const auto holds_in_exact = [](const TestRay& ray) {
    Record record;
    return measure(truth_of(ray), exact_tier(), 0, record);
  };
  for (const std::uint64_t number :
       {62329u, 340228u, 149863u, 412005u, 543009u, 760698u, 809610u}) {
    CAPTURE(number);
    CHECK(holds_in_exact(make_placed_ray(torus, number)));
  }
  CHECK(holds_in_exact(make_ray(cylinder, 310949)));
  // The ray goes along a ruling. Its two crossings differ by 10^-19 of their distance.
  const Cylinder thin{.from = {0, 0x1.26b9df30b744bp-30, 0},
                      .to = {-0x1.00918e1e567bep-4, 0x1.26b9df30b744bp-30, 0},
                      .radius = 0x1.188317422dafep-20};
  CHECK(holds(thin, {0x1.08003996da349p+19, 0x1.18ccc5b9f9ddbp-20, -0x1.022376d7ce3c7p+15},
              {-0x1.08003996da349p+19, 0, 0x1.022376d7ce3c7p+15}, exact_tier()));
}

TEST_CASE(
    "a triangle is met where it is by a line that is parallel to it but for the rounding of its "
    "normal") {
  constexpr std::size_t triangle = 8;
  Record record;
  CHECK(measure(truth_of(make_ray(triangle, 7088570)), standard_tier(), 0, record));
}

TEST_CASE(
    "a cylinder's cap may be taken for its side where the rounding of t does not distinguish "
    "them") {
  const Cylinder cylinder{
      .from = {0x1.4bce3ea3b8262p-12, 0x1.99e8bf6b2eb07p-12, -0x1.7c26bea915e2fp-12},
      .to = {0x1.4bce3ea3b8262p-12, 0x1.6c8e9f9455c1ep-3, -0x1.7c26bea915e2fp-12},
      .radius = 0x1.00d45c83a28c6p-2};
  CHECK(holds(cylinder, {-0x1.312d87400acfap+4, -0x1.38e3c3577ebfep+4, 0x1.878b5df4bfe95p+4},
              {0x1.2d44abe171883p+4, 0x1.38e55d403e2b1p+4, -0x1.886ed7c68771dp+4}));
}

TEST_CASE("a cone is left beside its apex where it is") {
  const Cone cone{.from = {0x1.2ba9809a7ae84p+22, 0x1.a63de6498b22bp+23, -0x1.19371acd756dap+21},
                  .to = {0x1.2ba9809a7ae85p+22, 0x1.a63de6498b22bp+23, -0x1.19371acd756d9p+21},
                  .radius = 0x1.51bbd2af5ffc3p-30,
                  .radius2 = 0};
  CHECK(holds(cone, {0x1.2ba9805bc679bp+22, 0x1.a63de67aa2f22p+23, -0x1.19371b627fe32p+21},
              {0x1.d04b12657cd4ap-2, -0x1.6b8171170c82bp-1, 0x1.13e3fba30ea81p-1}));
}

TEST_CASE("a line that all but meets a torus's axis goes through the tube twice") {
  const Torus across{
      .center = {0x1.b3773a43904dp+26, 0x1.641cab9adcdb9p+26, -0x1.61167a65298a7p+22},
      .axis = {-0x1.f7a53756b2484p+0, 0, 0},
      .radius = 0x1.431c20a64ce88p-28,
      .thickness = 0x1.f2f8830c7fda4p-30};
  const Torus horn{.center = {-0x1.a2d4fd3a6caaep+21, 0x1.8ccaa9ed76f3fp+24, 0x1.0db27d6e1b63ap+22},
                   .axis = {0, 0, 0x1.1f519e8d70736p-1},
                   .radius = 0x1.0ef208bdc373dp-28,
                   .thickness = 0x1.0ef208bdc373dp-28};
  for (const Contestant& tier : {standard_tier(), exact_tier()}) {
    CAPTURE(tier.name);
    CHECK(holds(across, {0x1.b3773a43904dp+26, 0x1.641cab9adcdb9p+26, -0x1.61167a65298a8p+22},
                {-0x1.c25204b98c0ccp-792, -0x1.686d00c449945p-808, -0x1.833e8457c8c66p+0}, tier));
    CHECK(holds(horn, {-0x1.a2d4fd3a6caaep+21, 0x1.8ccaa9ed76f3fp+24, 0x1.0db27d6e1b639p+22},
                {-0x1.0b390e1f346bfp-905, 0x1.cb244eab1f074p+0, 0x1.0718eff968b57p+0}, tier));
    for (const double passing : {0.0, 1e-300, 1e-200, 1e-160, 1e-150, 1e-100, 1e-30, 1e-10}) {
      CAPTURE(passing);
      CHECK(holds(Torus{.axis = {0, 0, 1}, .radius = 2, .thickness = 0.5}, {passing, -5, 0},
                  {0, 1, 0}, tier));
      CHECK(holds(Torus{.axis = {0, 0, 1}, .radius = 2, .thickness = 0.5}, {0, -5, 0},
                  {passing, 1, 0}, tier));
    }
  }
}
