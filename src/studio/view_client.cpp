#include "studio/view_client.hpp"

#include <crt/error.hpp>
#include <crt/validate.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "studio/machine.hpp"
#include "studio/messages.hpp"
#include "studio/view_messages.hpp"

namespace crt::studio {

using nlohmann::json;

ViewClient::ViewClient(std::shared_ptr<Connection> connection, int threads, Show show)
    : connection_(std::move(connection)), renderer_(events(std::move(show)), threads) {
  on("camera", [this](const json& message) { set_camera(message); });
  on("acknowledge", [this](const json& message) {
    renderer_.acknowledge(message.at("picture").get<std::uint32_t>());
  });
  on("render", [this](const json& message) { render(message); });
  on("pick", [this](const json& message) { pick(message); });
  on("boxes", [this](const json& message) {
    const std::shared_ptr<const View> view = renderer_.view();
    const json result = view ? boxes_json(*view) : json(nullptr);
    send({{"type", "answer"}, {"id", message.at("id")}, {"result", result}});
  });
  on("machine", [this](const json&) { send(machine_message(machine_state())); });
  on("picture", [this](const json& message) { picture(message); });
  on("code", [this](const json& message) { code(message); });
}

void ViewClient::receive(std::string_view text) {
  json message;
  try {
    message = json::parse(text);
    const auto handler = handlers_.find(message.at("type").get<std::string>());
    if (handler == handlers_.end()) return complain("there is no message of this type", message);
    try {
      handler->second(message);
    } catch (const json::exception&) {
      complain("the message lacks something, or has it of another type", message);
    } catch (const Error& error) {
      complain(error.what(), message);
    }
  } catch (const json::exception&) {
    complain("this is no message of the studio's", {});
  }
}

RenderEvents ViewClient::events(Show show) {
  RenderEvents events{
      .picture = [this](const EncodedPicture& picture) { send_picture(picture); },
      .state = [this](const RenderState& state) { send(state_message(state)); },
      .scene = [this](const View& view) { send(scene_message(view)); },
      .finished = [this](const Revision& revision,
                         const Image& image) { send(finished_message(revision, image)); },
      .print =
          [this](const std::string& line) {
            send({{"type", "print"}, {"line", line}});
          }};
  if (show) {
    events.colors = [show = std::move(show)](const Revision& revision, const Image& image,
                                             bool is_whole) {
      show(std::filesystem::path(revision.name).filename().string(), image, is_whole);
    };
  }
  return events;
}

void ViewClient::send(const json& message) const {
  send_text(text_of(message));
}

/// The renderer's thread alone calls it.
void ViewClient::send_picture(const EncodedPicture& picture) {
  for (std::string& frame : frames_of(picture, last_picture_ ? &*last_picture_ : nullptr))
    connection_->send_binary(std::move(frame));
  last_picture_ = picture;
}

void ViewClient::complain(const std::string& why, const json& message) const {
  json error = {{"type", "error"}, {"message", why}};
  if (message.is_object() && message.contains("id")) error["id"] = message.at("id");
  if (message.is_object() && message.contains("type")) error["about"] = message.at("type");
  send(error);
}

void ViewClient::set_camera(const json& message) {
  const json& value = message.at("camera");
  if (value.is_null()) return renderer_.set_camera(std::nullopt);
  const Camera camera = camera_of(value);
  validate(camera);
  renderer_.set_camera(camera);
}

void ViewClient::render(const json& message) {
  const auto action = message.at("action").get<std::string>();
  if (action == "cancel") return renderer_.cancel();
  if (action == "restart") return renderer_.restart();
  throw Error(ErrorCode::invalid_argument, "a render is cancelled or restarted");
}

void ViewClient::pick(const json& message) {
  const double x = message.at("x").get<double>();
  const double y = message.at("y").get<double>();
  const std::shared_ptr<const View> view = renderer_.view();
  const json result = view ? pick_json(*view, x, y) : json(nullptr);
  send({{"type", "answer"}, {"id", message.at("id")}, {"result", result}});
}

/// Sends the last whole picture as a file.
void ViewClient::picture(const json& message) {
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

/// Answers with source code of the scene that is shown, or of an entity.
void ViewClient::code(const json& message) {
  const std::shared_ptr<const View> view = renderer_.view();
  if (!view) throw Error(ErrorCode::invalid_argument, "there is no scene yet");
  send({{"type", "answer"}, {"id", message.at("id")}, {"result", code_json(*view, message)}});
}

}  // namespace crt::studio
