// A C program adds a solid of its own: a ball, here, that knows how often it is asked.
#include <array>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "support.hpp"

using namespace crt::test;

namespace {

struct Ball {
  double radius = 1;
  std::atomic<int> asked{0};
  std::atomic<int> released{0};
  int answer = 0;              ///< of the functions
  std::size_t shells = 1;      ///< so many balls, one around the other
  std::size_t more_later = 0;  ///< crossings beyond those that were said first
};

int ball_crossings(const crt_ray* ray, crt_custom_crossing* crossings, std::size_t capacity,
                   std::size_t* count, void* user) {
  auto& ball = *static_cast<Ball*>(user);
  const int asked = ball.asked++;
  if (ball.answer != 0) return ball.answer;
  double middle = 0;
  double square = 0;
  for (int i = 0; i < 3; ++i) middle -= ray->origin[i] * ray->direction[i];
  for (int i = 0; i < 3; ++i) {
    const double nearest = ray->origin[i] + middle * ray->direction[i];
    square += nearest * nearest;
  }
  std::vector<double> found;
  for (std::size_t shell = 0; shell < 2 * ball.shells - 1; ++shell) {
    const double radius =
        ball.radius * (1 - static_cast<double>(shell) / static_cast<double>(2 * ball.shells));
    if (radius * radius <= square) break;
    const double half = std::sqrt(radius * radius - square);
    found.insert(found.begin() + static_cast<std::ptrdiff_t>(found.size() / 2),
                 {middle - half, middle + half});
  }
  *count = found.size() + (asked > 0 ? ball.more_later : 0);
  for (std::size_t i = 0; i < std::min(found.size(), capacity); ++i) {
    crossings[i] = {found[i], 1e-15, 0, 0};
  }
  return 0;
}

int ball_point(const double position[3], std::uint32_t face, crt_custom_point* point, void* user) {
  CHECK(face == 0);
  for (int i = 0; i < 3; ++i) point->normal[i] = position[i];
  point->u = 0.25;
  point->v = 0.5;
  return static_cast<Ball*>(user)->answer;
}

void release_ball(void* user) {
  ++static_cast<Ball*>(user)->released;
}

crt_custom custom_of(Ball& ball) {
  crt_custom custom;
  REQUIRE(crt_custom_init(&custom, sizeof custom) == CRT_OK);
  CHECK(custom.face_count == 1);
  for (int i = 0; i < 3; ++i) {
    custom.lower[i] = -ball.radius;
    custom.upper[i] = ball.radius;
  }
  custom.crossings = ball_crossings;
  custom.point = ball_point;
  custom.release = release_ball;
  custom.user = &ball;
  custom.name = "our ball";
  return custom;
}

EntityHandle entity_of(const crt_custom& custom) {
  return made<EntityHandle>([&](crt_entity** out) { return crt_custom_create(&custom, out); });
}

PreparedHandle prepared_of(crt_entity* entity) {
  const SceneHandle scene = new_scene();
  REQUIRE(crt_scene_add_entity(scene.get(), entity) == CRT_OK);
  return prepare(scene.get());
}

constexpr crt_ray along_z = {{0, 0, -5}, {0, 0, 2}, 0, infinity};

}  // namespace

TEST_CASE("a ball of the program's own is met, cut and placed as a sphere is") {
  Ball ball;
  {
    const EntityHandle entity = entity_of(custom_of(ball));
    CHECK(crt_entity_is_solid(entity.get()) == 1);
    const PreparedHandle prepared = prepared_of(entity.get());
    crt_hit hit;
    REQUIRE(crt_intersect(prepared.get(), &along_z, 0, 1, &hit, 0) == CRT_OK);
    CHECK(hit.t == 2);
    CHECK(hit.normal[2] == -1);
    CHECK(hit.u == 0.25);
    CHECK(hit.v == 0.5);
    CHECK(hit.flags == CRT_HIT_ENTERING);
    crt_ray beside = along_z;
    beside.origin[0] = 1.5;
    const int asked = ball.asked;
    REQUIRE(crt_intersect(prepared.get(), &beside, 0, 1, &hit, 0) == CRT_OK);
    CHECK(hit.t == infinity);
    CHECK(ball.asked == asked);

    const EntityHandle cutter = box({-2, -2, -2}, {2, 2, 0.5});
    const EntityHandle cap = difference(entity.get(), cutter.get());
    const double affine[12] = {3, 0, 0, 0, 0, 3, 0, 0, 0, 0, 3, 1};
    const EntityHandle placed = made<EntityHandle>(
        [&](crt_entity** out) { return crt_entity_with_transform(cap.get(), affine, out); });
    const PreparedHandle cut = prepared_of(placed.get());
    std::array<crt_hit, 4> hits = {};
    std::size_t count = 0;
    REQUIRE(crt_crossings(cut.get(), &along_z, hits.data(), hits.size(), &count) == CRT_OK);
    REQUIRE(count == 2);
    CHECK(hits[0].t == doctest::Approx(3.75));
    CHECK(hits[1].t == doctest::Approx(4.5));
    CHECK(ball.released == 0);
  }
  CHECK(ball.released == 1);
}

