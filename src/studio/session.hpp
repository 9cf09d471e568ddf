// A session is a connection with a browser: at first a visit, of which requests are read, and then
// perhaps a socket of a page that has shown the token. Both are templates of the kind of
// connection, which says how bytes go and how it begins and ends: Plain here, and Tls in tls.cpp.
#pragma once

#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "studio/access.hpp"
#include "studio/desk.hpp"
#include "studio/web_server.hpp"

namespace crt::studio {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using net::ip::tcp;
using Code = boost::system::error_code;
using Request = http::request<http::empty_body>;

constexpr std::uint32_t longest_header = 16 << 10;
/// Whoever connects must have agreed on how to encrypt after so long.
constexpr std::chrono::seconds handshake_timeout{10};
constexpr std::chrono::seconds request_timeout{30};
constexpr std::chrono::seconds response_timeout{120};
/// What comes behind the last answer is taken up to here.
constexpr std::size_t max_drained_bytes = std::size_t{1} << 20;
/// A browser that does not take what it is sent is left.
constexpr std::size_t max_waiting_bytes = std::size_t{256} << 20;

struct Shared;

/// Anything that lives as long as its connection, and can be ended. It is listed meanwhile.
class Session {
 public:
  virtual ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  virtual void end() = 0;

 protected:
  explicit Session(std::shared_ptr<Shared> shared);

  const std::shared_ptr<Shared> shared_;
};

/// What sessions share. Only the server's thread touches it.
struct Shared {
  WebServerOptions options;
  WebServer::MakeClient make_client;
  HostNames names;
  std::uint16_t port = 0;
  std::set<Session*> sessions{};
  std::list<Session*> visits{};  ///< those of the sessions that have not shown the token, in turn
  std::set<std::shared_ptr<Desk>> desks{};
  std::size_t arriving = 0;  ///< sockets that have no desk yet

  std::size_t clients() const { return desks.size() + arriving; }
};

/// A Transport begins to talk to those who connect.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual void begin(tcp::socket socket, const std::shared_ptr<Shared>& shared) const = 0;
};

/// Plain connections are not encrypted.
struct Plain {
  using Stream = beast::tcp_stream;

  /// Does what comes before the first request.
  template <class Handler>
  static void begin(Stream&, Handler&& handler) {
    handler(Code());
  }
  /// Says that nothing more is sent.
  template <class Handler>
  static void end(Stream& stream, Handler&& handler) {
    Code failed;
    stream.socket().shutdown(tcp::socket::shutdown_send, failed);
    handler(failed);
  }
};

/// A SocketMessage goes to a browser.
struct SocketMessage {
  std::string bytes;
  bool is_text = true;
};

/// An Outbox is what the client has of its connection, which it does not keep alive. Messages leave
/// in the order in which they came in, whichever threads they are from.
class Outbox : public Connection, public std::enable_shared_from_this<Outbox> {
 public:
  /// Takes what is called in the server's thread with messages that are to be sent.
  using Take = std::function<void(std::deque<SocketMessage>)>;
  Outbox(net::any_io_executor executor, Take take)
      : executor_(std::move(executor)), take_(std::move(take)) {}

  void send_text(std::string text) override { send({std::move(text), true}); }
  void send_binary(std::string bytes) override { send({std::move(bytes), false}); }
  bool is_open() const override { return is_open_; }
  void close() { is_open_ = false; }

 private:
  void send(SocketMessage message);

  const net::any_io_executor executor_;
  const Take take_;
  std::mutex mutex_;
  std::deque<SocketMessage> messages_;  ///< if there is any, the server's thread will look
  std::atomic<bool> is_open_ = true;
};

/// Gives a client a desk. The functions are called in the server's thread: when there is room for
/// messages again, and when the client has come to its end. Returns nothing if there is no thread
/// for it.
std::shared_ptr<Desk> open_desk(const std::shared_ptr<Shared>& shared,
                                const net::any_io_executor& executor,
                                std::shared_ptr<Connection> connection,
                                std::function<void()> has_room, std::function<void()> has_ended);

/// A Socket is a connection that has become a WebSocket.
template <class Kind>
class Socket : public Session, public std::enable_shared_from_this<Socket<Kind>> {
 public:
  Socket(typename Kind::Stream stream, std::shared_ptr<Shared> shared)
      : Session(std::move(shared)), stream_(std::move(stream)) {
    ++shared_->arriving;
  }
  ~Socket() override { leave(); }

  void start(const Request& request) {
    stream_.set_option(websocket::stream_base::timeout::suggested(beast::role_type::server));
    websocket::permessage_deflate deflate;
    deflate.server_enable = true;
    deflate.compLevel = 1;
    stream_.set_option(deflate);
    stream_.read_message_max(shared_->options.longest_message);
    stream_.async_accept(request, [self = this->shared_from_this()](Code failed) {
      if (!failed && self->is_arriving_) self->sit_down();
    });
  }

  void end() override {
    const auto self = this->shared_from_this();
    leave();
    Code ignored;
    beast::get_lowest_layer(stream_).socket().close(ignored);
  }

