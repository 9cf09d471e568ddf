#include "core/base/memory_limit.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>

namespace crt::core {

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

}  // namespace crt::core