TEST_CASE("a picture shows a ball of the program's own where a sphere would be") {
  Ball ball;
  const auto picture = [](crt_entity* entity) {
    const SceneHandle scene = small_scene(48, 48);
    REQUIRE(crt_scene_add_entity(scene.get(), entity) == CRT_OK);
    const PreparedHandle prepared = prepare(scene.get());
    const ImageHandle image = render(prepared.get());
    const float* const pixels = crt_image_pixels(image.get(), nullptr);
    return std::vector<float>(pixels, pixels + 4 * 48 * 48);
  };
  const EntityHandle ours = entity_of(custom_of(ball));
  const double affine[12] = {0.3, 0, 0, 0.1, 0, 0.3, 0, -0.2, 0, 0, 0.3, 1.2};
  const EntityHandle placed = made<EntityHandle>(
      [&](crt_entity** out) { return crt_entity_with_transform(ours.get(), affine, out); });
  const std::vector<float> one = picture(placed.get());
  const std::vector<float> other = picture(sphere({0.1, -0.2, 1.2}, 0.3).get());
  int differing = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (std::abs(one[i] - other[i]) > 1e-4F) ++differing;
  }
  CHECK(differing <= 4);
  CHECK(ball.asked > 100);
}

TEST_CASE("more crossings than the library had place for are asked for again") {
  Ball ball;
  ball.shells = 40;
  const EntityHandle entity = entity_of(custom_of(ball));
  const PreparedHandle prepared = prepared_of(entity.get());
  std::vector<crt_hit> hits(200);
  std::size_t count = 0;
  ball.asked = 0;
  REQUIRE(crt_crossings(prepared.get(), &along_z, hits.data(), hits.size(), &count) == CRT_OK);
  REQUIRE(count == 158);
  CHECK(ball.asked.load() == 2);
  CHECK(hits[157].t == 3);

  ball.asked = 0;
  ball.more_later = 2;
  CHECK(crt_crossings(prepared.get(), &along_z, hits.data(), hits.size(), &count) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(message() == "our ball: there cannot be 160 crossings");
  ball.more_later = 0;
  ball.shells = 40000;
  CHECK(crt_crossings(prepared.get(), &along_z, hits.data(), hits.size(), &count) ==
        CRT_ERROR_INVALID_ARGUMENT);
  CHECK(message() == "our ball: there cannot be 159998 crossings");
}

TEST_CASE("a function that returns a number ends the call, which hands that number back") {
  Ball ball;
  const EntityHandle entity = entity_of(custom_of(ball));
  const PreparedHandle prepared = prepared_of(entity.get());
  ball.answer = 7;
  crt_hit hit;
  CHECK(crt_intersect(prepared.get(), &along_z, 0, 1, &hit, 0) == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == 7);
  ball.answer = -3;
  crt_image* image = nullptr;
  CHECK(crt_render(prepared.get(), nullptr, &image) == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == -3);
  crt_job* started = nullptr;
  REQUIRE(crt_render_start(prepared.get(), nullptr, &started) == CRT_OK);
  const JobHandle job(started);
  CHECK(crt_job_wait(job.get(), &image) == CRT_ERROR_CANCELLED);
  CHECK(crt_cancel_value() == -3);
  CHECK(image == nullptr);
}

TEST_CASE("what cannot be a solid is refused, and nothing is released that was not taken") {
  Ball ball;
  crt_entity* out = nullptr;
  const auto fault = [&](const auto& change) {
    crt_custom custom = custom_of(ball);
    change(custom);
    CHECK(crt_custom_create(&custom, &out) == CRT_ERROR_INVALID_ARGUMENT);
    return message();
  };
  CHECK(fault([](crt_custom& c) { c.crossings = nullptr; }) == "crossings must not be NULL");
  CHECK(fault([](crt_custom& c) { c.point = nullptr; }) == "point must not be NULL");
  CHECK(fault([](crt_custom& c) { c.struct_size = 0; }).find("custom") == 0);
  CHECK(fault([](crt_custom& c) { c.lower[1] = not_a_number; }).find("our ball: bounds must") == 0);
  CHECK(fault([](crt_custom& c) { c.upper[2] = -1; }).find("our ball: upper bounds must") == 0);
  CHECK(fault([](crt_custom& c) { c.face_count = 0; }).find("our ball: there must be 1") == 0);
  CHECK(fault([](crt_custom& c) {
          c.name = nullptr;
          c.face_count = 65537;
        }).find("a custom shape: there must be 1") == 0);
  CHECK(out == nullptr);
  CHECK(ball.released == 0);
}
