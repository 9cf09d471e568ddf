// These tests give a client handlers that fail in all ways there are.
#include "studio/view_client.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <crt/error.hpp>
#include <memory>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

using namespace crt::studio;
using nlohmann::json;

namespace {

/// A Recorder has what was sent, and ends when it is said to.
class Recorder : public Connection {
 public:
  void send_text(std::string text) override {
    if (has_no_memory) throw std::bad_alloc();
    messages.push_back(json::parse(text));
  }
  void send_binary(std::string) override {}
  bool is_open() const override { return !has_ended; }

  std::vector<json> messages;
  bool has_no_memory = false;
  bool has_ended = false;
};

struct FailingClient : ViewClient {
  explicit FailingClient(std::shared_ptr<Connection> connection)
      : ViewClient(std::move(connection), 1) {
    on("memory", [](const json&) { throw std::bad_alloc(); });
    on("system", [](const json&) { throw std::runtime_error("the system fails"); });
    on("error", [](const json&) { throw crt::Error(crt::ErrorCode::io, "it cannot be read"); });
    on("lacking", [](const json& message) { message.at("something"); });
    on("save", [this](const json&) { send({{"type", "saved"}}); });
  }
};

}  // namespace

TEST_CASE("whatever a handler throws is answered, and the client lives on") {
  const auto page = std::make_shared<Recorder>();
  FailingClient client(page);
  client.receive(R"({"type": "memory", "id": 1})");
  client.receive(R"({"type": "system", "id": 2})");
  client.receive(R"({"type": "error", "id": 3})");
  client.receive(R"({"type": "lacking", "id": 4})");
  const std::vector<std::string> expected = {
      "there is not enough memory", "the system fails", "it cannot be read",
      "the message lacks something, or has it of another type"};
  REQUIRE(page->messages.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(page->messages[i].at("message") == expected[i]);
    CHECK(page->messages[i].at("id") == i + 1);
  }
}

TEST_CASE("a client lives on where there is no memory to say what is wrong") {
  const auto page = std::make_shared<Recorder>();
  FailingClient client(page);
  page->has_no_memory = true;
  client.receive(R"({"type": "memory", "id": 1})");
  client.receive("no message");
  page->has_no_memory = false;
  client.receive(R"({"type": "save"})");
  CHECK(page->messages == std::vector<json>{{{"type", "saved"}}});
}

TEST_CASE("what nobody waits for is not done after a connection's end, and what is to last is") {
  const auto page = std::make_shared<Recorder>();
  FailingClient client(page);
  client.receive(R"({"type": "boxes", "id": 1})");
  CHECK(page->messages.size() == 1);
  page->has_ended = true;
  for (const char* type : {"boxes", "pick", "picture", "code", "machine", "camera", "render"})
    client.receive(json{{"type", type}, {"id", 1}}.dump());
  CHECK(page->messages.size() == 1);
  client.receive(R"({"type": "save"})");
  CHECK(page->messages.back() == json{{"type", "saved"}});
}
