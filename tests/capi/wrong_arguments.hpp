// Tests of wrong arguments share these calls.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support.hpp"

namespace crt::test {

/// A Wrong is one call with one thing wrong, and the name that the message must have.
struct Wrong {
  std::string argument;
  std::function<crt_status()> call;
};

inline void check_all(const std::vector<Wrong>& calls) {
  for (const Wrong& wrong : calls) {
    INFO(wrong.argument);
    CHECK(wrong.call() == CRT_ERROR_INVALID_ARGUMENT);
    INFO(message());
    CHECK(says(wrong.argument));
  }
}

inline const Numbers zero = {0, 0, 0};
inline const Numbers one = {1, 1, 1};
inline const Numbers up = {0, 1, 0};

inline ProfileHandle square_profile() {
  ProfileHandle profile = new_profile();
  CHECK(crt_profile_move_to(profile.get(), 0, 0) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 1, 0) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 1, 1) == CRT_OK);
  CHECK(crt_profile_line_to(profile.get(), 0, 1) == CRT_OK);
  return profile;
}

/// Returns the indices of the only triangle of a mesh.
inline const std::uint32_t* triangle_indices() {
  static constexpr std::uint32_t indices[] = {0, 1, 2};
  return indices;
}

}  // namespace crt::test
