#include "core/compile/primitive_limit.hpp"

#include <fmt/core.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "crt/error.hpp"

namespace crt::core {
namespace {

/// Returns the bytes that a process may have. The limits are those of the machine, of its container
/// (Linux's control groups, of either version) and of itself, whichever is the lowest.
std::uint64_t memory_limit() {
  std::uint64_t bytes = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                        static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
  rlimit own{};
  if (::getrlimit(RLIMIT_AS, &own) == 0 && own.rlim_cur != RLIM_INFINITY) {
    bytes = std::min<std::uint64_t>(bytes, own.rlim_cur);
  }
  for (const char* const path :
       {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
    std::uint64_t of_group = 0;
    if (std::ifstream(path) >> of_group) bytes = std::min(bytes, of_group);  // "max" is no number
  }
  return bytes;
}

}  // namespace

void PrimitiveLimit::check(const Instancing::Count& count) const {
  if (!is_limited_) return;
  constexpr std::uint64_t few = std::uint64_t{1} << 16;  // for which memory is not looked at
  const std::uint64_t primitives = count.primitives + count.instances;
  if (primitives > most_numbered) {
    throw Error(ErrorCode::limit,
                fmt::format("the scene has more than {} primitives", most_numbered), "entities");
  }
  if (most_ != 0 && primitives > most_) {
    throw Error(ErrorCode::limit,
                fmt::format("the scene has {} primitives, more than {} (max_primitives)",
                            primitives, most_),
                "entities");
  }
  if (most_ != 0 || primitives <= few) return;
  const std::uint64_t limit = memory_limit();
  const std::uint64_t of_primitive = bytes_to_prepare(precision_);
  if (of_primitive * count.primitives + bytes_of_instance * count.instances <= limit) return;
  throw Error(
      ErrorCode::limit,
      fmt::format("the scene has {} primitives, but the memory here may be enough for {} only "
                  "(see max_primitives)",
                  primitives, limit / of_primitive),
      "entities");
}

}  // namespace crt::core
