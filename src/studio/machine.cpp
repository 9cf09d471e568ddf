#include "studio/machine.hpp"

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>
#include <thread>

namespace crt::studio {

namespace {

/// Reads a number of a file of the system, such as "MemTotal:  1024 kB", in bytes.
std::optional<std::uint64_t> bytes_in(const char* file, std::string_view key) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(key)) return std::strtoull(line.c_str() + key.size(), nullptr, 10) << 10U;
  }
  return std::nullopt;
}

}  // namespace

MachineState machine_state() {
  double load = 0;
  const bool has_load = getloadavg(&load, 1) == 1;
  return {.cores = std::thread::hardware_concurrency(),
          .load = has_load ? std::optional<double>(load) : std::nullopt,
          .memory = bytes_in("/proc/meminfo", "MemTotal:"),
          .free_memory = bytes_in("/proc/meminfo", "MemAvailable:"),
          .studio_memory = bytes_in("/proc/self/status", "VmRSS:")};
}

}  // namespace crt::studio
