// The web server gives the page's files to browsers, and connects them with the studio by
// WebSocket. It lets nobody in who does not know the token, nor pages of other origins.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace crt::studio {

/// A Connection sends messages to one browser. Any thread may use it, also after its end.
class Connection {
 public:
  virtual ~Connection() = default;
  virtual void send_text(std::string text) = 0;
  virtual void send_binary(std::string bytes) = 0;
  /// Says whether anybody may still take what is sent.
  virtual bool is_open() const { return true; }
};

/// A Client is what is at the server's end of a connection. It is made, called and, when the
/// connection has ended, destroyed in a thread of its own, so that it may take its time.
class Client {
 public:
  virtual ~Client() = default;
  /// Takes a message. Those that came before the end of the connection also come after it.
  virtual void receive(std::string_view text) = 0;
};

/// A PageFile is a file that anybody may see.
struct PageFile {
  std::string_view content;
  std::string_view type;
};

/// A Transport says how bytes go between the server and browsers.
class Transport;

struct WebServerOptions {
  /// This is an IP address of the machine. 0.0.0.0 and :: stand for all of them.
  std::string address = "127.0.0.1";
  /// 0 lets the system choose.
  std::uint16_t port = 0;
  /// Browsers may call the server by these names, beside those that follow from the address.
  std::vector<std::string> names{};
  /// By this transport bytes go, as tls.hpp has one. Without it they are not encrypted.
  std::shared_ptr<const Transport> transport{};
  std::string token;
  std::map<std::string, PageFile, std::less<>> files{};  ///< by the path, "/" too
  /// SIGINT and SIGTERM end run(). A program that has signals of its own leaves them alone.
  bool ends_by_signals = true;
  /// The end of standard input ends run(), too: a program that started this one has ended.
  bool ends_with_input = false;
  /// Pages of this machine may show the page in a frame, as notebooks do.
  bool may_be_framed = false;
  /// Where there are more, one of those ends that have not shown the token.
  std::size_t max_connections = 64;
  /// Those count that have not come to their end yet, too.
  std::size_t max_clients = 16;
  std::size_t longest_message = std::size_t{16} << 20;
};

class WebServer {
 public:
  /// It may be called by several threads at once.
  using MakeClient = std::function<std::unique_ptr<Client>(std::shared_ptr<Connection>)>;

  /// Listens at once, and takes note of signals from then on if they are to end it. Throws Error:
  /// io if the address or port cannot be had, invalid_argument if the address is none.
  WebServer(const WebServerOptions& options, MakeClient make_client);
  /// Waits for the end of all clients.
  ~WebServer();
  WebServer(const WebServer&) = delete;
  WebServer& operator=(const WebServer&) = delete;

  std::uint16_t port() const;

  /// Serves until stop() is called, or a signal comes if that is to end it. Then all connections
  /// are closed.
  void run();
  /// Ends run(). Any thread may call it.
  void stop();

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace crt::studio
