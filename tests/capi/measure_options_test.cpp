// Options of measures through the C interface: what ends a search, centroids, and densities.
#include <cmath>
#include <cstddef>
#include <string>

#include "measured_parts.hpp"
#include "support.hpp"

using namespace crt::test;

TEST_CASE("the centroid is that of the mass properties") {
  const EntityHandle plate = box({0, 0, 0}, {5, 0.5, 4});
  crt_interval centroid[3];
  REQUIRE(crt_entity_centroid(plate.get(), 1e-6, 0, centroid) == CRT_OK);
  const double middle[3] = {2.5, 0.25, 2};
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(holds(centroid[axis], middle[axis]));
    CHECK(centroid[axis].upper - centroid[axis].lower <= 2.5e-6);
  }
}

TEST_CASE("a solid has the density of its material") {
  const EntityHandle plate = box({0, 0, 0}, {5, 0.5, 4});
  double density = -1;
  REQUIRE(crt_entity_density(plate.get(), &density) == CRT_OK);
  CHECK(density == 0);
  crt_material steel;
  crt_material_init(&steel, sizeof steel);
  CHECK(steel.density == 0);
  steel.density = 7850;
  crt_entity* made = nullptr;
  REQUIRE(crt_entity_with_material(plate.get(), &steel, &made) == CRT_OK);
  const EntityHandle heavy(made);
  CHECK(crt_entity_density(heavy.get(), &density) == CRT_OK);
  CHECK(density == 7850);
  // A program of an older version has a struct that ends before.
  crt_material older = steel;
  older.struct_size = offsetof(crt_material, density);
  REQUIRE(crt_entity_with_material(plate.get(), &older, &made) == CRT_OK);
  const EntityHandle light(made);
  CHECK(crt_entity_density(light.get(), &density) == CRT_OK);
  CHECK(density == 0);
  crt_entity* const parts[2] = {heavy.get(), light.get()};
  REQUIRE(crt_union_create(parts, 2, &made) == CRT_OK);
  const EntityHandle both(made);
  CHECK(crt_entity_density(both.get(), &density) == CRT_ERROR_INVALID_ARGUMENT);
  CHECK(says("different densities"));
}

namespace {

/// Counts how often it is asked, and says no from a number on.
struct Asked {
  int count = 0;
  int last = 0;
};

int ask(void* user) {
  auto* const asked = static_cast<Asked*>(user);
  return ++asked->count >= asked->last ? 42 : 0;
}

}  // namespace

TEST_CASE("searches end when their time is over, with what is known then") {
  const EntityHandle part = half_torus();
  crt_measure_options how;
  crt_measure_options_init(&how, sizeof how);
  how.seconds = 1e-9;
  const double up[3] = {0, 1, 0};
  crt_section* section = nullptr;
  REQUIRE(crt_section_create_with(part.get(), up, 0.3, 1e-6, &how, &section) == CRT_OK);
  double deviation = 0;
  CHECK(crt_section_deviation(section, &deviation) == CRT_OK);
  CHECK(deviation > 1e-6);
  crt_section_release(section);
  crt_surface_mesh* surface = nullptr;
  REQUIRE(crt_entity_tessellate_with(part.get(), 1e-3, &how, &surface) == CRT_OK);
  CHECK(std::isinf(crt_surface_mesh_deviation(surface)));
  crt_surface_mesh_release(surface);
  const EntityHandle ball = sphere({0, 9, 0}, 1);
  crt_interval found;
  double place[3];
  REQUIRE(crt_entity_clearance_with(part.get(), ball.get(), &how, &found, place, place) == CRT_OK);
  CHECK(found.upper - found.lower > 1e-2);
  REQUIRE(crt_entity_thickness_with(part.get(), &how, &found, place, place) == CRT_OK);
  CHECK(found.lower < 0.4);
}

TEST_CASE("options without a time or a width are those of the plain functions") {
  const EntityHandle part = half_torus();
  crt_measure_options how;
  crt_measure_options_init(&how, sizeof how);
  how.threads = 1;
  const double point[3] = {9, 1, 2};
  double distance = 0;
  double plain = 1;
  REQUIRE(crt_entity_distance(part.get(), point, 0, 1, &plain, nullptr, 0) == CRT_OK);
  REQUIRE(crt_entity_distance_with(part.get(), &how, point, 0, 1, &distance, nullptr, 0) == CRT_OK);
  CHECK(distance == plain);
  how.relative_width = 0.1;
  REQUIRE(crt_entity_distance_with(part.get(), &how, point, 0, 1, &distance, nullptr, 0) == CRT_OK);
  CHECK(distance >= plain);
  const EntityHandle plate = box({0, 0, 0}, {5, 0.5, 4});
  crt_interval of_options;
  crt_interval least;
  double place[3];
  REQUIRE(crt_entity_thickness(plate.get(), 0.01, &least, place, place) == CRT_OK);
  REQUIRE(crt_entity_thickness_with(plate.get(), nullptr, &of_options, place, place) == CRT_OK);
  CHECK(of_options.lower == least.lower);
  CHECK(of_options.upper == least.upper);
}

TEST_CASE("a callback cancels searches, and its number is kept") {
  const EntityHandle part = half_torus();
  const EntityHandle ball = sphere({0, 9, 0}, 1);
  Asked asked;
  crt_measure_options how;
  crt_measure_options_init(&how, sizeof how);
  how.poll = ask;
  how.poll_user = &asked;
  const double up[3] = {0, 1, 0};
  crt_section* section = nullptr;
  crt_surface_mesh* surface = nullptr;
  crt_interval found;
  double place[3];
  const auto is_cancelled = [&](crt_status status) {
    CHECK(status == CRT_ERROR_CANCELLED);
    CHECK(crt_cancel_value() == 42);
    CHECK(asked.count > 0);
    asked = {};
  };
  is_cancelled(crt_section_create_with(part.get(), up, 0.3, 1e-6, &how, &section));
  is_cancelled(crt_entity_tessellate_with(part.get(), 1e-3, &how, &surface));
  is_cancelled(crt_entity_clearance_with(part.get(), ball.get(), &how, &found, place, place));
  is_cancelled(crt_entity_thickness_with(part.get(), &how, &found, place, place));
  is_cancelled(crt_entity_distance_with(part.get(), &how, up, 0, 1, place, nullptr, 0));
  CHECK(section == nullptr);
  CHECK(surface == nullptr);
}
