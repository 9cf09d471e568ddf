// This fuzzer plays a client of the language server. The first byte chooses between raw bytes, a
// text that is formatted twice, and one that is opened and asked about at some places. The server
// must live on and answer each request once.
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "format/format.hpp"
#include "lsp/frames.hpp"
#include "lsp/server.hpp"

namespace {

using nlohmann::json;

void require(bool condition) {
  if (!condition) std::abort();
}

class Client {
 public:
  Client() : server_([this](std::string_view bytes) { take(bytes); }) {
    ask("initialize", {{"capabilities", json::object()}});
  }

  void send(std::string_view bytes) {
    server_.receive(bytes);
    while (server_.has_work() && !server_.is_finished()) server_.work();
  }

  void ask(const char* method, const json& params) {
    answers_ = 0;
    send(crt::lsp::framed(
        json{{"jsonrpc", "2.0"}, {"id", 1}, {"method", method}, {"params", params}}.dump(
            -1, ' ', false, json::error_handler_t::replace)));
    require(answers_ == 1);
  }

  void notify(const char* method, const json& params) {
    send(crt::lsp::framed(json{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}}.dump(
        -1, ' ', false, json::error_handler_t::replace)));
  }

 private:
  void take(std::string_view bytes) {
    crt::lsp::FrameReader reader;
    reader.add(bytes);
    const auto frame = reader.next();
    require(frame && frame->problem.empty());
    const json message = json::parse(frame->body);
    if (!message.contains("method")) ++answers_;
  }

  int answers_ = 0;
  crt::lsp::Server server_;
};

void ask_everywhere(Client& client, const std::string& text) {
  const json document = {{"uri", "untitled:fuzz"}};
  json item = document;
  item["version"] = 1;
  item["text"] = text;
  client.notify("textDocument/didOpen", {{"textDocument", item}});
  constexpr std::size_t max_places = 2;
  const std::size_t step = text.size() / max_places + 1;
  for (std::size_t i = 0; i <= text.size(); i += step) {
    const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
    const json params = {{"textDocument", document},
                         {"position", {{"line", line}, {"character", i % 40}}},
                         {"newName", "fuzz"}};
    for (const char* method :
         {"textDocument/completion", "textDocument/hover", "textDocument/definition",
          "textDocument/references", "textDocument/documentHighlight", "textDocument/prepareRename",
          "textDocument/rename", "textDocument/formatting", "textDocument/documentSymbol",
          "textDocument/semanticTokens/full"})
      client.ask(method, params);
    const json place = params.at("position");
    const json change = {{"range", {{"start", place}, {"end", place}}}, {"text", "x = y "}};
    client.notify("textDocument/didChange",
                  {{"textDocument", item}, {"contentChanges", json::array({change})}});
  }
}

void format_twice(const std::string& text) {
  const auto once = crt::format::format_script(text, "fuzz").text;
  if (once) require(crt::format::format_script(*once, "fuzz").text == once);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  constexpr int ways = 4;
  const int way = data[0] % ways;
  if (way == 1) {
    format_twice(text);
    return 0;
  }
  Client client;
  if (way == 0) {
    client.send(text);
    client.send(crt::lsp::framed(text));
  } else {
    ask_everywhere(client, text);
  }
  return 0;
}
