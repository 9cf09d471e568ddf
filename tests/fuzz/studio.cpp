// This fuzzer plays a page of the studio. It opens a script, waits for its picture, and then sends
// each line of the input as a message. The studio must live on, and may say only what is JSON.
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <crt/file.hpp>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "studio/folder.hpp"
#include "studio/open_pages.hpp"
#include "studio/studio_client.hpp"

namespace {

using namespace crt::studio;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::string_view script =
    "Settings { width -> 8 height -> 6 }\n"
    "red = Material { color -> rgb(1, 0.1, 0.1) }\n"
    "Scene { Box { cornerA -> vec3(0, 0, 0) cornerB -> vec3(1, 1, 1) material -> red }\n"
    "- Sphere { center -> vec3(t, 1, 0) radius -> 0.5 } }\n";

/// A FuzzedFolder is the folder that the studio has open.
struct FuzzedFolder {
  fs::path path = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
  std::shared_ptr<const Folder> folder;

  FuzzedFolder() {
    path /= "crt-fuzz-studio-" + std::to_string(getpid());
    fs::remove_all(path);
    fs::create_directories(path);
    folder = std::make_shared<const Folder>(path);
  }
  ~FuzzedFolder() { fs::remove_all(path); }
};

/// A Page takes what the studio sends.
class Page : public Connection {
 public:
  void send_text(std::string text) override {
    const json message = json::parse(text);  // aborts by throwing
    const std::lock_guard lock(mutex_);
    if (message.at("type") == "finished") is_finished_ = true;
    changed_.notify_all();
  }
  void send_binary(std::string bytes) override {
    if (bytes.substr(0, 3) != "CRT") std::abort();
  }
  void wait_for_the_picture() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return is_finished_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_finished_ = false;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const FuzzedFolder fuzzed;
  crt::write_file(fuzzed.path / "a.crt", script);
  const auto page = std::make_shared<Page>();
  const auto client = make_studio_client(page, fuzzed.folder, std::make_shared<OpenPages>(),
                                         {.script = "a.crt", .threads = 1});
  client->receive(R"({"type":"open","script":"a.crt"})");
  client->receive(
      json{{"type", "text"}, {"revision", 1}, {"script", "a.crt"}, {"text", script}}.dump());
  page->wait_for_the_picture();
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    client->receive(line);
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
  }
  return 0;
}
