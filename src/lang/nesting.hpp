// This counts what is open while a text is parsed.
#pragma once

#include <utility>

namespace crt::lang {

/// A Nesting is one open bracket, block or prefix operator. It lives on the parser's own stack, so
/// that the count stays right when a syntax error makes the parser drop what was open.
class Nesting {
 public:
  Nesting() = default;
  explicit Nesting(int& depth) : depth_(&depth) { ++depth; }
  Nesting(Nesting&& other) noexcept : depth_(std::exchange(other.depth_, nullptr)) {}
  Nesting& operator=(Nesting&& other) noexcept {
    std::swap(depth_, other.depth_);
    return *this;
  }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;
  ~Nesting() {
    if (depth_) --*depth_;
  }

 private:
  int* depth_ = nullptr;
};

}  // namespace crt::lang
