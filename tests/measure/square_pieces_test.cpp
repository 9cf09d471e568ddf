// Integrals over pieces of the square, which the volumes and areas of columns are made of.
#include "core/measure/square_pieces.hpp"

#include <doctest/doctest.h>

#include <vector>

using namespace crt;
using namespace crt::core;

namespace {

/// Returns 1.5 + 8 s + 3 s^2 + 9 s^2 t^2 + 5 s t^3 + 7 t^6, whose integral over the square is 18.
PatchSeries some_series() {
  PatchSeries a;
  a.terms[0] = 1.5;
  a.terms[PatchSeries::place(1, 0)] = 8;
  a.terms[PatchSeries::place(2, 0)] = 3;
  a.terms[PatchSeries::place(2, 2)] = 9;
  a.terms[PatchSeries::place(1, 3)] = 5;
  a.terms[PatchSeries::place(0, 6)] = 7;
  return a;
}

double integral_over(const std::vector<SquarePiece>& pieces) {
  double sum = 0;
  for (const SquarePiece& piece : pieces) sum += integral_of(some_series(), moments_of(piece));
  return sum;
}

}  // namespace

TEST_CASE("an integral over the square is that over its parts, and over its triangles") {
  CHECK(integral_over({SquarePiece{.part = {}, .is_whole = true}}) == doctest::Approx(18));

  std::vector<SquarePiece> quarters;
  for (const double s : {-0.5, 0.5})
    for (const double t : {-0.5, 0.5}) quarters.push_back({.part = {s, t, 0.5}, .is_whole = true});
  CHECK(integral_over(quarters) == doctest::Approx(18));

  std::vector<SquarePiece> pieces = {
      {.part = {}, .triangle = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0)}},
      {.part = {}, .triangle = {Vec3(-1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}}};
  CHECK(integral_over(pieces) == doctest::Approx(18));
  cut_pieces({0.25, {1, -0.5, 0}}, 1, pieces);
  cut_pieces({-0.125, {0.25, 1, 0}}, 2, pieces);
  CHECK(pieces.size() > 4);
  CHECK(integral_over(pieces) == doctest::Approx(18));
}

TEST_CASE("pieces say on which sides of the cuts they are") {
  std::vector<SquarePiece> pieces = {
      {.part = {}, .triangle = {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0)}}};
  const LinearFunction cut{0.25, {1, -0.5, 0}};
  cut_pieces(cut, 4, pieces);
  REQUIRE(pieces.size() >= 2);
  double area = 0;
  for (const SquarePiece& piece : pieces) {
    CHECK((cut.at(piece.middle()) < 0) == (piece.negative == 4));
    area += piece.area();
  }
  CHECK(area == doctest::Approx(2));
}
