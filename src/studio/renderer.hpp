// The renderer makes pictures of the newest script and camera, coarse ones first. It runs scripts,
// prepares scenes and renders in a thread of its own, and gives up whatever is out of date.
#pragma once

#include <chrono>
#include <condition_variable>
#include <crt/job.hpp>
#include <crt/prepared_scene.hpp>
#include <crt/render.hpp>
#include <crt/script.hpp>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "studio/layers.hpp"
#include "studio/picture_frame.hpp"
#include "studio/view_options.hpp"

namespace crt::studio {

/// A Revision is a version of the script, or a scene that a program has made.
struct Revision {
  std::uint32_t number = 0;
  std::string name;  ///< the script's path
  std::shared_ptr<const std::string> text;
  std::shared_ptr<const Scene> scene{};  ///< what is shown if there is one, and no script is run
  std::vector<EntityPlace> places{};     ///< of its entities in the text
};

/// A View is what is shown: a scene that was prepared, and where its entities come from.
struct View {
  Revision revision;
  Scene scene;
  PreparedScene prepared;
  std::vector<EntityPlace> places;
  Camera camera{};  ///< with its lens, also where a mode shows all sharp
  bool camera_is_overridden = false;
  bool reads_time = false;                  ///< as ScriptResult has it
  std::shared_ptr<const Scene> original{};  ///< with the camera and the numbers that it came with
};

/// Says what the renderer does now.
struct RenderState {
  enum class Phase { script, preparing, rendering, done, cancelled, failed };
  Phase phase = Phase::done;
  std::uint32_t revision = 0;
  double progress = 0;
  double seconds = 0;  ///< since the script or the camera changed
  std::string message{};
};

/// RenderEvents come from the renderer's thread.
struct RenderEvents {
  std::function<void(const EncodedPicture&)> picture;
  std::function<void(const RenderState&)> state;
  std::function<void(const View&)> scene;
  std::function<void(const Revision&, const Image&)> finished;
  std::function<void(const std::string& line)> print;
};

class Renderer {
 public:
  explicit Renderer(RenderEvents events, int threads);
  /// Cancels what runs and waits for its end.
  ~Renderer();
  Renderer(const Renderer&) = delete;
  Renderer& operator=(const Renderer&) = delete;

  /// Takes a text, and with it the options if its places are meant by them.
  void set_script(Revision revision, std::optional<ViewOptions> options = {});
  void set_options(ViewOptions options);
  /// Replaces the script's camera, or gives that back.
  void set_camera(const std::optional<Camera>& camera);
  /// Says that the page has taken a picture.
  void acknowledge(std::uint32_t picture);
  /// Ends the render that runs. The next change starts another.
  void cancel();
  /// Renders again what was cancelled.
  void restart();

  /// Returns what is shown, or null before there is something. Any thread may call it.
  std::shared_ptr<const View> view() const;
  /// Returns the last picture that was finished, or null. Any thread may call it.
  std::shared_ptr<const Image> picture() const;

 private:
  using Clock = std::chrono::steady_clock;
  /// ShownEntities are what some options show of a scene.
  struct ShownEntities {
    ViewOptions options;
    std::vector<Entity> entities;
  };

  void work();
  void render_or_say_why();
  void render_newest();
  bool run_script();
  void take_scene(std::shared_ptr<const Scene> scene, std::vector<EntityPlace> places);
  Scene shown_scene();
  PreparedScene prepare_shown(const Scene& scene) const;
  void prepare_scene();
  const std::vector<BoundingBox>& boxes();
  void draw_drafts();
  void render_whole();
  void draw_draft(Scene draft, bool may_be_cancelled);
  bool takes_longer(int samples) const;
  int first_step() const;
  bool is_old() const;
  bool script_is_old() const;
  RenderOptions render_options() const;
  bool may_denoise() const;
  std::shared_ptr<const Image> denoised(const RenderJob& job) const;
  void finish(const RenderJob& job);
  void say(RenderState::Phase phase, double progress = 0, std::string message = {}) const;
  bool has_taken() const;
  bool may_send() const;
  void send(PictureKind kind, std::shared_ptr<const Image> image,
            std::shared_ptr<const Image> denoised = nullptr);
  bool is_to_be_shown_again() const;
  void send(const Layer& layer);
  void show_again();

  const RenderEvents events_;
  const int threads_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // What is asked for, by other threads.
  Revision asked_script_;
  std::optional<Camera> asked_camera_;
  ViewOptions asked_options_;
  std::uint64_t script_changes_ = 0;
  std::uint64_t changes_ = 0;          ///< of anything that is rendered
  std::uint64_t display_changes_ = 0;  ///< of how light is shown, and of nothing else
  bool is_cancelled_ = false;
  bool is_ended_ = false;
  std::uint32_t acknowledged_ = 0;
  std::shared_ptr<const View> view_;
  std::shared_ptr<const Image> picture_;

  // What the renderer's thread works on.
  std::uint64_t script_change_ = 0;
  std::uint64_t change_ = 0;
  std::uint64_t display_change_ = 0;
  Revision revision_;
  std::optional<Camera> camera_;
  ViewOptions options_;
  std::optional<Camera> script_camera_;    ///< of the last scene
  std::uint32_t scene_revision_ = 0;       ///< that the last scene is of
  double scene_t_ = 0;                     ///< the frame that it is of
  std::shared_ptr<const Scene> original_;  ///< as the script has it
  std::optional<Scene> scene_;             ///< with entities under numbers that say their places
  std::vector<EntityPlace> places_;
  bool reads_time_ = false;
  std::optional<ShownEntities> shown_;
  std::optional<std::vector<BoundingBox>> boxes_;  ///< of the scene, once they are needed
  std::optional<PreparedScene> prepared_;
  Layers layers_;
  std::uint32_t pictures_ = 0;
  double samples_a_second_ = 0;
  Clock::time_point start_;

  std::thread thread_;
};

}  // namespace crt::studio
