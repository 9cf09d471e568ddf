// These tests have several clients on one script, as pages that come again and pages that save at
// once have.
#include "studio/studio_client.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <latch>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "support/temporary_directory.hpp"

using namespace crt::studio;
using crt::test::TemporaryDirectory;
using nlohmann::json;

namespace {

/// A Recorder counts the messages of each type.
class Recorder : public Connection {
 public:
  void send_text(std::string text) override {
    const std::lock_guard lock(mutex_);
    types_.push_back(json::parse(text).at("type"));
  }
  void send_binary(std::string) override {}

  long count(const std::string& type) const {
    const std::lock_guard lock(mutex_);
    return std::count(types_.begin(), types_.end(), type);
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> types_;
};

std::string content_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A Studio has a folder with one script, and clients on it.
struct Studio {
  TemporaryDirectory folder;
  std::shared_ptr<const Folder> opened;
  std::shared_ptr<OpenPages> pages = std::make_shared<OpenPages>();

  Studio() {
    std::ofstream(folder / "a.crt") << "a = 1\n";
    opened = std::make_shared<const Folder>(folder.path());
  }

  /// Makes a client that has opened the script as a page.
  std::unique_ptr<Client> client(const std::string& page,
                                 const std::shared_ptr<Connection>& connection) const {
    auto client = make_studio_client(connection, opened, pages, {.script = "a.crt", .threads = 1});
    client->receive(json{{"type", "open"}, {"script", "a.crt"}, {"page", page}}.dump());
    return client;
  }
};

void type(Client& client, const std::string& text) {
  client.receive(
      json{{"type", "text"}, {"revision", 1}, {"script", "a.crt"}, {"text", text}}.dump());
}

}  // namespace

TEST_CASE("what a page's last connection still had to say does not replace what it typed since") {
  const Studio studio;
  auto before = studio.client("7", std::make_shared<Recorder>());
  type(*before, "a = 2\n");
  const auto kept = studio.folder / ".a.crt.7.typed";
  while (content_of(kept) != "a = 2\n") std::this_thread::yield();
  auto now = studio.client("7", std::make_shared<Recorder>());
  type(*now, "a = 4\n");
  now.reset();
  // It comes to its end late, after all that waited at its desk.
  type(*before, "a = 3\n");
  before.reset();
  CHECK(content_of(kept) == "a = 4\n");
  now = studio.client("7", std::make_shared<Recorder>());
  type(*now, "a = 5\n");
  now.reset();
  CHECK(content_of(kept) == "a = 5\n");
}

TEST_CASE("of pages that save a script at once one does, and the others see that it was changed") {
  constexpr int clients = 6;
  for (int round = 0; round < 10; ++round) {
    const Studio studio;
    std::latch begin(clients);
    std::atomic<long> saved = 0;
    std::atomic<long> conflicts = 0;
    std::vector<std::thread> threads;
    for (int number = 0; number < clients; ++number) {
      threads.emplace_back([&, number] {
        const auto page = std::make_shared<Recorder>();
        const auto client = studio.client(std::to_string(number), page);
        const std::string text = "a = " + std::to_string(number + 10) + "\n";
        begin.arrive_and_wait();
        client->receive(json{{"type", "save"}, {"script", "a.crt"}, {"text", text}}.dump());
        saved += page->count("saved");
        conflicts += page->count("conflict");
      });
    }
    for (std::thread& thread : threads) thread.join();
    CHECK(saved == 1);
    CHECK(conflicts == clients - 1);
  }
}
