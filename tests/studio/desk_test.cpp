// These tests give a desk more than it has room for.
#include "studio/desk.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <memory>
#include <semaphore>
#include <stdexcept>
#include <string>

using namespace crt::studio;

namespace {

/// A Worker takes a message each time that it is let.
struct Worker : Client {
  Worker(std::counting_semaphore<>& allowed, std::atomic<int>& taken)
      : allowed_(allowed), taken_(taken) {}
  void receive(std::string_view) override {
    allowed_.acquire();
    ++taken_;
  }
  std::counting_semaphore<>& allowed_;
  std::atomic<int>& taken_;
};

/// A Workplace counts what comes from its desk.
struct Workplace {
  std::counting_semaphore<> allowed{0};
  std::counting_semaphore<> room{0};
  std::atomic<int> taken = 0;
  std::atomic<int> ends = 0;
  std::unique_ptr<Desk> desk = std::make_unique<Desk>(
      DeskEvents{.make_client = [this] { return std::make_unique<Worker>(allowed, taken); },
                 .has_room = [this] { room.release(); },
                 .has_ended = [this] { ++ends; }});

  /// Gives messages until there is no room for more. Returns how many there were.
  int fill(const std::string& message) {
    int count = 1;
    while (desk->give(message)) ++count;
    return count;
  }
};

}  // namespace

TEST_CASE("a page that sends more than is done is held up, and goes on when there is room") {
  Workplace place;
  const int count = place.fill("a");
  // One may be at work already.
  CHECK(count >= static_cast<int>(Desk::max_messages));
  CHECK(count <= static_cast<int>(Desk::max_messages) + 1);
  // It may have gone to work just after the last, which has made room then.
  place.allowed.release(count);
  place.room.acquire();
  place.desk.reset();
  CHECK(place.taken == count);
  CHECK(place.ends == 1);
}

TEST_CASE("a page is also held up by messages that are long") {
  Workplace place;
  const int count = place.fill(std::string(Desk::most_bytes / 4, 'a'));
  CHECK(count >= 4);
  CHECK(count <= 5);
  place.allowed.release(count);
  place.desk.reset();
  CHECK(place.taken == count);
}

TEST_CASE("a desk that is closed does what it was given, and is not waited for before") {
  Workplace place;
  for (int i = 0; i < 5; ++i) place.desk->give("a");
  place.desk->close();
  CHECK(place.taken == 0);
  CHECK(place.ends == 0);
  place.allowed.release(5);
  place.desk.reset();
  CHECK(place.taken == 5);
  CHECK(place.ends == 1);
}
