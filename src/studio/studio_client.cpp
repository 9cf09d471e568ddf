#include "studio/studio_client.hpp"

#include <crt/error.hpp>
#include <crt/validate.hpp>
#include <crt/version.hpp>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "studio/analyst.hpp"
#include "studio/machine.hpp"
#include "studio/messages.hpp"
#include "studio/picture_frame.hpp"
#include "studio/renderer.hpp"
#include "studio/typed_keeper.hpp"
#include "studio/view_messages.hpp"

namespace crt::studio {

namespace {

using nlohmann::json;

/// Makes the line ends of a text those that pages have.
std::string with_plain_line_ends(const std::string& text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\r') {
      result += text[i];
    } else if (i + 1 == text.size() || text[i + 1] != '\n') {
      result += '\n';
    }
  }
  return result;
}

/// Makes the line ends those that some editors write.
std::string with_wide_line_ends(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n') result += '\r';
    result += c;
  }
  return result;
}

class StudioClient : public Client {
 public:
  StudioClient(std::shared_ptr<Connection> connection, std::shared_ptr<const Folder> folder,
               const StudioOptions& options)
      : connection_(std::move(connection)),
        folder_(std::move(folder)),
        handlers_{{"open", &StudioClient::open},       {"text", &StudioClient::take_text},
                  {"camera", &StudioClient::camera},   {"acknowledge", &StudioClient::acknowledge},
                  {"render", &StudioClient::render},   {"ask", &StudioClient::ask},
                  {"pick", &StudioClient::pick},       {"save", &StudioClient::save},
                  {"picture", &StudioClient::picture}, {"look", &StudioClient::look},
                  {"view", &StudioClient::view},       {"boxes", &StudioClient::boxes},
                  {"forget", &StudioClient::forget},   {"machine", &StudioClient::machine}},
        analyst_([this](const Analysis& analysis) { send(tokens_message(analysis)); },
                 [this](const Analysis& analysis) { send(diagnostics_message(analysis)); }),
        renderer_(events(), options.threads),
        keeper_(folder_) {
    send({{"type", "hello"},
          {"version", version()},
          {"folder", folder_->path().string()},
          {"script", options.script},
          {"scripts", folder_->scripts()},
          {"objects", objects_json()}});
  }

  void receive(std::string_view text) override {
    try {
      const json message = json::parse(text);
      const auto handler = handlers_.find(message.at("type").get<std::string>());
      if (handler == handlers_.end()) return complain("there is no message of this type", message);
      handle(handler->second, message);
    } catch (const json::exception&) {
      complain("this is no message of the studio's", {});
    }
  }

 private:
  using Handler = void (StudioClient::*)(const json&);

  RenderEvents events() {
    return {.picture = [this](const EncodedPicture& picture) { send_picture(picture); },
            .state = [this](const RenderState& state) { send(state_message(state)); },
            .scene = [this](const View& view) { send(scene_message(view)); },
            .finished = [this](const Revision& revision,
                               const Image& image) { send(finished_message(revision, image)); },
            .print =
                [this](const std::string& line) {
                  send({{"type", "print"}, {"line", line}});
                }};
  }

  void send(const json& message) const { connection_->send_text(text_of(message)); }

  /// The renderer's thread alone calls it.
  void send_picture(const EncodedPicture& picture) {
    for (std::string& frame : frames_of(picture, last_picture_ ? &*last_picture_ : nullptr))
      connection_->send_binary(std::move(frame));
    last_picture_ = picture;
  }

  void complain(const std::string& why, const json& message) const {
    json error = {{"type", "error"}, {"message", why}};
    if (message.is_object() && message.contains("id")) error["id"] = message.at("id");
    if (message.is_object() && message.contains("type")) error["about"] = message.at("type");
    send(error);
  }

  void handle(Handler handler, const json& message) {
    try {
      (this->*handler)(message);
    } catch (const json::exception&) {
      complain("the message lacks something, or has it of another type", message);
    } catch (const Error& error) {
      complain(error.what(), message);
    }
  }

  void open(const json& message) {
    const auto name = message.at("script").get<std::string>();
    on_disk_ = folder_->read(name);
    script_ = name;
    has_typed_ = false;
    const std::string text = with_plain_line_ends(*on_disk_);
    json opened = {{"type", "opened"}, {"script", name}, {"text", text}};
    const std::optional<std::string> typed = folder_->typed(name);
    if (typed && *typed != text) opened["typed"] = *typed;
    send(opened);
  }

  void take_text(const json& message) {
    auto text = std::make_shared<const std::string>(message.at("text").get<std::string>());
    if (text->size() > Folder::longest_script)
      throw Error(ErrorCode::limit, "the script is longer than 4 MiB");
    const std::string name = script_.empty() ? (folder_->path() / "untitled.crt").string()
                                             : folder_->file_of(script_).string();
    const Revision revision{message.at("revision").get<std::uint32_t>(), name, text};
    std::optional<ViewOptions> options;
    if (message.contains("view")) options = view_options_of(message.at("view"), Utf16Places(*text));
    text_ = std::move(text);
    if (!script_.empty() && message.value("script", "") == script_) keep_typed();
    analyst_.set_script(revision);
    renderer_.set_script(revision, std::move(options));
  }

  /// Keeps what is typed until it is what the file has. What others typed stays until then.
  void keep_typed() {
    if (!on_disk_ || *text_ != with_plain_line_ends(*on_disk_)) {
      keeper_.keep(script_, text_);
      has_typed_ = true;
    } else if (has_typed_) {
      keeper_.forget(script_);
    }
  }

  void view(const json& message) {
    if (!text_) throw Error(ErrorCode::invalid_argument, "there is no script to be viewed yet");
    renderer_.set_options(view_options_of(message.at("view"), Utf16Places(*text_)));
  }

