// These tests serve clients that take as long as a gate is closed. Whatever waits for one of them
// that should not would wait forever.
#include "studio/web_server.hpp"

#include <doctest/doctest.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "studio/session.hpp"

using namespace crt::studio;

namespace {

/// A Gate keeps those who come until it is opened.
class Gate {
 public:
  void pass() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_open_; });
  }
  void open() {
    const std::lock_guard lock(mutex_);
    is_open_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_open_ = false;
};

/// A Log has what happened, in order.
class Log {
 public:
  void add(const std::string& line) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(line);
  }
  std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

/// A Parrot repeats what it gets. Some words make it wait at the gate, at once or at its end.
class Parrot : public Client {
 public:
  Parrot(std::shared_ptr<Connection> connection, Gate& gate, Log& log)
      : connection_(std::move(connection)), gate_(gate), log_(log) {}
  ~Parrot() override {
    if (ends_slowly_) gate_.pass();
    log_.add("end");
  }
  Parrot(const Parrot&) = delete;
  Parrot& operator=(const Parrot&) = delete;

  void receive(std::string_view text) override {
    if (text == "wait") gate_.pass();
    if (text == "end slowly") ends_slowly_ = true;
    if (text == "fail") throw std::runtime_error("it fails");
    log_.add(std::string(text));
    connection_->send_text(std::string(text));
  }

 private:
  const std::shared_ptr<Connection> connection_;
  Gate& gate_;
  Log& log_;
  bool ends_slowly_ = false;
};

/// A ParrotServer serves until it is destroyed.
class ParrotServer {
 public:
  explicit ParrotServer(WebServer::MakeClient make, std::size_t max_clients = 16,
                        std::shared_ptr<const Transport> transport = {})
      : server_({.transport = std::move(transport),
                 .token = "t",
                 .ends_by_signals = false,
                 .max_clients = max_clients},
                std::move(make)),
        thread_([this] { server_.run(); }) {}
  ~ParrotServer() {
    server_.stop();
    thread_.join();
  }
  ParrotServer(const ParrotServer&) = delete;
  ParrotServer& operator=(const ParrotServer&) = delete;

  std::uint16_t port() const { return server_.port(); }

 private:
  WebServer server_;
  std::thread thread_;
};

/// A Page is connected with the server.
class Page {
 public:
  explicit Page(const ParrotServer& server) : Page(server.port()) {}
  explicit Page(std::uint16_t port) : stream_(context_) {
    stream_.next_layer().connect({net::ip::address_v4::loopback(), port});
    stream_.handshake("127.0.0.1:" + std::to_string(port), "/socket?token=t");
  }

  void send(const std::string& text) { stream_.write(net::buffer(text)); }
  std::string receive() {
    beast::flat_buffer buffer;
    stream_.read(buffer);
    return beast::buffers_to_string(buffer.data());
  }
  std::string ask(const std::string& text) {
    send(text);
    return receive();
  }

 private:
  net::io_context context_;
  beast::websocket::stream<tcp::socket> stream_;
};

struct Served {
  Gate gate;
  Log log;
  WebServer::MakeClient make = [this](std::shared_ptr<Connection> connection) {
    return std::make_unique<Parrot>(std::move(connection), gate, log);
  };
};

}  // namespace

TEST_CASE("no page waits for what another has asked for") {
  Served served;
  const ParrotServer server(served.make);
  Page slow(server);
  Page quick(server);
  slow.send("wait");
  CHECK(quick.ask("hello") == "hello");
  CHECK(Page(server).ask("a third") == "a third");
  served.gate.open();
  CHECK(slow.receive() == "wait");
}

TEST_CASE("no page waits for the end of another") {
  Served served;
  const ParrotServer server(served.make);
  {
    Page closing(server);
    CHECK(closing.ask("end slowly") == "end slowly");
  }
  Page other(server);
  CHECK(other.ask("hello") == "hello");
  CHECK(served.log.lines() == std::vector<std::string>{"end slowly", "hello"});
  served.gate.open();
}

TEST_CASE("no page waits until another is made") {
  Served served;
  std::mutex mutex;
  bool is_first = true;
  Gate begun;
  const ParrotServer server([&](std::shared_ptr<Connection> connection) {
    bool waits = false;
    {
      const std::lock_guard lock(mutex);
      waits = std::exchange(is_first, false);
    }
    if (waits) {
      begun.open();
      served.gate.pass();
    }
    return served.make(std::move(connection));
  });
  Page first(server);
  first.send("hello");
  begun.pass();
  CHECK(Page(server).ask("I am the second") == "I am the second");
  served.gate.open();
  CHECK(first.receive() == "hello");
}

