#include "studio/web_server.hpp"

#include <unistd.h>

#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <crt/error.hpp>
#include <csignal>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "studio/access.hpp"

namespace crt::studio {

namespace {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using net::ip::tcp;
using Code = boost::system::error_code;
using Request = http::request<http::empty_body>;

constexpr std::uint32_t longest_header = 16 << 10;
constexpr std::chrono::seconds request_timeout{30};
/// A browser that does not take what it is sent is left.
constexpr std::size_t most_waiting_bytes = std::size_t{256} << 20;

const std::string content_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; style-src-attr 'unsafe-inline'; "
    "connect-src 'self'; img-src 'self' "
    "blob: data:; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors ";
constexpr const char* no_frames = "'none'";
constexpr const char* local_frames =
    "http://localhost:* http://127.0.0.1:* https://localhost:* vscode-webview:";

/// Anything that lives as long as its connection, and can be ended.
class Session {
 public:
  virtual ~Session() = default;
  virtual void end() = 0;
};

/// What sessions share. Only the server's thread touches it.
struct Shared {
  WebServerOptions options;
  WebServer::MakeClient make_client;
  std::uint16_t port = 0;
  std::set<Session*> sessions{};
  std::size_t clients = 0;
};

/// A Socket is a connection that has become a WebSocket.
class Socket : public Connection, public Session, public std::enable_shared_from_this<Socket> {
 public:
  Socket(beast::tcp_stream stream, std::shared_ptr<Shared> shared)
      : stream_(std::move(stream)), shared_(std::move(shared)) {
    shared_->sessions.insert(this);
    ++shared_->clients;
  }
  ~Socket() override {
    shared_->sessions.erase(this);
    --shared_->clients;
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void start(const Request& request) {
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    websocket::permessage_deflate deflate;
    deflate.server_enable = true;
    deflate.compLevel = 1;
    stream_.set_option(deflate);
    stream_.read_message_max(shared_->options.longest_message);
    stream_.async_accept(request, [self = shared_from_this()](Code failed) {
      if (failed) return;
      self->client_ = self->shared_->make_client(self->weak_connection());
      self->read();
    });
  }

  void send_text(std::string text) override { send({std::move(text), true}); }
  void send_binary(std::string bytes) override { send({std::move(bytes), false}); }

  void end() override {
    client_.reset();
    Code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

 private:
  struct Message {
    std::string bytes;
    bool is_text = true;
  };

  /// A Link is what the client has: it does not keep the socket alive.
  class Link : public Connection {
   public:
    explicit Link(const std::shared_ptr<Socket>& socket)
        : socket_(socket), executor_(socket->stream_.get_executor()) {}
    void send_text(std::string text) override { send({std::move(text), true}); }
    void send_binary(std::string bytes) override { send({std::move(bytes), false}); }

   private:
    void send(Message message) {
      // The socket is locked in its own thread alone, so that it also ends there.
      net::post(executor_, [socket = socket_, message = std::move(message)]() mutable {
        if (const auto alive = socket.lock()) alive->send(std::move(message));
      });
    }
    std::weak_ptr<Socket> socket_;
    net::any_io_executor executor_;
  };

  std::shared_ptr<Connection> weak_connection() {
    return std::make_shared<Link>(shared_from_this());
  }

  void send(Message message) {
    waiting_bytes_ += message.bytes.size();
    waiting_.push_back(std::move(message));
    if (waiting_bytes_ > most_waiting_bytes) return end();
    if (waiting_.size() == 1) write();
  }

  void write() {
    stream_.text(waiting_.front().is_text);
    stream_.async_write(net::buffer(waiting_.front().bytes),
                        [self = shared_from_this()](Code failed, std::size_t) {
                          if (failed) return self->client_.reset();
                          self->waiting_bytes_ -= self->waiting_.front().bytes.size();
                          self->waiting_.pop_front();
                          if (!self->waiting_.empty()) self->write();
                        });
  }

  void read() {
    stream_.async_read(buffer_, [self = shared_from_this()](Code failed, std::size_t) {
      if (failed || !self->client_) return self->client_.reset();
      const auto data = self->buffer_.cdata();
      if (self->stream_.got_text())
        self->client_->receive({static_cast<const char*>(data.data()), data.size()});
      self->buffer_.consume(data.size());
      self->read();
    });
  }

  websocket::stream<beast::tcp_stream> stream_;
  std::shared_ptr<Shared> shared_;
  beast::flat_buffer buffer_;
  std::deque<Message> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::unique_ptr<Client> client_;
};

/// A Visit is a connection of which requests are read.
class Visit : public Session, public std::enable_shared_from_this<Visit> {
 public:
  Visit(tcp::socket socket, std::shared_ptr<Shared> shared)
      : stream_(std::move(socket)), shared_(std::move(shared)) {
    shared_->sessions.insert(this);
  }
  ~Visit() override { shared_->sessions.erase(this); }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(longest_header);
    parser_->body_limit(0);
    stream_.expires_after(request_timeout);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](Code failed, std::size_t) {
                       if (!failed) self->answer(self->parser_->get());
                     });
  }

