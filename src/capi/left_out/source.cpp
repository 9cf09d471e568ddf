// This stands for crt_source, so that the C interface has all of its functions without it.
#include "crt/error.hpp"
#include "crt/source_code.hpp"
#include "text/left_out.hpp"

namespace crt {

namespace {

[[noreturn]] void refuse_source() {
  throw Error(ErrorCode::unsupported, text::left_out("descriptions of scenes as text", "SOURCE"));
}

}  // namespace

std::vector<std::string> save_script(const Scene&, const std::filesystem::path&) {
  refuse_source();
}

std::vector<EntityDescription> describe_entities(const Scene&, std::size_t) {
  refuse_source();
}

std::string descriptions_to_json(const std::vector<EntityDescription>&) {
  refuse_source();
}

}  // namespace crt
