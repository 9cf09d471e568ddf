#include "studio/session.hpp"

#include <system_error>

namespace crt::studio {

namespace {

const std::string content_policy =
    "default-src 'none'; script-src 'self'; style-src 'self'; style-src-attr 'unsafe-inline'; "
    "connect-src 'self'; img-src 'self' "
    "blob: data:; font-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors ";
constexpr const char* no_frames = "'none'";
constexpr const char* local_frames =
    "http://localhost:* http://127.0.0.1:* https://localhost:* vscode-webview:";

constexpr std::uint16_t port_of_http = 80;
constexpr std::uint16_t port_of_https = 443;

std::string_view view_of(beast::string_view text) {
  return {text.data(), text.size()};
}

std::unique_ptr<Response> respond(const Request& request, const Shared& shared, http::status status,
                                  const PageFile& file) {
  auto response = std::make_unique<Response>(status, request.version());
  response->set(http::field::content_type, beast::string_view(file.type.data(), file.type.size()));
  response->set(http::field::cache_control, "no-store");
  response->set("Content-Security-Policy",
                content_policy + (shared.options.may_be_framed ? local_frames : no_frames));
  response->set("X-Content-Type-Options", "nosniff");
  response->set("Referrer-Policy", "no-referrer");
  response->set("Cross-Origin-Opener-Policy", "same-origin");
  response->set("Cross-Origin-Resource-Policy", "same-origin");
  response->keep_alive(request.keep_alive() && status == http::status::ok);
  const std::size_t size = request.method() == http::verb::head ? 0 : file.content.size();
  response->body() = beast::span<const char>(file.content.data(), size);
  response->content_length(file.content.size());
  return response;
}

std::unique_ptr<Response> refusal(const Request& request, const Shared& shared, http::status status,
                                  std::string_view why) {
  return respond(request, shared, status, {why, "text/plain; charset=utf-8"});
}

}  // namespace

Session::Session(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {
  shared_->sessions.insert(this);
}

Session::~Session() {
  shared_->sessions.erase(this);
}

void Outbox::send(SocketMessage message) {
  if (!is_open_) return;
  {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
    if (messages_.size() > 1) return;
  }
  net::post(executor_, [self = shared_from_this()] {
    std::deque<SocketMessage> messages;
    {
      const std::lock_guard lock(self->mutex_);
      messages.swap(self->messages_);
    }
    self->take_(std::move(messages));
  });
}

std::shared_ptr<Desk> open_desk(const std::shared_ptr<Shared>& shared,
                                const net::any_io_executor& executor,
                                std::shared_ptr<Connection> connection,
                                std::function<void()> has_room, std::function<void()> has_ended) {
  // The desk is known by its place here, where its thread finds it only after this function.
  const auto place = std::make_shared<std::weak_ptr<Desk>>();
  DeskEvents events{
      .make_client = [make = shared->make_client,
                      connection = std::move(connection)] { return make(connection); },
      .has_room = [executor, has_room = std::move(has_room)] { net::post(executor, has_room); },
      .has_ended =
          [executor, place, has_ended = std::move(has_ended), all = std::weak_ptr(shared)] {
            net::post(executor, [place, has_ended, all] {
              has_ended();
              if (const auto known = all.lock()) known->desks.erase(place->lock());
            });
          }};
  try {
    auto desk = std::make_shared<Desk>(std::move(events));
    *place = desk;
    shared->desks.insert(desk);
    return desk;
  } catch (const std::system_error&) {
    return nullptr;
  }
}

std::unique_ptr<Response> answer_to_noise(Code failed, const Shared& shared) {
  // What the parser of requests says has a category of its own.
  if (failed.category() != Code(http::error::bad_method).category() ||
      failed == http::error::end_of_stream)
    return nullptr;
  if (failed == http::error::header_limit || failed == http::error::buffer_overflow)
    return refusal({}, shared, http::status::request_header_fields_too_large,
                   "The header is too long.");
  if (failed == http::error::body_limit || failed == http::error::unexpected_body)
    return refusal({}, shared, http::status::payload_too_large, "Requests have no body here.");
  return refusal({}, shared, http::status::bad_request, "This is no request.");
}

std::unique_ptr<Response> answer_to(const Request& request, const Shared& shared) {
  const auto refuse = [&](http::status status, std::string_view why) {
    return refusal(request, shared, status, why);
  };
  const std::string_view host = view_of(request[http::field::host]);
  const std::string_view target = view_of(request.target());
  const bool is_encrypted = shared.options.transport != nullptr;
  if (!shared.names.has(host, shared.port, is_encrypted ? port_of_https : port_of_http))
    return refuse(http::status::misdirected_request, "This is not the host's name.");
  if (!is_own_origin(view_of(request[http::field::origin]), is_encrypted ? "https" : "http", host))
    return refuse(http::status::forbidden, "Other pages may not ask.");
  const std::string_view path = target.substr(0, target.find('?'));
  if (path == "/socket") {
    if (!is_token(token_of(target), shared.options.token))
      return refuse(http::status::forbidden, "The token is wrong.");
    if (!websocket::is_upgrade(request))
      return refuse(http::status::upgrade_required, "This is a WebSocket.");
    if (shared.clients() >= shared.options.max_clients)
      return refuse(http::status::service_unavailable, "Too many pages are open.");
    return nullptr;
  }
  const auto file = shared.options.files.find(path);
  if (file == shared.options.files.end())
    return refuse(http::status::not_found, "There is no such page.");
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return refuse(http::status::method_not_allowed, "Pages can only be read.");
  return respond(request, shared, http::status::ok, file->second);
}

}  // namespace crt::studio
