#include "studio/view_client.hpp"

#include <crt/error.hpp>
#include <crt/validate.hpp>
#include <exception>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "studio/machine.hpp"
#include "studio/messages.hpp"
#include "studio/solid_messages.hpp"
#include "studio/view_messages.hpp"
#include "text/json.hpp"

namespace crt::studio {

using nlohmann::json;

namespace {

/// What a page hides are the most values that a message has: two numbers and a list each.
constexpr text::JsonLimits message_limits{.depth = 8, .values = 100'000};

}  // namespace

ViewClient::ViewClient(std::shared_ptr<Connection> connection, int threads)
    : connection_(std::move(connection)), renderer_(events(), threads) {
  on_while_open("camera", [this](const json& message) { set_camera(message); });
  on_while_open("acknowledge", [this](const json& message) {
    renderer_.acknowledge(text::whole_number<std::uint32_t>(message.at("picture")));
  });
  on_while_open("render", [this](const json& message) { render(message); });
  on_while_open("pick", [this](const json& message) { pick(message); });
  on_while_open("boxes", [this](const json& message) {
    const std::shared_ptr<const View> view = renderer_.view();
    const json result = view ? boxes_json(*view) : json(nullptr);
    send({{"type", "answer"}, {"id", id_of(message)}, {"result", result}});
  });
  on_while_open("machine", [this](const json&) { send(machine_message(machine_state())); });
  on_while_open("picture", [this](const json& message) { picture(message); });
  on_while_open("measure", [this](const json& message) { measure(message); });
  on_while_open("surface", [this](const json& message) { surface(message); });
  on_while_open("code", [this](const json& message) { code(message); });
}

void ViewClient::on_while_open(const char* type, Handler handler) {
  on(type, [this, handler = std::move(handler)](const json& message) {
    if (connection_->is_open()) handler(message);
  });
}

void ViewClient::receive(std::string_view text) {
  try {
    handle(text::parse_json(text, message_limits));
  } catch (const text::JsonError&) {
    complain("this is no message of the studio's", {});
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory", {});
  }
}

void ViewClient::handle(const json& message) {
  if (!message.is_object() || !message.contains("type") || !message.at("type").is_string())
    return complain("this is no message of the studio's", {});
  const auto handler = handlers_.find(message.at("type").get_ref<const std::string&>());
  if (handler == handlers_.end()) return complain("there is no message of this type", message);
  const char* const misses = "the message lacks something, or has it of another type";
  try {
    handler->second(message);
  } catch (const json::exception&) {
    complain(misses, message);
  } catch (const text::JsonError&) {
    complain(misses, message);
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory", message);
  } catch (const std::exception& error) {  // an Error, or one of the system
    complain(error.what(), message);
  }
}

json ViewClient::id_of(const json& message) {
  const json& id = message.at("id");
  if (!text::is_json_id(id))
    throw Error(ErrorCode::invalid_argument, "an id is a number or a short text");
  return id;
}

RenderEvents ViewClient::events() {
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

void ViewClient::send(const json& message) const {
  send_text(text_of(message));
}

/// The renderer's thread alone calls it.
void ViewClient::send_picture(const EncodedPicture& picture) {
  for (std::string& frame : frames_of(picture, last_picture_ ? &*last_picture_ : nullptr))
    connection_->send_binary(std::move(frame));
  last_picture_ = picture;
}

void ViewClient::complain(const char* why, const json& message) const noexcept {
  try {
    json error = {{"type", "error"}, {"message", why}};
    // Only what is short is repeated.
    for (const auto& [name, of] : {std::pair("id", "id"), std::pair("about", "type")}) {
      if (message.is_object() && message.contains(of) && text::is_json_id(message.at(of)))
        error[name] = message.at(of);
    }
    send(error);
  } catch (const std::exception&) {
    // There is no memory for it.
  }
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
  send({{"type", "answer"}, {"id", id_of(message)}, {"result", result}});
}

/// Sends the last whole picture as a file.
void ViewClient::picture(const json& message) {
  const std::shared_ptr<const Image> image = renderer_.picture();
  if (!image)
    throw Error(ErrorCode::invalid_argument,
                "there is no whole picture of the mode 'rendered' yet");
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
  send({{"type", "answer"}, {"id", id_of(message)}, {"result", code_json(*view, message)}});
}

/// Answers how much the entity is that comes from a piece of the text. Nothing is known of what has
/// none, and nothing is said of the entity before once another one is asked about.
void ViewClient::measure(const json& message) {
  const json id = id_of(message);
  const std::shared_ptr<const View> view = renderer_.view();
  std::optional<std::size_t> entity;
  try {
    if (view) entity = entity_of_span(*view, message.at("span"));
  } catch (const Error&) {
    // Nothing of the scene comes from there.
  }
  const json question = {{"type", "measure"}, {"id", id}};
  measuring_.start([this, view, entity, question](const NewestTask::GoesOn& goes_on) {
    answer(question, [&] {
      return entity && goes_on() ? measures_json(*view, *entity, goes_on) : json(nullptr);
    });
  });
}

/// Sends the surface of the scene, or of an entity, as a file.
void ViewClient::surface(const json& message) {
  const json id = id_of(message);
  const std::shared_ptr<const View> view = renderer_.view();
  if (!view) throw Error(ErrorCode::invalid_argument, "there is no scene yet");
  const SurfaceQuestion asked = surface_question_of(*view, message);
  const json question = {{"type", "surface"}, {"id", id}};
  exporting_.start([this, view, asked, question](const NewestTask::GoesOn& goes_on) {
    answer(question, [&] {
      if (!goes_on()) return json(nullptr);
      connection_->send_binary(surface_message(*view, asked, goes_on));
      return json(true);
    });
  });
}

/// Answers a question in another thread, also if that fails. It never throws.
void ViewClient::answer(const json& question, const std::function<json()>& result) const noexcept {
  try {
    send({{"type", "answer"}, {"id", question.at("id")}, {"result", result()}});
  } catch (const Error& error) {
    if (error.code() != ErrorCode::cancelled) return complain(error.what(), question);
    answer(question, [] { return json(nullptr); });
  } catch (const std::exception& error) {
    complain(error.what(), question);
  }
}

}  // namespace crt::studio
