// These tests run work on several threads.
#include "core/tasks/tasks.hpp"

#include <doctest/doctest.h>
#include <crt/error.hpp>

#include <algorithm>
#include <atomic>
#include <random>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/tasks/parallel.hpp"

using namespace crt::core;

TEST_CASE("every task runs once, on any number of threads") {
  for (const int threads : {0, 1, 2, 7, 100}) {
    std::vector<std::atomic<int>> runs(1000);
    run_tasks(runs.size(), threads, [&](std::size_t i) { ++runs[i]; });
    for (const auto& count : runs) REQUIRE(count == 1);
  }
  run_tasks(0, 4, [](std::size_t) { FAIL("there is no task"); });
}

TEST_CASE("one thread runs tasks in order, on itself") {
  std::vector<std::size_t> order;
  const auto here = std::this_thread::get_id();
  run_tasks(100, 1, [&](std::size_t i) {
    REQUIRE(std::this_thread::get_id() == here);
    order.push_back(i);
  });
  for (std::size_t i = 0; i < 100; ++i) CHECK(order[i] == i);
}

TEST_CASE("no more threads than asked for work at once") {
  std::atomic<int> working = 0;
  std::atomic<int> most = 0;
  run_tasks(200, 2, [&](std::size_t) {
    const int now = ++working;
    int seen = most;
    while (now > seen && !most.compare_exchange_weak(seen, now)) {
    }
    for (int i = 0; i < 100; ++i) std::this_thread::yield();
    --working;
  });
  CHECK(most <= 2);
}

TEST_CASE("a task's exception comes out and stops the rest") {
  for (const int threads : {0, 1, 3}) {
    std::atomic<int> begun = 0;
    CHECK_THROWS_AS(run_tasks(100'000, threads,
                              [&](std::size_t) {
                                if (++begun == 10) throw std::domain_error("task");
                              }),
                    std::domain_error);
    CHECK(begun < 100'000);
  }
}

TEST_CASE("a negative number of threads is refused") {
  CHECK_THROWS_AS(allowed_threads(-1), crt::Error);
  CHECK(allowed_threads(1) == 1);
  CHECK(allowed_threads(0) >= 1);
}

TEST_CASE("ranges cover each item once, and few items stay on this thread") {
  for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 9, 10, 11, 1000}) {
    std::vector<std::atomic<int>> runs(count);
    for_ranges(count, 10, 0, [&](std::size_t begin, std::size_t end) {
      REQUIRE(end - begin <= 10);
      for (std::size_t i = begin; i < end; ++i) ++runs[i];
    });
    for (const auto& run : runs) REQUIRE(run == 1);
  }
  const auto here = std::this_thread::get_id();
  for_ranges(10, 10, 0,
             [&](std::size_t, std::size_t) { CHECK(std::this_thread::get_id() == here); });
}

TEST_CASE("sorting gives the same on any number of threads") {
  std::mt19937 random(1);
  for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 2, 1000, 100'000}) {
    std::vector<std::uint32_t> numbers(count);
    for (std::size_t i = 0; i < count; ++i) numbers[i] = static_cast<std::uint32_t>(i);
    std::shuffle(numbers.begin(), numbers.end(), random);
    for (const int threads : {0, 1, 2, 3, 8}) {
      std::vector<std::uint32_t> sorted = numbers;
      sort_in_parallel(std::span(sorted), threads, std::less<>());
      for (std::size_t i = 0; i < count; ++i) REQUIRE(sorted[i] == i);
    }
  }
}
