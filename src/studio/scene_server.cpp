// This serves scenes of programs. Their pages have the protocol of scripts: the listing of the
// scene stands for the script, and cannot be changed.
#include <crt/error.hpp>
#include <crt/studio.hpp>
#include <crt/version.hpp>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>
#include <utility>

#include "studio/access.hpp"
#include "studio/listing.hpp"
#include "studio/messages.hpp"
#include "studio/page_files.hpp"
#include "studio/view_client.hpp"
#include "studio/view_messages.hpp"
#include "studio/web_server.hpp"
#include "text/json.hpp"

namespace crt::studio {

namespace {

using nlohmann::json;

/// A ShownScene is a scene with what pages show beside it.
struct ShownScene {
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const std::string> text;
  Listing listing;
};

std::shared_ptr<const ShownScene> shown_scene(Scene scene) {
  Listing listing = list_scene(scene);
  auto text = std::make_shared<const std::string>(listing.text);
  return std::make_shared<const ShownScene>(ShownScene{
      std::make_shared<const Scene>(std::move(scene)), std::move(text), std::move(listing)});
}

/// A SceneClient shows one page the scene. The page gives the listing a revision by sending it back
/// as the text that it shows.
class SceneClient : public ViewClient {
 public:
  SceneClient(std::shared_ptr<Connection> connection, const ServeOptions& options,
              std::shared_ptr<const ShownScene> shown)
      : ViewClient(std::move(connection), options.threads),
        title_(options.title),
        shown_(std::move(shown)) {
    on("open", [this](const json&) { send_text("opened"); });
    on("text", [this](const json& message) { take_text(message); });
    on("ask", [this](const json& message) {
      send({{"type", "answer"}, {"id", id_of(message)}, {"result", nullptr}});
    });
    on("save", [](const json&) {
      throw Error(ErrorCode::unsupported, "the scene is a program's, and cannot be saved here");
    });
    on("view", [this](const json& message) {
      const std::lock_guard lock(mutex_);
      renderer().set_options(view_options_of(message.at("view"), TextPlaces(*shown_->text)));
    });
    on("look", [](const json&) {});
    on("forget", [](const json&) {});
    send({{"type", "hello"},
          {"version", version()},
          {"folder", ""},
          {"script", title_},
          {"scripts", json::array({title_})},
          {"readOnly", true},
          {"objects", json::array()}});
  }

  /// Any thread may call it.
  void show(std::shared_ptr<const ShownScene> shown) {
    const std::lock_guard lock(mutex_);
    const bool is_listed_alike = *shown->text == *shown_->text;
    shown_ = std::move(shown);
    if (!is_listed_alike) {
      send_changed("changed");
    } else if (has_revision_) {
      render_shown();
    }
  }

 private:
  void send_text(const char* type) {
    const std::lock_guard lock(mutex_);
    send_changed(type);
  }

  // The mutex is locked for these.
  void send_changed(const char* type) const {
    send({{"type", type}, {"script", title_}, {"text", *shown_->text}, {"readOnly", true}});
  }
  void render_shown() {
    renderer().set_script({revision_, title_, shown_->text, shown_->scene, shown_->listing.places});
  }

  void take_text(const json& message) {
    const auto text = message.at("text").get<std::string>();
    const auto revision = text::whole_number<std::uint32_t>(message.at("revision"));
    const std::shared_ptr<const ShownScene> shown = shown_or_changed(text);
    if (!shown) return;
    if (message.contains("view"))
      renderer().set_options(view_options_of(message.at("view"), TextPlaces(text)));
    // The program may show another scene meanwhile, which does not wait for this one's list.
    send(listing_message(shown->listing, revision));
    send({{"type", "diagnostics"}, {"revision", revision}, {"diagnostics", json::array()}});
    const std::lock_guard lock(mutex_);
    if (text != *shown_->text) return;  // the page knows
    revision_ = revision;
    has_revision_ = true;
    render_shown();
  }

  /// Returns what is shown if it is listed by this text. If not, it says how it is.
  std::shared_ptr<const ShownScene> shown_or_changed(const std::string& text) {
    const std::lock_guard lock(mutex_);
    if (text == *shown_->text) return shown_;
    send_changed("changed");
    return nullptr;
  }

  const std::string title_;
  std::mutex mutex_;
  std::shared_ptr<const ShownScene> shown_;
  std::uint32_t revision_ = 0;
  bool has_revision_ = false;
};

/// The SceneHub knows the scene and who looks at it.
class SceneHub {
 public:
  explicit SceneHub(Scene scene) : shown_(shown_scene(std::move(scene))) {}

  void show(Scene scene) {
    auto shown = shown_scene(std::move(scene));
    const std::lock_guard lock(mutex_);
    shown_ = std::move(shown);
    for (SceneClient* client : clients_) client->show(shown_);
  }

  std::shared_ptr<const ShownScene> add(SceneClient* client) {
    const std::lock_guard lock(mutex_);
    clients_.insert(client);
    return shown_;
  }
  void remove(SceneClient* client) {
    const std::lock_guard lock(mutex_);
    clients_.erase(client);
  }
  std::shared_ptr<const ShownScene> shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const ShownScene> shown_;
  std::set<SceneClient*> clients_;
};

/// A HubClient is a client that the hub knows as long as it lives.
class HubClient : public Client {
 public:
  HubClient(std::shared_ptr<SceneHub> hub, std::shared_ptr<Connection> connection,
            const ServeOptions& options)
      : hub_(std::move(hub)), client_(std::move(connection), options, hub_->shown()) {
    client_.show(hub_->add(&client_));
  }
  ~HubClient() override { hub_->remove(&client_); }
  HubClient(const HubClient&) = delete;
  HubClient& operator=(const HubClient&) = delete;

  void receive(std::string_view text) override { client_.receive(text); }

 private:
  std::shared_ptr<SceneHub> hub_;
  SceneClient client_;
};

std::uint16_t checked_port(int port) {
  constexpr int highest = 65535;
  if (port >= 0 && port <= highest) return static_cast<std::uint16_t>(port);
  throw Error(ErrorCode::invalid_argument, "port must be from 0 to 65535", "port");
}

}  // namespace

}  // namespace crt::studio

namespace crt {

using namespace studio;

class SceneServer::State {
 public:
  State(Scene scene, const ServeOptions& options)
      : hub_(std::make_shared<SceneHub>(std::move(scene))),
        token_(make_token()),
        server_({.port = checked_port(options.port),
                 .token = token_,
                 .files = page_files(),
                 .ends_by_signals = false},
                [hub = hub_, options](std::shared_ptr<Connection> connection) {
                  return std::make_unique<HubClient>(hub, std::move(connection), options);
                }),
        thread_([this] { server_.run(); }) {}
  ~State() {
    server_.stop();
    thread_.join();
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  std::string address() const {
    return "http://127.0.0.1:" + std::to_string(server_.port()) + "/#token=" + token_;
  }
  void show(Scene scene) { hub_->show(std::move(scene)); }

 private:
  std::shared_ptr<SceneHub> hub_;
  std::string token_;
  WebServer server_;
  std::thread thread_;
};

SceneServer::SceneServer(Scene scene, const ServeOptions& options)
    : state_(std::make_unique<State>(std::move(scene), options)) {}

SceneServer::~SceneServer() = default;

std::string SceneServer::address() const {
  return state_->address();
}

void SceneServer::show(Scene scene) {
  state_->show(std::move(scene));
}

}  // namespace crt
