// This says how busy the machine is, and how much memory it has left.
#pragma once

#include <cstdint>
#include <optional>

namespace crt::studio {

/// A MachineState has what the system says. Memory is in bytes.
struct MachineState {
  unsigned cores = 0;
  std::optional<double> load{};  ///< how many threads wanted to run, over the last minute
  std::optional<std::uint64_t> memory{};
  std::optional<std::uint64_t> free_memory{};
  std::optional<std::uint64_t> studio_memory{};  ///< of this process
};

MachineState machine_state();

}  // namespace crt::studio
