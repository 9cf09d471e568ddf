#include "core/geometry/implicit/field_program.hpp"

#include <bit>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "core/geometry/implicit/profile_distance.hpp"
#include "core/geometry/profile/profile.hpp"
#include "crt/error.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// A StepList has the steps of a field, each with a register of its own.
class StepList {
 public:
  /// Appends what a node needs, unless it is there. Returns the number of its step.
  std::uint16_t append(const FieldNode& node) {
    if (const auto known = by_node_.find(&node); known != by_node_.end()) return known->second;
    FieldStep step{.operation = node.operation, .number = node.number};
    if (node.a) step.a = append(*node.a);
    if (node.b) step.b = append(*node.b);
    simplify(step);
    if (node.profile) step.profile = kept(node.profile);
    const auto key = std::tuple(step.operation, step.a, step.b,
                                std::bit_cast<std::uint64_t>(step.number), step.profile);
    const auto [entry, is_new] = by_key_.try_emplace(key, static_cast<std::uint16_t>(steps.size()));
    if (is_new) {
      if (steps.size() == FieldProgram::most_steps) {
        throw Error(ErrorCode::invalid_argument,
                    text::format("field has more than {} operations", FieldProgram::most_steps),
                    "field");
      }
      step.result = entry->second;
      steps.push_back(step);
    }
    by_node_.emplace(&node, entry->second);
    return entry->second;
  }

  std::vector<FieldStep> steps;
  std::vector<std::shared_ptr<const ProfileDistance>> profiles;

 private:
  /// Returns what stands for a profile that several steps may have.
  const ProfileDistance* kept(const std::shared_ptr<const ProfileDistance>& profile) {
    for (const auto& known : profiles)
      if (known->profile() == profile->profile()) return known.get();
    profiles.push_back(profile);
    return profile.get();
  }

  static void simplify(FieldStep& step) {
    using enum FieldOperation;
    if (step.operation == multiply && step.a == step.b) {
      step.operation = square;
      step.b = 0;
    }
    const bool commutes = step.operation == add || step.operation == multiply ||
                          step.operation == minimum || step.operation == maximum;
    if (commutes && step.a > step.b) std::swap(step.a, step.b);
  }

  std::unordered_map<const FieldNode*, std::uint16_t> by_node_;
  using Key = std::tuple<FieldOperation, std::uint16_t, std::uint16_t, std::uint64_t,
                         const ProfileDistance*>;
  std::map<Key, std::uint16_t> by_key_;
};

int operand_count(FieldOperation operation) {
  using enum FieldOperation;
  switch (operation) {
    case constant:
    case x:
    case y:
    case z:
      return 0;
    case add:
    case subtract:
    case multiply:
    case divide:
    case minimum:
    case maximum:
    case arc_tangent_of_two:
    case profile_distance:
      return 2;
    default:
      return 1;
  }
}

/// Lets steps share registers, as far as no step needs what another puts there.
void assign_registers(std::vector<FieldStep>& steps) {
  std::vector<std::size_t> last_use(steps.size(), 0);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const int operands = operand_count(steps[i].operation);
    if (operands > 0) last_use[steps[i].a] = i;
    if (operands > 1) last_use[steps[i].b] = i;
  }
  std::vector<std::uint16_t> registers(steps.size());
  std::vector<std::uint16_t> free;
  std::uint16_t count = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    FieldStep& step = steps[i];
    const int operands = operand_count(step.operation);
    const std::uint16_t a = step.a;
    const std::uint16_t b = step.b;
    if (operands > 0) step.a = registers[a];
    if (operands > 1) step.b = registers[b];
    // A step reads its operands before it writes.
    if (operands > 0 && last_use[a] == i) free.push_back(registers[a]);
    if (operands > 1 && b != a && last_use[b] == i) free.push_back(registers[b]);
    if (free.empty()) {
      if (count == FieldProgram::max_registers) {
        throw Error(
            ErrorCode::invalid_argument,
            text::format("field needs more than {} values at a time", FieldProgram::max_registers),
            "field");
      }
      free.push_back(count++);
    }
    step.result = registers[i] = free.back();
    free.pop_back();
  }
}

}  // namespace

FieldProgram::FieldProgram(const Field& field) {
  StepList list;
  list.append(field.node());
  steps_ = std::move(list.steps);
  profiles_ = std::move(list.profiles);
  assign_registers(steps_);
}

std::shared_ptr<const FieldProgram> FieldProgram::of(const Field& field) {
  const FieldNode& node = field.node();
  std::call_once(node.program_once,
                 [&] { node.program = std::make_shared<const FieldProgram>(field); });
  return node.program;
}

std::vector<Dyadic> FieldProgram::numbers() const {
  std::vector<Dyadic> result = {Dyadic(static_cast<double>(steps_.size()))};
  for (const FieldStep& step : steps_) {
    for (const double number : {static_cast<double>(step.operation), double{1} * step.result,
                                double{1} * step.a, double{1} * step.b, step.number}) {
      result.emplace_back(number);
    }
    if (step.profile == nullptr) continue;
    for (const Contour& contour : step.profile->profile()->contours()) {
      result.emplace_back(static_cast<double>(contour.size()));
      for (const ProfilePoint& corner : contour)
        for (const double number : {corner.x, corner.y, corner.bulge}) result.emplace_back(number);
    }
  }
  return result;
}

std::size_t FieldProgram::bytes() const {
  std::size_t result = steps_.capacity() * sizeof(FieldStep);
  for (const auto& profile : profiles_) result += profile->bytes();
  return result;
}

}  // namespace crt::core
