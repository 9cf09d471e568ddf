// These functions say how far two pictures differ, in the 8-bit values that a file holds.
#pragma once

#include <crt/image.hpp>
#include <cstdint>
#include <vector>

namespace crt::tests {

struct Difference {
  bool same_size = false;
  /// This is the root of the mean square of the channels' differences, in 8-bit steps.
  double rmse = 0;
  /// This is the share of the pixels with a channel that differs by more than `visible_step`.
  double share_of_visible = 0;

  static constexpr int visible_step = 8;
};

Difference compare(const Image& picture, const Image& reference);

/// Makes a picture of where two pictures of one size differ. It is black where they agree, and
/// eight times the difference elsewhere.
Image difference_picture(const Image& picture, const Image& reference);

}  // namespace crt::tests
