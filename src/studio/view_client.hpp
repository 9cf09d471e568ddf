// A ViewClient is what clients have in common that show pictures: it renders, moves the camera and
// answers what a picture shows. Others add messages of their own.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "studio/newest_task.hpp"
#include "studio/picture_frame.hpp"
#include "studio/renderer.hpp"
#include "studio/web_server.hpp"

namespace crt::studio {

class ViewClient : public Client {
 public:
  ViewClient(std::shared_ptr<Connection> connection, int threads);

  void receive(std::string_view text) override;

 protected:
  /// Takes a message of one type. It may throw what reading JSON throws, and Error.
  using Handler = std::function<void(const nlohmann::json&)>;

  /// Says what takes messages of a type.
  void on(const char* type, Handler handler) { handlers_[type] = std::move(handler); }
  /// Says what takes messages that nobody needs once the connection has ended.
  void on_while_open(const char* type, Handler handler);
  void send(const nlohmann::json& message) const;
  /// Sends a message that is text already.
  void send_text(std::string text) const { connection_->send_text(std::move(text)); }
  /// Returns the id of a message. Throws Error (invalid_argument) if that is no number or short
  /// text.
  static nlohmann::json id_of(const nlohmann::json& message);
  /// Answers a message with what is wrong with it, if there is memory for that. It never throws.
  void complain(const char* why, const nlohmann::json& message) const noexcept;
  Renderer& renderer() { return renderer_; }

 private:
  RenderEvents events();
  void handle(const nlohmann::json& message);
  void send_picture(const EncodedPicture& picture);
  void set_camera(const nlohmann::json& message);
  void render(const nlohmann::json& message);
  void pick(const nlohmann::json& message);
  void picture(const nlohmann::json& message);
  void code(const nlohmann::json& message);
  void measure(const nlohmann::json& message);
  void surface(const nlohmann::json& message);
  void answer(const nlohmann::json& question,
              const std::function<nlohmann::json()>& result) const noexcept;

  const std::shared_ptr<Connection> connection_;
  std::map<std::string, Handler, std::less<>> handlers_;
  std::optional<EncodedPicture> last_picture_;
  Renderer renderer_;
  // These use all that is above, and end first.
  NewestTask measuring_;
  NewestTask exporting_;
};

}  // namespace crt::studio
