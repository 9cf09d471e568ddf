// The requests and notifications about texts: each takes its parameters as JSON and gives its
// result as JSON. The server does what is around them.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "lsp/workspace.hpp"

namespace crt::lsp {

/// A RequestError is the answer to a request that cannot be done.
struct RequestError : std::runtime_error {
  RequestError(int new_code, const std::string& message)
      : std::runtime_error(message), code(new_code) {}
  int code;
};

// These are the codes of JSON-RPC and of the protocol.
constexpr int parse_error = -32700;
constexpr int invalid_request = -32600;
constexpr int method_not_found = -32601;
constexpr int invalid_params = -32602;
constexpr int internal_error = -32603;
constexpr int server_not_initialized = -32002;
constexpr int request_cancelled = -32800;
constexpr int request_failed = -32803;

class Requests {
 public:
  /// Takes what the client can, and returns what the server can.
  nlohmann::json initialize(const nlohmann::json& params);

  /// Handles a request and returns its result. Throws RequestError. What the JSON library throws
  /// says that the parameters are not as they should be.
  nlohmann::json handle(const std::string& method, const nlohmann::json& params);

  /// Handles a notification. Unknown ones are passed over. Returns notifications to send.
  std::vector<nlohmann::json> notify(const std::string& method, const nlohmann::json& params);

  bool has_unchecked() const { return workspace_.has_unchecked(); }
  /// Checks the next document, and returns notifications to send.
  std::vector<nlohmann::json> check_next();

 private:
  using Json = nlohmann::json;

  Document& document_of(const Json& params);
  std::uint32_t byte_of(const Document& document, const Json& params) const;
  Json completion(const Json& params);
  Json hover(const Json& params);
  Json definition(const Json& params);
  Json references(const Json& params);
  Json highlights(const Json& params);
  Json prepare_rename(const Json& params);
  Json rename(const Json& params);
  Json symbols(const Json& params);
  Json tokens(const Json& params);
  Json formatting(const Json& params);
  void open(const Json& params);
  void change(const Json& params);
  std::vector<Json> diagnostics_of(const std::vector<FileDiagnostics>& files) const;

  Workspace workspace_;
  bool takes_snippets_ = false;
};

}  // namespace crt::lsp
