// The server speaks the Language Server Protocol (version 3.17) by JSON-RPC. It does no input and
// output itself: it is given bytes, and gives bytes to a callback. It never throws for what a
// client sends.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

namespace crt::lsp {

class Server {
 public:
  using Send = std::function<void(std::string_view)>;

  /// `send` gets what goes to the client.
  explicit Server(Send send);
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;
  ~Server();

  /// Takes bytes from the client. Requests wait until work() comes to them.
  void receive(std::string_view bytes);

  /// Says whether there is something to do for work().
  bool has_work() const;

  /// Handles the next message. If there is none, it checks a document that has changed. So texts
  /// are not checked as long as changes keep coming.
  void work();

  /// Says whether the client has asked to end.
  bool is_finished() const;

  /// Says whether the client asked for a shutdown before it asked to end, as it should.
  bool was_shut_down() const;

 private:
  class Session;
  std::unique_ptr<Session> session_;
};

}  // namespace crt::lsp