TEST_CASE("what came before a page's end is done, in its order, before the client ends") {
  Served served;
  {
    const ParrotServer server(served.make);
    Page page(server);
    CHECK(page.ask("first") == "first");
    for (const char* text : {"wait", "second", "third"}) page.send(text);
    Page other(server);
    CHECK(other.ask("other") == "other");
    served.gate.open();
    while (page.receive() != "third") continue;
  }
  std::vector<std::string> lines = served.log.lines();
  std::erase(lines, "other");
  CHECK(lines == std::vector<std::string>{"first", "wait", "second", "third", "end", "end"});
}

TEST_CASE("a page that sends more than its client can take goes on later, and loses nothing") {
  Served served;
  const ParrotServer server(served.make);
  Page page(server);
  const std::string text(700'000, 'a');
  for (const char* begin : {"wait", "1", "2", "3", "4"})
    page.send(begin == std::string("wait") ? begin : begin + text);
  Page other(server);
  CHECK(other.ask("hello") == "hello");
  served.gate.open();
  for (const char* begin : {"wait", "1", "2", "3", "4"}) CHECK(page.receive().starts_with(begin));
  CHECK(page.ask("more") == "more");
}

TEST_CASE("a server ends with pages that are held up") {
  Served served;
  const std::string text(2'000'000, 'a');
  {
    const ParrotServer server(served.make);
    Page page(server);
    for (const std::string& message : {std::string("wait"), text, text}) page.send(message);
    Page other(server);
    CHECK(other.ask("hello") == "hello");
    served.gate.open();
  }
  CHECK(served.log.lines().back() == "end");
}

TEST_CASE("a client that has not come to its end yet takes a place among those there may be") {
  Served served;
  const ParrotServer server(served.make, 1);
  {
    Page closing(server);
    CHECK(closing.ask("end slowly") == "end slowly");
    CHECK_THROWS(Page(server));
  }
  for (int i = 0; i < 20; ++i) CHECK_THROWS(Page(server));
  CHECK(served.log.lines() == std::vector<std::string>{"end slowly"});
  served.gate.open();
  bool got_in = false;
  while (!got_in) {
    try {
      got_in = Page(server).ask("hello") == "hello";
    } catch (const boost::system::system_error&) {
      std::this_thread::yield();  // the place is not free yet
    }
  }
}

TEST_CASE("a client that fails, or cannot be made, ends its own connection alone") {
  Served served;
  bool is_made = true;
  std::mutex mutex;
  const ParrotServer server([&](std::shared_ptr<Connection> connection) {
    const std::lock_guard lock(mutex);
    if (!is_made) throw std::bad_alloc();
    return served.make(std::move(connection));
  });
  Page other(server);
  CHECK(other.ask("hello") == "hello");
  Page failing(server);
  failing.send("fail");
  CHECK_THROWS(failing.receive());
  {
    const std::lock_guard lock(mutex);
    is_made = false;
  }
  Page unmade(server);
  CHECK_THROWS(unmade.receive());
  CHECK(other.ask("still here") == "still here");
}

TEST_CASE("what fails in the server's thread ends its own connection alone") {
  Served served;
  /// Fails with every other connection.
  struct FailingTransport : Transport {
    void begin(tcp::socket socket, const std::shared_ptr<Shared>& shared) const override {
      if (count_++ % 2 == 1) throw std::bad_alloc();
      std::make_shared<Visit<Plain>>(Plain::Stream(std::move(socket)), shared)->start();
    }
    mutable int count_ = 0;
  };
  const ParrotServer server(served.make, 16, std::make_shared<FailingTransport>());
  Page page(server);
  for (int i = 0; i < 3; ++i) {
    CHECK_THROWS(Page(server));
    CHECK(Page(server).ask("hello") == "hello");
  }
  CHECK(page.ask("still here") == "still here");
}

TEST_CASE("after a signal no client is waited for, and the next one ends the program") {
  Served served;
  WebServer server({.token = "t"}, served.make);
  std::thread thread([&] { server.run(); });
  Page page(server.port());
  CHECK(page.ask("end slowly") == "end slowly");
  std::raise(SIGINT);
  thread.join();
  struct sigaction now {};
  REQUIRE(sigaction(SIGINT, nullptr, &now) == 0);
  const bool ends_the_program = now.sa_handler == SIG_DFL;
  CHECK(ends_the_program);
  CHECK(served.log.lines() == std::vector<std::string>{"end slowly"});
  served.gate.open();
}