  void boxes(const json& message) {
    const std::shared_ptr<const View> view = renderer_.view();
    const json result = view ? boxes_json(*view) : json(nullptr);
    send({{"type", "answer"}, {"id", message.at("id")}, {"result", result}});
  }

  void forget(const json& message) { keeper_.forget(message.at("script").get<std::string>()); }

  void machine(const json&) { send(machine_message(machine_state())); }

  void camera(const json& message) {
    const json& value = message.at("camera");
    if (value.is_null()) return renderer_.set_camera(std::nullopt);
    const Camera camera = camera_of(value);
    validate(camera);
    renderer_.set_camera(camera);
  }

  void acknowledge(const json& message) {
    renderer_.acknowledge(message.at("picture").get<std::uint32_t>());
  }

  void render(const json& message) {
    const auto action = message.at("action").get<std::string>();
    if (action == "cancel") return renderer_.cancel();
    if (action == "restart") return renderer_.restart();
    throw Error(ErrorCode::invalid_argument, "a render is cancelled or restarted");
  }

  void ask(const json& message) {
    using Answer = std::function<json(const Analysis&, std::uint32_t)>;
    static const std::map<std::string, Answer> answers = {
        {"completion", completion_json},
        {"hover", hover_json},
        {"definition", definition_json},
        {"places", places_json},
        {"preview", preview_json},
        {"format", [](const Analysis& analysis, std::uint32_t) { return format_json(analysis); }}};
    const auto answer = answers.find(message.at("what").get<std::string>());
    if (answer == answers.end()) throw Error(ErrorCode::invalid_argument, "nobody can answer this");
    const auto unit = message.at("at").get<std::uint32_t>();
    const auto revision = message.at("revision").get<std::uint32_t>();
    const json& id = message.at("id");
    const bool is_taken =
        analyst_.ask([this, unit, revision, id, answer](const Analysis& analysis) {
          const bool is_old = analysis.revision.number != revision;
          send({{"type", "answer"},
                {"id", id},
                {"revision", analysis.revision.number},
                {"result", is_old ? json(nullptr) : answer->second(analysis, unit)}});
        });
    if (!is_taken) throw Error(ErrorCode::limit, "there are too many questions at once");
  }

  void pick(const json& message) {
    const double x = message.at("x").get<double>();
    const double y = message.at("y").get<double>();
    const std::shared_ptr<const View> view = renderer_.view();
    const json result = view ? pick_json(*view, x, y) : json(nullptr);
    send({{"type", "answer"}, {"id", message.at("id")}, {"result", result}});
  }

  void save(const json& message) {
    const auto name = message.at("script").get<std::string>();
    auto text = message.at("text").get<std::string>();
    if (on_disk_ && on_disk_->find("\r\n") != std::string::npos) text = with_wide_line_ends(text);
    if (text.size() > Folder::longest_script)
      throw Error(ErrorCode::limit, "the script is longer than 4 MiB");
    const bool is_forced = message.value("force", false);
    if (!is_forced && has_changed_outside(name)) {
      return send({{"type", "conflict"},
                   {"script", name},
                   {"message", "'" + name + "' was changed by another program"}});
    }
    folder_->write(name, text);
    keeper_.forget(name);
    has_typed_ = false;
    script_ = name;
    on_disk_ = std::move(text);
    send({{"type", "saved"}, {"script", name}, {"scripts", folder_->scripts()}});
  }

  /// Says whether a file is not what it was when it was opened or saved here.
  bool has_changed_outside(const std::string& name) const {
    try {
      const std::string now = folder_->read(name);
      return name != script_ || now != on_disk_;
    } catch (const Error& error) {
      if (error.code() == ErrorCode::io) return false;  // there is none
      throw;
    }
  }

  /// Sends the script's file if another program has written it.
  void look(const json&) {
    if (script_.empty() || !on_disk_) return;
    std::string now;
    try {
      now = folder_->read(script_);
    } catch (const Error&) {
      return;  // it is gone, or is being written
    }
    if (now == *on_disk_) return;
    on_disk_ = std::move(now);
    send({{"type", "changed"}, {"script", script_}, {"text", with_plain_line_ends(*on_disk_)}});
  }

  /// Sends the last whole picture as a file.
  void picture(const json& message) {
    const std::shared_ptr<const Image> image = renderer_.picture();
    if (!image) throw Error(ErrorCode::invalid_argument, "there is no picture yet");
    const auto format = message.at("format").get<std::string>();
    if (format != "png" && format != "exr")
      throw Error(ErrorCode::invalid_argument, "pictures are png or exr");
    const std::vector<std::byte> bytes =
        image->encode(format, {.reproducible = true, .colors_only = true});
    std::string file = "CRTI" + format + " ";
    file.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    connection_->send_binary(std::move(file));
  }

  const std::shared_ptr<Connection> connection_;
  const std::shared_ptr<const Folder> folder_;
  const std::map<std::string, Handler, std::less<>> handlers_;
  std::string script_;
  std::optional<std::string> on_disk_;  ///< what the script's file had
  std::shared_ptr<const std::string> text_;
  bool has_typed_ = false;  ///< since the script was opened or saved
  std::optional<EncodedPicture> last_picture_;
  Analyst analyst_;
  Renderer renderer_;
  TypedKeeper keeper_;
};

}  // namespace

std::unique_ptr<Client> make_studio_client(std::shared_ptr<Connection> connection,
                                           std::shared_ptr<const Folder> folder,
                                           const StudioOptions& options) {
  return std::make_unique<StudioClient>(std::move(connection), std::move(folder), options);
}

}  // namespace crt::studio
