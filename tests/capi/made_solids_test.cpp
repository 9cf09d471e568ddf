// Wrong arguments of solids that are made of others are refused, and nothing is written.
#include "wrong_arguments.hpp"

using namespace crt::test;

TEST_CASE("wrong arguments of sweeps, tubes, threads, polyhedra and hulls have their names") {
  crt_entity* entity = nullptr;
  const double* const z = zero.data();
  const double* const o = one.data();
  const ProfileHandle square = square_profile();
  const double two[6] = {0, 0, 0, 0, 0, 1};
  const double four[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const std::uint32_t all[12] = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 2, 3};
  const std::uint32_t of_3[4] = {3, 3, 3, 3};
  const std::uint32_t too_many[1] = {2000};

  check_all({
      {"profile", [&] { return crt_sweep_create(nullptr, two, 2, 0, o, 0, &entity); }},
      {"path", [&] { return crt_sweep_create(square.get(), nullptr, 2, 0, o, 0, &entity); }},
      {"path", [&] { return crt_sweep_create(square.get(), two, 1, 0, o, 0, &entity); }},
      {"path", [&] { return crt_sweep_create(square.get(), two, 2, 0, o, 1, &entity); }},
      {"bend", [&] { return crt_sweep_create(square.get(), two, 2, -1, o, 0, &entity); }},
      {"up", [&] { return crt_sweep_create(square.get(), two, 2, 0, nullptr, 0, &entity); }},
      {"up", [&] { return crt_sweep_create(square.get(), two, 2, 0, z, 0, &entity); }},
      {"out", [&] { return crt_sweep_create(square.get(), two, 2, 0, o, 0, nullptr); }},
      {"path", [&] { return crt_tube_create(nullptr, two, 2, 0, 0, 0, &entity); }},
      {"path", [&] { return crt_tube_create(two, two, 0, 0, 0, 0, &entity); }},
      {"radii", [&] { return crt_tube_create(two, nullptr, 2, 0, 0, 0, &entity); }},
      {"radii", [&] { return crt_tube_create(two, z, 2, 0, 0, 0, &entity); }},
      {"deviation", [&] { return crt_tube_create(two, o, 2, 1, 0, -1, &entity); }},
      {"out", [&] { return crt_tube_create(two, o, 2, 0, 0, 0, nullptr); }},
      {"points", [&] { return crt_polyhedron_create(nullptr, 4, all, of_3, 4, &entity); }},
      {"corners", [&] { return crt_polyhedron_create(four, 4, nullptr, of_3, 4, &entity); }},
      {"sizes", [&] { return crt_polyhedron_create(four, 4, all, nullptr, 4, &entity); }},
      {"sizes", [&] { return crt_polyhedron_create(four, 4, all, too_many, 1, &entity); }},
      {"faces", [&] { return crt_polyhedron_create(four, 4, all, of_3, 3, &entity); }},
      {"faces", [&] { return crt_polyhedron_create(four, 3, all, of_3, 4, &entity); }},
      {"faces", [&] { return crt_polyhedron_create(four, 4, all, of_3, 0, &entity); }},
      {"out", [&] { return crt_polyhedron_create(four, 4, all, of_3, 4, nullptr); }},
      {"points", [&] { return crt_hull_create(nullptr, 4, &entity); }},
      {"points", [&] { return crt_hull_create(four, 3, &entity); }},
      {"out", [&] { return crt_hull_create(four, 4, nullptr); }},
      {"profile", [&] { return crt_shaped_extrusion_create(nullptr, 1, 0, 1, 0, 0, &entity); }},
      {"height", [&] { return crt_shaped_extrusion_create(square.get(), 0, 0, 1, 0, 0, &entity); }},
      {"twist",
       [&] { return crt_shaped_extrusion_create(square.get(), 1, 7e3, 1, 0, 0, &entity); }},
      {"taper", [&] { return crt_shaped_extrusion_create(square.get(), 1, 0, 0, 0, 0, &entity); }},
      {"bevel",
       [&] { return crt_shaped_extrusion_create(square.get(), 1, 0, 1, 0.6, 0, &entity); }},
      {"rounding",
       [&] { return crt_shaped_extrusion_create(square.get(), 1, 0, 1, 0.1, 0.1, &entity); }},
      {"out", [&] { return crt_shaped_extrusion_create(square.get(), 1, 0, 1, 0, 0, nullptr); }},
      {"from", [&] { return crt_helix_create(nullptr, o, 8, 1, 3, 0, &entity); }},
      {"to", [&] { return crt_helix_create(o, o, 8, 1, 3, 0, &entity); }},
      {"thickness", [&] { return crt_helix_create(z, o, 8, 8, 30, 0, &entity); }},
      {"pitch", [&] { return crt_helix_create(z, o, 8, 1, 2, 0, &entity); }},
      {"out", [&] { return crt_helix_create(z, o, 8, 1, 3, 0, nullptr); }},
      {"from", [&] { return crt_thread_create(nullptr, o, 8, 1, 0, &entity); }},
      {"to", [&] { return crt_thread_create(o, o, 8, 1, 0, &entity); }},
      {"pitch", [&] { return crt_thread_create(z, o, 8, 8, 0, &entity); }},
      {"pitch", [&] { return crt_thread_create(z, o, 8, 1e-5, 0, &entity); }},
      {"out", [&] { return crt_thread_create(z, o, 8, 1, 0, nullptr); }},
  });
  CHECK(entity == nullptr);
}
