// The program crt-studio serves the studio. The command `crt studio` starts it, and has read the
// command line: crt-studio FOLDER SCRIPT PORT THREADS [embed]. SCRIPT may be empty.
#include <crt/error.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <string_view>

#include "studio/access.hpp"
#include "studio/folder.hpp"
#include "studio/page_files.hpp"
#include "studio/studio_client.hpp"
#include "studio/web_server.hpp"

namespace {

using namespace crt::studio;

enum ExitStatus { done = 0, usage = 2, files = 3, internal = 70 };

int serve(const std::string& folder_name, const StudioOptions& options, int port, bool embed) {
  const auto folder = std::make_shared<const Folder>(folder_name);
  const std::string token = make_token();
  WebServer server({.port = static_cast<std::uint16_t>(port),
                    .token = token,
                    .files = page_files(),
                    .ends_with_input = embed,
                    .may_be_framed = embed},
                   [&](std::shared_ptr<Connection> connection) {
                     return make_studio_client(std::move(connection), folder, options);
                   });
  std::printf("The studio is at http://127.0.0.1:%d/#token=%s\n", server.port(), token.c_str());
  std::fflush(stdout);
  server.run();
  return done;
}

}  // namespace

int main(int argc, char** argv) try {
  constexpr int words = 5;
  const bool embed = argc == words + 1 && std::string_view(argv[words]) == "embed";
  if (argc != words && !embed) {
    std::fputs("crt-studio is started by `crt studio`\n", stderr);
    return usage;
  }
  return serve(argv[1], {.script = argv[2], .threads = std::atoi(argv[4])}, std::atoi(argv[3]),
               embed);
} catch (const crt::Error& error) {
  std::fprintf(stderr, "crt: error: %s\n", error.what());
  return files;
} catch (const std::exception& error) {
  std::fprintf(stderr, "crt: error: %s\n", error.what());
  return internal;
}
