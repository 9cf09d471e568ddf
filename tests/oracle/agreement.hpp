// These functions ask one ray by every query: nearest hit, distance, whether anything is hit, all
// crossings; alone and among neighbours. Whatever the geometry decides, all answers must agree.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "crt/prepared_scene.hpp"
#include "crt/query.hpp"
#include "crt/settings.hpp"
#include "oracle/ray_maker.hpp"

namespace crt::test {

struct AgreementRecord {
  std::uint64_t rays = 0;
  std::uint64_t hits = 0;  ///< rays that meet anything
  std::uint64_t disagreements = 0;
  std::uint64_t digest = 0;  ///< of all answers: equal ones have equal bits, in whatever order
  std::vector<std::string> failures;  ///< the first of them, in full

  void add(const AgreementRecord& other);
};

/// Asks a scene whose entities are disjoint. Its answers about a ray must be these:
///  - crossings() is in order of t, within t_min < t < t_max, and enters and leaves by turns;
///  - intersect() is its first, or nothing if there is none, and occluded() says whether there is
///    one;
///  - a batch has the same bits as each of its rays alone, and distances() those of intersect().
void compare_queries(const PreparedScene& scene, const std::string& subject,
                     std::span<const Ray> rays, AgreementRecord& record);

/// The kinds of subjects are each primitive, by its place in the variant `Primitive`, CSG of two or
/// three solids, and crowds of disjoint solids.
inline constexpr std::size_t agreement_kinds = primitive_kinds + 2;
std::string name_of_agreement(std::size_t kind);

/// Compares queries of random subjects, each with some rays of every kind that there is, and with
/// parts of these rays that begin or end at a crossing. It uses all cores, and at least so many
/// rays.
AgreementRecord measure_agreement(std::size_t kind, Precision precision, std::uint64_t rays);

}  // namespace crt::test
