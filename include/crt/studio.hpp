// A program shows its scene in a browser: the live view, the entities and their properties, the
// camera and what was clicked at, as `crt studio` shows scripts. It belongs to the library
// crt::studio, which there is where CRT was built with the headers of Boost.
#pragma once

#include <crt/scene.hpp>
#include <memory>
#include <string>

namespace crt {

/// ServeOptions say how a scene is served.
struct ServeOptions {
  /// This is what the page calls the scene.
  std::string title = "scene";
  /// The port is from 1 to 65535, or 0 for one that is free.
  int port = 0;
  /// This is the number of threads that render at most. 0 takes as many as there are cores.
  int threads = 0;
};

/// A SceneServer serves a scene from a thread of its own, as long as it lives. It listens on
/// 127.0.0.1 alone, and lets nobody in who does not know the token in its address. Those who look
/// change nothing of the scene. Every page has its own camera.
class SceneServer {
 public:
  /// Listens at once. Throws Error: io if the port cannot be had, invalid_argument if it is none.
  explicit SceneServer(Scene scene, const ServeOptions& options = {});
  /// Closes all connections and waits for their renders to end.
  ~SceneServer();
  SceneServer(const SceneServer&) = delete;
  SceneServer& operator=(const SceneServer&) = delete;

  /// Returns what is to be opened in a browser: "http://127.0.0.1:4321/#token=...".
  std::string address() const;

  /// Shows another scene, which is a new revision, on all pages. What is rendered of the scene
  /// before is given up. A page that has moved its camera keeps it unless the scene's own changes.
  /// Any thread may call it.
  void show(Scene scene);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace crt
