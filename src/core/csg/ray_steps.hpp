// How much one ray may do is limited here, and its work may be stopped.
#pragma once

#include <cstdint>
#include <functional>

namespace crt::core {

/// A ray may take this many steps if nobody says otherwise. They are more than any picture needs,
/// and about a second's work.
inline constexpr std::uint64_t usual_most_steps = std::uint64_t{1} << 22;

/// So many steps are between two looks at whether to continue, some ten microseconds.
inline constexpr std::uint64_t steps_per_look = 1024;

/// StepRules are shared by the threads of a render and do not change.
struct StepRules {
  std::uint64_t most = usual_most_steps;
  std::function<void()> poll;  ///< is called often, and throws to end everything; or empty
};

/// RaySteps are the steps of the ray that a thread follows. A step is an object that the ray is
/// tested against, or a leaf of a CSG object. Only rays with many steps are ever looked at.
class RaySteps {
 public:
  const StepRules* rules = nullptr;  ///< null for the usual ones

  void begin_ray() { taken_ = 0; }
  std::uint64_t taken() const { return taken_; }

  /// Counts a step. Throws Error (limit) soon after there have been too many, and what the rules'
  /// poll() throws.
  void step() {
    if (++taken_ % steps_per_look == 0) [[unlikely]]
      look(taken_);
  }

  /// Throws Error (limit) if so many steps are too many for a ray, and what the rules' poll()
  /// throws.
  void look(std::uint64_t taken) const;

  /// Returns how many steps a ray may take.
  std::uint64_t most() const { return rules == nullptr ? usual_most_steps : rules->most; }

  /// Asks whether to continue, for work that is not counted.
  void poll() const;

 private:
  std::uint64_t taken_ = 0;
};

}  // namespace crt::core
