#include "memory/counting_new.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::uint64_t> count = 0;
std::atomic<std::int64_t> in_use = 0;

/// In front of each block is its size. The space for it is as large as the strictest alignment that
/// plain new promises.
constexpr std::size_t header = alignof(std::max_align_t);
static_assert(header >= sizeof(std::size_t));

void* take_if_there_is(std::size_t size, std::size_t alignment) noexcept {
  const std::size_t front = alignment > header ? alignment : header;
  // A block has at least one byte, so that its address is within it. Leaks are found by that.
  const std::size_t whole = (front + std::max<std::size_t>(size, 1) + front - 1) / front * front;
  void* block = std::aligned_alloc(front, whole);
  if (block == nullptr) return nullptr;
  ++count;
  in_use += static_cast<std::int64_t>(size);
  char* memory = static_cast<char*>(block) + front;
  reinterpret_cast<std::size_t*>(memory)[-1] = size;
  return memory;
}

void* take(std::size_t size, std::size_t alignment) {
  void* memory = take_if_there_is(size, alignment);
  if (memory == nullptr) throw std::bad_alloc();
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

// All forms are replaced, as sanitizers have their own of those that are not here.
void* operator new(std::size_t size) {
  return take(size, header);
}
void* operator new[](std::size_t size) {
  return take(size, header);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return take(size, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return take_if_there_is(size, header);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return take_if_there_is(size, header);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return take_if_there_is(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return take_if_there_is(size, static_cast<std::size_t>(alignment));
}

void operator delete(void* memory) noexcept {
  give_back(memory, header);
}
void operator delete[](void* memory) noexcept {
  give_back(memory, header);
}
void operator delete(void* memory, std::size_t) noexcept {
  give_back(memory, header);
}
void operator delete[](void* memory, std::size_t) noexcept {
  give_back(memory, header);
}
void operator delete(void* memory, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
void operator delete[](void* memory, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory, std::size_t, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
void operator delete[](void* memory, std::size_t, std::align_val_t alignment) noexcept {
  give_back(memory, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory, const std::nothrow_t&) noexcept {
  give_back(memory, header);
}
void operator delete[](void* memory, const std::nothrow_t&) noexcept {
  give_back(memory, header);
}