 private:
  /// Gets a client. The socket is locked in its own thread alone, so that it also ends there.
  void sit_down() {
    const auto socket = this->weak_from_this();
    outbox_ = std::make_shared<Outbox>(stream_.get_executor(),
                                       [socket](std::deque<SocketMessage> messages) {
                                         const auto alive = socket.lock();
                                         if (!alive) return;
                                         for (SocketMessage& message : messages)
                                           alive->send(std::move(message));
                                       });
    const auto call = [socket](void (Socket::*method)()) {
      return [socket, method] {
        if (const auto alive = socket.lock()) (alive.get()->*method)();
      };
    };
    const auto desk = open_desk(shared_, stream_.get_executor(), outbox_, call(&Socket::go_on),
                                call(&Socket::end));
    if (!desk) return end();
    desk_ = desk;
    arrive();
    read();
  }

  void arrive() {
    if (std::exchange(is_arriving_, false)) --shared_->arriving;
  }

  /// Has the client end, which does not last as long as the client takes.
  void leave() {
    arrive();
    if (outbox_) outbox_->close();
    if (const auto desk = desk_.lock()) desk->close();
    desk_.reset();
    held_up_.reset();
  }

  void send(SocketMessage message) {
    waiting_bytes_ += message.bytes.size();
    waiting_.push_back(std::move(message));
    if (waiting_bytes_ > max_waiting_bytes) return end();
    if (waiting_.size() == 1) write();
  }

  void write() {
    stream_.text(waiting_.front().is_text);
    stream_.async_write(net::buffer(waiting_.front().bytes),
                        [self = this->shared_from_this()](Code failed, std::size_t) {
                          if (failed) return self->leave();
                          self->waiting_bytes_ -= self->waiting_.front().bytes.size();
                          self->waiting_.pop_front();
                          if (!self->waiting_.empty()) self->write();
                        });
  }

  void read() {
    stream_.async_read(buffer_, [self = this->shared_from_this()](Code failed, std::size_t) {
      const auto desk = self->desk_.lock();
      if (failed || !desk) return self->leave();
      const auto data = self->buffer_.cdata();
      const bool has_room = !self->stream_.got_text() ||
                            desk->give({static_cast<const char*>(data.data()), data.size()});
      self->buffer_.consume(data.size());
      if (has_room) return self->read();
      self->held_up_ = self;
    });
  }

  /// Reads on, as the client has room for messages again.
  void go_on() {
    if (const auto self = std::exchange(held_up_, nullptr)) read();
  }

  websocket::stream<typename Kind::Stream> stream_;
  beast::flat_buffer buffer_;
  std::deque<SocketMessage> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::shared_ptr<Outbox> outbox_;
  std::weak_ptr<Desk> desk_;
  bool is_arriving_ = true;
  /// Keeps the socket while nothing is read, as the client has enough to do.
  std::shared_ptr<Socket> held_up_;
};

using Response = http::response<http::span_body<const char>>;

/// Returns the answer to a request, or nothing if it is to become a socket.
std::unique_ptr<Response> answer_to(const Request& request, const Shared& shared);
/// Returns the answer to what is no request, or nothing if the connection is what failed.
std::unique_ptr<Response> answer_to_noise(Code failed, const Shared& shared);

/// A Visit is a connection of which requests are read.
template <class Kind>
class Visit : public Session, public std::enable_shared_from_this<Visit<Kind>> {
 public:
  Visit(typename Kind::Stream stream, std::shared_ptr<Shared> shared)
      : Session(std::move(shared)), stream_(std::move(stream)) {
    shared_->visits.push_back(this);
  }
  ~Visit() override { shared_->visits.remove(this); }

  void start() {
    lowest().expires_after(handshake_timeout);
    Kind::begin(stream_, [self = this->shared_from_this()](Code failed) {
      if (!failed) self->read();
    });
  }

  void end() override {
    Code ignored;
    lowest().socket().close(ignored);
  }

 private:
  beast::tcp_stream& lowest() { return beast::get_lowest_layer(stream_); }

  void read() {
    parser_.emplace();
    parser_->header_limit(longest_header);
    parser_->body_limit(0);
    lowest().expires_after(request_timeout);
    http::async_read(
        stream_, buffer_, *parser_, [self = this->shared_from_this()](Code failed, std::size_t) {
          if (!failed) return self->answer(self->parser_->get());
          if (const std::shared_ptr<Response> response = answer_to_noise(failed, *self->shared_))
            self->respond(response);
        });
  }

  void answer(const Request& request) {
    if (const std::shared_ptr<Response> response = answer_to(request, *shared_))
      return respond(response);
    lowest().expires_never();
    std::make_shared<Socket<Kind>>(std::move(stream_), shared_)->start(request);
  }

  void respond(const std::shared_ptr<Response>& response) {
    lowest().expires_after(response_timeout);
    http::async_write(stream_, *response,
                      [self = this->shared_from_this(), response](Code failed, std::size_t) {
                        if (failed) return;
                        if (response->keep_alive()) return self->read();
                        self->lowest().expires_after(handshake_timeout);
                        Kind::end(self->stream_, [self](Code) { self->drain(); });
                      });
  }

  /// Takes what still comes, for a while. Else the system would tell the other side that it was
  /// lost, and that side might then forget what it was answered.
  void drain() {
    if (drained_bytes_ > max_drained_bytes) return;
    buffer_.clear();
    lowest().async_read_some(buffer_.prepare(longest_header),
                             [self = this->shared_from_this()](Code failed, std::size_t size) {
                               self->drained_bytes_ += size;
                               if (!failed) self->drain();
                             });
  }

  typename Kind::Stream stream_;
  beast::flat_buffer buffer_{longest_header};
  std::size_t drained_bytes_ = 0;
  std::optional<http::request_parser<http::empty_body>> parser_;
};

}  // namespace crt::studio
