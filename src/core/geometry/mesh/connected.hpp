// What is connected, by a part or in one piece, is found from what is connected in pairs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace crt::core {

/// A Connected says which triangles are connected: each has the lowest number of those it is
/// connected with (Galler, Fischer, An improved equivalence algorithm, 1964).
class Connected {
 public:
  explicit Connected(std::size_t count) : above_(count) {
    std::iota(above_.begin(), above_.end(), 0u);
  }

  std::uint32_t lowest(std::uint32_t item) {
    while (above_[item] != item) item = above_[item] = above_[above_[item]];
    return item;
  }
  void connect(std::uint32_t one, std::uint32_t other) {
    one = lowest(one);
    other = lowest(other);
    above_[std::max(one, other)] = std::min(one, other);
  }

 private:
  std::vector<std::uint32_t> above_;
};

}  // namespace crt::core