  void end() override {
    Code ignored;
    stream_.socket().close(ignored);
  }

 private:
  static std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

  void answer(const Request& request) {
    const std::string_view host = view(request[http::field::host]);
    const std::string_view target = view(request.target());
    const WebServerOptions& options = shared_->options;
    if (!is_own_host(host, options.address, shared_->port))
      return refuse(request, http::status::misdirected_request, "This is not the host's name.");
    if (!is_own_origin(view(request[http::field::origin]), host))
      return refuse(request, http::status::forbidden, "Other pages may not ask.");
    const std::string_view path = target.substr(0, target.find('?'));
    if (path == "/socket") return connect(request, target);
    const auto file = options.files.find(path);
    if (file == options.files.end())
      return refuse(request, http::status::not_found, "There is no such page.");
    if (request.method() != http::verb::get && request.method() != http::verb::head)
      return refuse(request, http::status::method_not_allowed, "Pages can only be read.");
    respond(request, http::status::ok, file->second);
  }

  void connect(const Request& request, std::string_view target) {
    if (!is_token(token_of(target), shared_->options.token))
      return refuse(request, http::status::forbidden, "The token is wrong.");
    if (!websocket::is_upgrade(request))
      return refuse(request, http::status::upgrade_required, "This is a WebSocket.");
    if (shared_->clients >= shared_->options.most_clients)
      return refuse(request, http::status::service_unavailable, "Too many pages are open.");
    stream_.expires_never();
    std::make_shared<Socket>(std::move(stream_), shared_)->start(request);
  }

  void refuse(const Request& request, http::status status, std::string_view why) {
    respond(request, status, {why, "text/plain; charset=utf-8"});
  }

  void respond(const Request& request, http::status status, const PageFile& file) {
    auto response =
        std::make_shared<http::response<http::span_body<const char>>>(status, request.version());
    response->set(http::field::content_type,
                  beast::string_view(file.type.data(), file.type.size()));
    response->set(http::field::cache_control, "no-store");
    response->set("Content-Security-Policy",
                  content_policy + (shared_->options.may_be_framed ? local_frames : no_frames));
    response->set("X-Content-Type-Options", "nosniff");
    response->set("Referrer-Policy", "no-referrer");
    response->set("Cross-Origin-Opener-Policy", "same-origin");
    response->set("Cross-Origin-Resource-Policy", "same-origin");
    response->keep_alive(request.keep_alive() && status == http::status::ok);
    const std::size_t size = request.method() == http::verb::head ? 0 : file.content.size();
    response->body() = beast::span<const char>(file.content.data(), size);
    response->content_length(file.content.size());
    http::async_write(stream_, *response,
                      [self = shared_from_this(), response](Code failed, std::size_t) {
                        if (failed) return;
                        if (response->keep_alive()) return self->read();
                        Code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  beast::tcp_stream stream_;
  std::shared_ptr<Shared> shared_;
  beast::flat_buffer buffer_{longest_header};
  std::optional<http::request_parser<http::empty_body>> parser_;
};

}  // namespace

class WebServer::State {
 public:
  State(const WebServerOptions& options, MakeClient make_client)
      : acceptor_(context_),
        signals_(context_),
        input_(context_),
        shared_(std::make_shared<Shared>(Shared{options, std::move(make_client)})) {
    try {
      const tcp::endpoint place(net::ip::make_address(options.address), options.port);
      acceptor_.open(place.protocol());
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
      throw Error(ErrorCode::io, "cannot listen on " + options.address + ":" +
                                     std::to_string(options.port) + ": " + error.code().message());
    }
  }

  std::uint16_t port() const { return shared_->port; }

  void run() {
    signals_.async_wait([this](Code failed, int) {
      if (!failed) end();
    });
    if (input_.is_open()) watch_input();
    accept();
    context_.run();
  }

  void stop() {
    net::post(context_, [this] { end(); });
  }

 private:
  void accept() {
    acceptor_.async_accept([this](Code failed, tcp::socket socket) {
      if (!acceptor_.is_open()) return;
      if (!failed && shared_->sessions.size() < shared_->options.most_connections) {
        Code ignored;
        socket.set_option(tcp::no_delay(true), ignored);
        std::make_shared<Visit>(std::move(socket), shared_)->read();
      }
      accept();
    });
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
    signals_.cancel(ignored);
    for (Session* session : std::set<Session*>(shared_->sessions)) session->end();
  }

  net::io_context context_{1};
  tcp::acceptor acceptor_;
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
