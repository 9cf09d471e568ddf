#include "memory/counting_new.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> count = 0;
std::atomic<std::int64_t> in_use = 0;

/// In front of each block: its size. As large as the strictest alignment that plain new promises.
constexpr std::size_t header = alignof(std::max_align_t);
static_assert(header >= sizeof(std::size_t));

void* take(std::size_t size, std::size_t alignment) {
  const std::size_t front = alignment > header ? alignment : header;
  const std::size_t whole = (front + size + front - 1) / front * front;
  void* block = std::aligned_alloc(front, whole);
  if (block == nullptr) throw std::bad_alloc();
  ++count;
  in_use += static_cast<std::int64_t>(size);
  char* memory = static_cast<char*>(block) + front;
  reinterpret_cast<std::size_t*>(memory)[-1] = size;
  return memory;
}

void give_back(void* memory, std::size_t alignment) {
  if (memory == nullptr) return;
  const std::size_t front = alignment > header ? alignment : header;
  in_use -= static_cast<std::int64_t>(static_cast<std::size_t*>(memory)[-1]);
  std::free(static_cast<char*>(memory) - front);
}

}  // namespace

namespace crt::test {

std::uint64_t allocations() {
  return count;
}

std::int64_t bytes_in_use() {
  return in_use;
}

}  // namespace crt::test

// The array and nothrow forms of the standard library call these.
void* operator new(std::size_t size) {
  return take(size, header);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  give_back(memory, header);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory, header);
}
void operator delete(void* memory, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory, std::size_t, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
