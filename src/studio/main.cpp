// The program crt-studio serves the studio. The command `crt studio` starts it, and has read the
// command line. It passes words of the form NAME=VALUE: those that `take` knows, each of which may
// be left out.
#include <crt/error.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studio/access.hpp"
#include "studio/folder.hpp"
#include "studio/ip_address.hpp"
#include "studio/page_files.hpp"
#include "studio/studio_client.hpp"
#include "studio/tls.hpp"
#include "studio/web_server.hpp"

namespace {

using namespace crt::studio;

enum ExitStatus { done = 0, usage = 2, files = 3, internal = 70 };

/// A Task is what the command asks for.
struct Task {
  std::string folder = ".";
  StudioOptions studio;
  WebServerOptions server;
  std::string certificate;
  std::string key;
};

/// Takes a word. Returns false if it is none of those that the command passes.
bool take(Task& task, std::string_view name, const std::string& value) {
  if (name == "folder") {
    task.folder = value;
  } else if (name == "script") {
    task.studio.script = value;
  } else if (name == "port") {
    task.server.port = static_cast<std::uint16_t>(std::atoi(value.c_str()));
  } else if (name == "threads") {
    task.studio.threads = std::atoi(value.c_str());
  } else if (name == "listen") {
    task.server.address = value;
  } else if (name == "name") {
    task.server.names.push_back(value);
  } else if (name == "tls-cert") {
    task.certificate = value;
  } else if (name == "tls-key") {
    task.key = value;
  } else if (name == "embed") {
    task.server.ends_with_input = task.server.may_be_framed = value == "yes";
  } else {
    return false;
  }
  return true;
}

std::optional<Task> task_of(int argc, char** argv) {
  Task task;
  for (const std::string_view word : std::vector<std::string_view>(argv + 1, argv + argc)) {
    const std::size_t equals = word.find('=');
    if (equals == std::string_view::npos ||
        !take(task, word.substr(0, equals), std::string(word.substr(equals + 1))))
      return std::nullopt;
  }
  return task;
}

/// Returns what browsers call the server in URLs, wherever they are.
std::vector<std::string> hosts_of(const WebServerOptions& options) {
  if (!options.names.empty()) return options.names;
  const std::optional<IpAddress> listened = IpAddress::parse(options.address);
  if (!listened) return {options.address};
  if (!listened->is_any()) return {listened->in_url()};
  std::vector<std::string> hosts;
  for (const IpAddress& address : machine_addresses()) {
    if (address.is_ipv4() || !listened->is_ipv4()) hosts.push_back(address.in_url());
  }
  if (hosts.empty()) hosts.emplace_back("localhost");
  return hosts;
}

void warn_of_listeners(const WebServerOptions& options) {
  const std::optional<IpAddress> listened = IpAddress::parse(options.address);
  if (options.transport || !listened || listened->is_loopback()) return;
  std::fputs(
      "crt: warning: this is not safe: anybody on the way can read the token and the script, and "
      "then change scripts. --tls-cert encrypts what goes over the network\n",
      stderr);
}

int serve(Task task) {
  const auto folder = std::make_shared<const Folder>(task.folder);
  WebServerOptions& options = task.server;
  options.token = make_token();
  options.files = page_files();
  if (!task.certificate.empty())
    options.transport = make_tls(task.certificate, task.key.empty() ? task.certificate : task.key);
  const auto pages = std::make_shared<OpenPages>();
  WebServer server(options, [&](std::shared_ptr<Connection> connection) {
    return make_studio_client(std::move(connection), folder, pages, task.studio);
  });
  warn_of_listeners(options);
  for (const std::string& host : hosts_of(options))
    std::printf("The studio is at http%s://%s:%d/#token=%s\n", options.transport ? "s" : "",
                host.c_str(), server.port(), options.token.c_str());
  std::fflush(stdout);
  server.run();
  return done;
}

}  // namespace

int main(int argc, char** argv) try {
  std::optional<Task> task = task_of(argc, argv);
  if (!task) {
    std::fputs("crt-studio is started by `crt studio`\n", stderr);
    return usage;
  }
  return serve(std::move(*task));
} catch (const crt::Error& error) {
  std::fprintf(stderr, "crt: error: %s\n", error.what());
  return files;
} catch (const std::exception& error) {
  std::fprintf(stderr, "crt: error: %s\n", error.what());
  return internal;
}
