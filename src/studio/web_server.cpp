#include "studio/web_server.hpp"

#include <unistd.h>

#include <array>
#include <boost/asio/ip/v6_only.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <crt/error.hpp>
#include <csignal>
#include <exception>

#include "studio/session.hpp"

namespace crt::studio {

namespace {

class PlainTransport : public Transport {
 public:
  void begin(tcp::socket socket, const std::shared_ptr<Shared>& shared) const override {
    std::make_shared<Visit<Plain>>(Plain::Stream(std::move(socket)), shared)->start();
  }
};

/// There is such a pause before connections are asked for again that the system cannot give.
constexpr std::chrono::milliseconds accept_pause{100};

IpAddress address_of(const std::string& text) {
  const std::optional<IpAddress> address = IpAddress::parse(text);
  if (!address) throw Error(ErrorCode::invalid_argument, "'" + text + "' is no IP address");
  return *address;
}

}  // namespace

class WebServer::State {
 public:
  State(const WebServerOptions& options, MakeClient make_client)
      : acceptor_(context_),
        pause_(context_),
        signals_(context_),
        input_(context_),
        shared_(std::make_shared<Shared>(
            Shared{options, std::move(make_client),
                   HostNames(address_of(options.address), options.names)})) {
    const IpAddress address = address_of(options.address);
    try {
      const tcp::endpoint place(net::ip::make_address(address.text()), options.port);
      acceptor_.open(place.protocol());
      if (!address.is_ipv4()) acceptor_.set_option(net::ip::v6_only(!address.is_any()));
      acceptor_.set_option(net::socket_base::reuse_address(true));
      acceptor_.bind(place);
      acceptor_.listen();
      shared_->port = acceptor_.local_endpoint().port();
      if (options.ends_with_input) input_.assign(dup(STDIN_FILENO));
      // Whoever has read the address may interrupt at once.
      if (options.ends_by_signals) {
        signals_.add(SIGINT);
        signals_.add(SIGTERM);
      }
    } catch (const boost::system::system_error& error) {
      throw Error(ErrorCode::io, "cannot listen on " + address.in_url() + ":" +
                                     std::to_string(options.port) + ": " + error.code().message());
    }
  }

  ~State() { shared_->desks.clear(); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::uint16_t port() const { return shared_->port; }

  void run() {
    signals_.async_wait([this](Code failed, int) {
      if (!failed) end();
    });
    if (input_.is_open()) watch_input();
    accept();
    while (!runs_out()) continue;
  }

  void stop() {
    net::post(context_, [this] { end(); });
  }

 private:
  /// Does what there is to do. Returns false if it must go on: something has failed, as there is no
  /// memory above all. Then the connection that it was done for has ended with it, and no other.
  bool runs_out() {
    try {
      context_.run();
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  void accept() {
    acceptor_.async_accept([this](Code failed, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (failed) return accept_later();
      accept();  // first, as what follows may fail
      if (shared_->sessions.size() >= shared_->options.max_connections) make_way();
      Code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      transport().begin(std::move(socket), shared_);
    });
  }

  /// The system may have no descriptor left for those who wait. Then they wait for one.
  void accept_later() {
    make_way();
    pause_.expires_after(accept_pause);
    pause_.async_wait([this](Code failed) {
      if (!failed && acceptor_.is_open()) accept();
    });
  }

  const Transport& transport() const {
    return shared_->options.transport ? *shared_->options.transport : plain_;
  }

  /// Where there are too many connections, the one that has gone without the token for longest
  /// ends. So strangers keep out nobody for long, and no page that is open.
  void make_way() {
    std::list<Session*>& visits = shared_->visits;
    if (visits.empty()) return;
    Session* oldest = visits.front();
    visits.pop_front();
    oldest->end();
  }

  void watch_input() {
    input_.async_wait(net::posix::stream_descriptor::wait_read, [this](Code failed) {
      if (failed) return;
      std::array<char, 256> unused;
      if (read(input_.native_handle(), unused.data(), unused.size()) > 0) return watch_input();
      end();
    });
  }

  void end() {
    Code ignored;
    input_.close(ignored);
    acceptor_.close(ignored);
    pause_.cancel();
    signals_.cancel(ignored);
    signals_.clear(ignored);  // a second one ends the program at once
    for (Session* session : std::set<Session*>(shared_->sessions)) session->end();
  }

  const PlainTransport plain_;
  net::io_context context_{1};
  tcp::acceptor acceptor_;
  net::steady_timer pause_;
  net::signal_set signals_;
  net::posix::stream_descriptor input_;
  std::shared_ptr<Shared> shared_;
};

WebServer::WebServer(const WebServerOptions& options, MakeClient make_client)
    : state_(std::make_unique<State>(options, std::move(make_client))) {}

WebServer::~WebServer() = default;

std::uint16_t WebServer::port() const {
  return state_->port();
}

void WebServer::run() {
  state_->run();
}

void WebServer::stop() {
  state_->stop();
}

}  // namespace crt::studio
