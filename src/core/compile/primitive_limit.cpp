#include "core/compile/primitive_limit.hpp"

#include "core/base/memory_limit.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

void PrimitiveLimit::check(const Instancing::Count& count) const {
  if (!is_limited_) return;
  constexpr std::uint64_t few = std::uint64_t{1} << 16;  // for which memory is not looked at
  const std::uint64_t primitives = count.primitives + count.instances;
  if (primitives > max_numbered) {
    throw Error(ErrorCode::limit,
                text::format("the scene has more than {} primitives", max_numbered), "entities");
  }
  if (most_ != 0 && primitives > most_) {
    throw Error(ErrorCode::limit,
                text::format("the scene has {} primitives, more than {} (max_primitives)",
                             primitives, most_),
                "entities");
  }
  if (most_ != 0 || primitives <= few) return;
  const std::uint64_t limit = memory_limit();
  const std::uint64_t of_primitive = bytes_to_prepare(precision_);
  if (of_primitive * count.primitives + bytes_of_instance * count.instances <= limit) return;
  throw Error(
      ErrorCode::limit,
      text::format("the scene has {} primitives, but the memory here may be enough for {} only "
                   "(see max_primitives)",
                   primitives, limit / of_primitive),
      "entities");
}

}  // namespace crt::core
