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

/// Faces, leaves and nodes have numbers of 32 bits, and a primitive may have some of each.
constexpr std::uint64_t most_numbered = std::uint64_t{1} << 25;

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

/// Counts primitives, but stops at more than can be numbered.
std::uint64_t count(std::span<const Entity> entities) {
  std::uint64_t result = 0;
  for (const Entity& entity : entities) {
    result += std::min(entity.primitive_count(), most_numbered + 1);
    if (result > most_numbered) break;
  }
  return result;
}

}  // namespace

void check_primitive_count(std::span<const Entity> entities, Precision precision,
                           std::uint64_t most) {
  constexpr std::uint64_t few = std::uint64_t{1} << 16;  // for which the limit is not computed
  const std::uint64_t primitives = count(entities);
  if (primitives > most_numbered) {
    throw Error(ErrorCode::limit,
                fmt::format("the scene has more than {} primitives", most_numbered), "entities");
  }
  if (most != 0 && primitives > most) {
    throw Error(
        ErrorCode::limit,
        fmt::format("the scene has {} primitives, more than {} (max_primitives)", primitives, most),
        "entities");
  }
  if (most != 0 || primitives <= few) return;
  const std::uint64_t fitting = memory_limit() / bytes_to_prepare(precision);
  if (primitives <= fitting) return;
  throw Error(
      ErrorCode::limit,
      fmt::format("the scene has {} primitives, but the memory here may be enough for {} only "
                  "(see max_primitives)",
                  primitives, fitting),
      "entities");
}

}  // namespace crt::core
