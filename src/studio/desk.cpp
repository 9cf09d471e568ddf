#include "studio/desk.hpp"

#include <exception>
#include <utility>

namespace crt::studio {

Desk::Desk(DeskEvents events) : events_(std::move(events)), thread_([this] { work(); }) {}

Desk::~Desk() {
  close();
  thread_.join();
}

bool Desk::give(std::string message) {
  const std::lock_guard lock(mutex_);
  bytes_ += message.size();
  messages_.push_back(std::move(message));
  changed_.notify_all();
  return has_room();
}

void Desk::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  changed_.notify_all();
}

std::optional<std::string> Desk::next() {
  std::string message;
  bool makes_room = false;
  {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return is_closed_ || !messages_.empty(); });
    if (messages_.empty()) return std::nullopt;
    makes_room = !has_room();
    message = std::move(messages_.front());
    messages_.pop_front();
    bytes_ -= message.size();
    makes_room = makes_room && has_room();
  }
  if (makes_room) events_.has_room();
  return message;
}

void Desk::work() {
  try {
    const std::unique_ptr<Client> client = events_.make_client();
    while (const std::optional<std::string> message = next()) client->receive(*message);
  } catch (const std::exception&) {
    // There is no memory or no thread left. The page may come again.
  }
  events_.has_ended();
}

}  // namespace crt::studio
