// This stands for crt_lang, so that the C interface has all of its functions without it.
#include "crt/field.hpp"
#include "crt/script.hpp"
#include "text/left_out.hpp"

namespace crt {

namespace {

[[noreturn]] void refuse_script() {
  throw Error(ErrorCode::unsupported, text::left_out("scripts", "LANG"));
}

}  // namespace

ScriptResult run_script(std::string_view, const std::string&, const ScriptOptions&) {
  refuse_script();
}

ScriptResult run_script_file(const std::filesystem::path&, const ScriptOptions&) {
  refuse_script();
}

std::string format_diagnostic(const Diagnostic&) {
  refuse_script();
}

std::string diagnostics_to_json(const std::vector<Diagnostic>&) {
  refuse_script();
}

Field parse_field(std::string_view) {
  refuse_script();
}

Entity load_mesh(const std::filesystem::path&, const ScriptOptions&, std::optional<double>,
                 const MeshOptions&) {
  refuse_script();
}

}  // namespace crt
