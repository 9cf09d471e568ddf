#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

namespace crt::test {

/// Few is a short list that allocates nothing itself.
template <class T, std::size_t capacity>
class Few {
 public:
  Few() = default;
  Few(std::initializer_list<T> items) {
    for (const T& item : items) push_back(item);
  }

  void push_back(T item) {
    assert(size_ < capacity);
    items_[size_++] = std::move(item);
  }
  void pop_back() { --size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T& operator[](std::size_t i) { return items_[i]; }
  const T& operator[](std::size_t i) const { return items_[i]; }
  T& back() { return items_[size_ - 1]; }
  const T& back() const { return items_[size_ - 1]; }
  T* begin() { return items_.data(); }
  T* end() { return items_.data() + size_; }
  const T* begin() const { return items_.data(); }
  const T* end() const { return items_.data() + size_; }

 private:
  std::array<T, capacity> items_{};
  std::size_t size_ = 0;
};

}  // namespace crt::test
