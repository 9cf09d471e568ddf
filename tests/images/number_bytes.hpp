// Collects numbers as bytes, whose hash tells whether two runs gave the same.
#pragma once

#include <bit>
#include <crt/measure.hpp>
#include <crt/query.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/sha256.hpp"

namespace crt::tests {

/// A NumberBytes is a list of numbers that is asked for its hash.
class NumberBytes {
 public:
  void add(double x) { add_word(std::bit_cast<std::uint64_t>(x)); }
  void add(const Vec3& v) {
    for (const double x : {v.x, v.y, v.z}) add(x);
  }
  void add(const Interval& interval) {
    add(interval.lower);
    add(interval.upper);
  }
  void add(const Hit& hit) {
    add(hit.t);
    add(hit.position);
    add(hit.normal);
    add(hit.u);
    add(hit.v);
    add_word(2 * std::uint64_t{hit.entity_id} + (hit.entering ? 1 : 0));
  }
  void add_word(std::uint64_t word) {
    for (int shift = 0; shift < 64; shift += 8)
      bytes_.push_back(static_cast<std::byte>(word >> shift & 0xffu));
  }
  std::string hash() const { return core::sha256(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace crt::tests
