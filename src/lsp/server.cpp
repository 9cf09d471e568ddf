#include "lsp/server.hpp"

#include <algorithm>
#include <deque>
#include <exception>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "lsp/frames.hpp"
#include "lsp/requests.hpp"
#include "text/json.hpp"

namespace crt::lsp {

using nlohmann::json;

namespace {

/// The protocol has no use for more.
constexpr text::JsonLimits message_limits{.depth = 64};

/// Returns a message's id, or null where it has none that an answer could name.
json id_of(const json& message) {
  if (!message.is_object() || !message.contains("id")) return nullptr;
  const json& id = message.at("id");
  return text::is_json_id(id) && !id.is_number_float() ? id : json(nullptr);
}

}  // namespace

class Server::Session {
 public:
  explicit Session(Send send) : send_(std::move(send)) {}

  void receive(std::string_view bytes) {
    frames_.add(bytes);
    while (const auto frame = frames_.next()) {
      if (frame->problem.empty()) {
        take(frame->body);
      } else {
        refuse(nullptr, parse_error, std::string(frame->problem));
      }
    }
  }

  bool has_work() const { return !waiting_.empty() || requests_.has_unchecked(); }

  void work() {
    if (waiting_.empty()) {
      for (const json& notification : requests_.check_next()) send(notification);
      return;
    }
    const json message = std::move(waiting_.front());
    waiting_.pop_front();
    if (message.contains("id")) {
      answer(message);
    } else {
      notice(message);
    }
  }

  bool is_finished() const { return is_finished_; }
  bool was_shut_down() const { return state_ == State::shut_down; }

 private:
  enum class State { created, running, shut_down };

  /// Puts a message in the queue, or takes one out that is cancelled.
  void take(const std::string& body) {
    json message;
    try {
      message = text::parse_json(body, message_limits);
    } catch (const text::JsonError& error) {
      return refuse(nullptr, parse_error, error.what());
    }
    const bool is_object = message.is_object();
    const bool has_method =
        is_object && message.contains("method") && message.at("method").is_string();
    // What has a result or an error answers a request that was never made.
    if (is_object && !has_method && (message.contains("result") || message.contains("error")))
      return;
    const bool has_fine_id = is_object && (!message.contains("id") || !id_of(message).is_null());
    if (!has_method || !has_fine_id)
      return refuse(id_of(message), invalid_request, "this is no request");
    if (message.at("method") == "$/cancelRequest") return cancel(message);
    waiting_.push_back(std::move(message));
  }

  void cancel(const json& message) {
    const json::json_pointer path("/params/id");
    if (!message.contains(path)) return;
    const auto cancelled = std::find_if(waiting_.begin(), waiting_.end(), [&](const json& request) {
      return request.contains("id") && request.at("id") == message.at(path);
    });
    if (cancelled == waiting_.end()) return;
    refuse(id_of(*cancelled), request_cancelled, "the request was cancelled");
    waiting_.erase(cancelled);
  }

  void answer(const json& message) {
    const json id = id_of(message);
    try {
      send({{"jsonrpc", "2.0"}, {"id", id}, {"result", result_of(message)}});
    } catch (const RequestError& error) {
      refuse(id, error.code, error.what());
    } catch (const json::exception& error) {
      refuse(id, invalid_params, error.what());
    } catch (const std::exception& error) {
      refuse(id, internal_error, error.what());
    }
  }

  json result_of(const json& message) {
    const auto method = message.at("method").get<std::string>();
    const json nothing = json::object();
    const json& params = message.contains("params") ? message.at("params") : nothing;
    if (method == "initialize") {
      if (state_ != State::created)
        throw RequestError(invalid_request, "the server is initialized already");
      json capabilities = requests_.initialize(params);
      state_ = State::running;
      return {{"capabilities", std::move(capabilities)}, {"serverInfo", {{"name", "crt lsp"}}}};
    }
    if (state_ == State::created)
      throw RequestError(server_not_initialized, "'initialize' comes first");
    if (state_ == State::shut_down)
      throw RequestError(invalid_request, "the server has been shut down");
    if (method == "shutdown") {
      state_ = State::shut_down;
      return nullptr;
    }
    return requests_.handle(method, params);
  }

  void notice(const json& message) {
    const auto method = message.at("method").get<std::string>();
    if (method == "exit") is_finished_ = true;
    if (state_ != State::running || !message.contains("params")) return;
    try {
      for (const json& notification : requests_.notify(method, message.at("params")))
        send(notification);
    } catch (const std::exception& error) {
      // A notification has no answer. What is wrong with it is shown in the editor's log.
      constexpr int warning = 2;
      send({{"jsonrpc", "2.0"},
            {"method", "window/logMessage"},
            {"params", {{"type", warning}, {"message", method + ": " + error.what()}}}});
    }
  }

  void refuse(const json& id, int code, const std::string& message) {
    send({{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", code}, {"message", message}}}});
  }

  void send(const json& message) {
    // A text may hold what is not UTF-8, and JSON may not.
    send_(framed(message.dump(-1, ' ', false, json::error_handler_t::replace)));
  }

  Send send_;
  FrameReader frames_;
  std::deque<json> waiting_;
  Requests requests_;
  State state_ = State::created;
  bool is_finished_ = false;
};

Server::Server(Send send) : session_(std::make_unique<Session>(std::move(send))) {}

Server::~Server() = default;

void Server::receive(std::string_view bytes) {
  session_->receive(bytes);
}

bool Server::has_work() const {
  return session_->has_work();
}

void Server::work() {
  session_->work();
}

bool Server::is_finished() const {
  return session_->is_finished();
}

bool Server::was_shut_down() const {
  return session_->was_shut_down();
}

}  // namespace crt::lsp
