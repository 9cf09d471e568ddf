// A desk is where a client works: in a thread of its own. So nothing that takes a page long, not
// even its end, keeps the server's thread from the others.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "studio/web_server.hpp"

namespace crt::studio {

/// DeskEvents come from the desk's thread.
struct DeskEvents {
  /// Makes the client. If it throws, the desk ends.
  std::function<std::unique_ptr<Client>()> make_client;
  /// Comes once there is room for messages again, after there was none.
  std::function<void()> has_room;
  /// Comes last, after the client's end. It may not destroy the desk itself.
  std::function<void()> has_ended;
};

class Desk {
 public:
  /// So many messages may wait, and so many bytes of them before the last.
  static constexpr std::size_t max_messages = 64;
  static constexpr std::size_t most_bytes = std::size_t{1} << 20;

  /// Throws std::system_error if there is no thread to be had.
  explicit Desk(DeskEvents events);
  /// Waits for the client's end.
  ~Desk();
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  /// Takes a message, whether there is room or not. Returns whether there is room for another.
  bool give(std::string message);
  /// Has the client end after the messages that it was given. It does not wait for that.
  void close();

 private:
  void work();
  std::optional<std::string> next();
  bool has_room() const { return messages_.size() < max_messages && bytes_ < most_bytes; }

  const DeskEvents events_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> messages_;
  std::size_t bytes_ = 0;  ///< of the messages
  bool is_closed_ = false;
  std::thread thread_;
};

}  // namespace crt::studio
