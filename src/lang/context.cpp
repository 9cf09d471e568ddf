#include "lang/context.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <variant>

#include "lang/failure.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// Returns how long a unit is, as a whole number, so that the product with one rounds once.
double tenths_of_millimetre(Unit unit) {
  return std::round(10'000 * metres_of(unit));
}

/// More calls than this do not fit on an ordinary thread's stack.
constexpr std::size_t deepest_calls = 1000;

/// Says whether a value is counted by its users, and not copied.
bool is_shared(const Value& value) {
  return std::visit(
      [](const auto& held) {
        return !std::is_trivially_copyable_v<std::remove_cvref_t<decltype(held)>>;
      },
      value);
}

ScriptLimits bearable(ScriptLimits limits) {
  limits.call_depth = std::min(limits.call_depth, deepest_calls);
  limits.source_bytes = std::min(limits.source_bytes, SourceMap::most_bytes / 2);
  limits.errors = std::max<std::size_t>(limits.errors, 1);
  return limits;
}

}  // namespace

Context::Context(const ScriptOptions& new_options, SymbolTable& new_symbols, SourceMap& new_sources,
                 Reporter& new_reporter)
    : options(new_options),
      limits(bearable(new_options.limits)),
      symbols(new_symbols),
      sources(new_sources),
      reporter(new_reporter),
      files(new_options) {}

std::string Context::where() const {
  // An endless loop is the one with the most rounds, and among equals the outermost.
  const Activity* culprit = nullptr;
  for (const Activity& activity : activities_) {
    if (activity.is_loop && (!culprit || activity.rounds > culprit->rounds)) culprit = &activity;
  }
  if (!culprit && !activities_.empty()) culprit = &activities_.back();
  if (!culprit) return {};
  const SourcePlace place = sources.place(culprit->span);
  const char* kind = culprit->is_loop ? "loop" : "call";
  return text::format(", in the {} '{}' at {}:{}:{}", kind, culprit->name, place.file, place.line,
                      place.column);
}

void Context::pass_limit(Span span, const std::string& message) const {
  throw Failure{.span = span, .message = message + where(), .code = ErrorCode::limit};
}

void Context::pause(Span span) {
  if (steps_ > limits.steps)
    pass_limit(span, text::format("the script takes more than {} steps", limits.steps));
  if (options.go_on && !options.go_on()) {
    throw Failure{
        .span = span, .message = "the script was cancelled", .code = ErrorCode::cancelled};
  }
  constexpr std::uint64_t steps_between_pauses = 4096;
  next_pause_ = std::min(limits.steps, steps_ + steps_between_pauses);
}

void Context::spend(Span span, std::size_t steps) {
  steps_ = steps > std::numeric_limits<std::uint64_t>::max() - steps_
               ? std::numeric_limits<std::uint64_t>::max()
               : steps_ + steps;
  if (steps_ > next_pause_) pause(span);
}

void Context::spend_on_items(Span span, const std::vector<Value>& items) {
  const auto shared = std::count_if(items.begin(), items.end(), is_shared);
  const std::size_t plain = items.size() - static_cast<std::size_t>(shared);
  spend(span, (plain + items_of_shared * static_cast<std::size_t>(shared)) / items_per_step);
}

void Context::count_made(Span span) {
  spend(span, steps_per_entity);
  if (++made_ > limits.entities)
    pass_limit(span, text::format("the script makes more than {} entities", limits.entities));
}

void Context::count_emitted(Span span, std::uint64_t primitives) {
  if (primitives > limits.entities - emitted_)
    pass_limit(span, text::format("the scene gets more than {} entities", limits.entities));
  emitted_ += primitives;
}

void Context::check_size(Span span, const Entity& entity) {
  if (entity.primitive_count() > limits.entities)
    pass_limit(span, text::format("an entity of more than {} primitives", limits.entities));
}

Charge Context::charge_memory(Span span, std::size_t bytes) {
  if (bytes > limits.memory_bytes - memory_)
    pass_limit(span,
               text::format("the script's values need more than {} bytes", limits.memory_bytes));
  return Charge(memory_, bytes);
}

void Context::check_string_size(Span span, std::size_t bytes) {
  if (bytes > limits.string_bytes)
    pass_limit(span, text::format("a string of more than {} bytes", limits.string_bytes));
}

void Context::check_list_size(Span span, std::size_t items) {
  if (items > limits.list_length)
    pass_limit(span, text::format("a list of more than {} items", limits.list_length));
}

Value Context::make_string(Span span, std::string text) {
  spend(span, text.size() / bytes_per_step);
  Charge charge = charge_memory(span, sizeof(StringValue) + text.size());
  return std::make_shared<const StringValue>(StringValue{std::move(text), std::move(charge)});
}

int Context::depth_around(Span span, int inside) const {
  if (inside >= deepest_list)
    pass_limit(span, text::format("lists nested more than {} deep", deepest_list));
  return inside + 1;
}

Value Context::make_list(Span span, std::vector<Value> items) {
  spend_on_items(span, items);
  int inside = 0;
  for (const Value& item : items) inside = std::max(inside, depth_of(item));
  const int depth = depth_around(span, inside);
  Charge charge = charge_memory(span, sizeof(ListValue) + items.capacity() * sizeof(Value));
  return std::make_shared<ListValue>(ListValue{std::move(items), depth, std::move(charge)});
}

Value Context::make_dictionary(Span span, Variables entries) {
  constexpr std::size_t bytes_of_entry = 64 + sizeof(Value);
  constexpr std::size_t steps_of_entry = 2;
  spend(span, entries.size() * steps_of_entry);
  int inside = 0;
  for (const auto& [name, value] : entries) inside = std::max(inside, depth_of(value));
  const int depth = depth_around(span, inside);
  Charge charge = charge_memory(span, sizeof(DictionaryValue) + entries.size() * bytes_of_entry);
  return std::make_shared<const DictionaryValue>(
      DictionaryValue{std::move(entries), depth, std::move(charge)});
}

void ListMaker::add(Value item) {
  if (items_.size() == items_.capacity()) {
    constexpr std::size_t least_capacity = 8;
    const std::size_t before = items_.capacity();
    const std::size_t after = std::max(least_capacity, 2 * before);
    context_.check_list_size(span_, items_.size() + 1);
    charge_.add(context_.charge_memory(span_, (after - before) * sizeof(Value)));
    items_.reserve(after);
  }
  depth_inside_ = std::max(depth_inside_, depth_of(item));
  items_.push_back(std::move(item));
}

Value ListMaker::finish() {
  context_.check_list_size(span_, items_.size());
  const int depth = context_.depth_around(span_, depth_inside_);
  charge_.add(context_.charge_memory(span_, sizeof(ListValue)));
  return std::make_shared<ListValue>(ListValue{std::move(items_), depth, std::move(charge_)});
}

namespace {

std::uint64_t key_of(Span span) {
  constexpr int bits_of_end = 32;
  return (std::uint64_t{span.begin} << bits_of_end) | span.end;
}

}  // namespace

void Context::note_truncation(Span value, const Truncation& division) {
  truncations_.try_emplace(key_of(value), division);
  has_truncations_ = true;
}

void Context::forget_truncation(Span value) {
  truncations_.erase(key_of(value));
}

const Context::Truncation* Context::truncation_of(Span value) const {
  const auto found = truncations_.find(key_of(value));
  return found == truncations_.end() ? nullptr : &found->second;
}

void Context::note_variable(Symbol name, Span value) {
  if (!has_truncations_) return;
  if (const Truncation* division = truncation_of(value)) {
    truncated_variables_.insert_or_assign(name, *division);
  } else {
    truncated_variables_.erase(name);
  }
}

void Context::note_reading(Symbol name, Span span, const Value& value) {
  forget_truncation(span);
  const auto found = truncated_variables_.find(name);
  if (found == truncated_variables_.end()) return;
  // Another variable may have that name, too.
  const auto* number = std::get_if<std::int64_t>(&value);
  const Truncation division = found->second;
  if (number && *number == division.dividend / division.divisor) note_truncation(span, division);
}

void Context::used_as_float(Span value) {
  const Truncation* const division = truncation_of(value);
  if (!division || !reported_divisions_.insert(key_of(division->sign)).second) return;
  const auto [a, b] = std::pair(division->dividend, division->divisor);
  reporter.warning(
      division->sign,
      text::format("{0} / {1} of two Integers is {2}, without the rest, and used as a Float: with "
                   "{1}.0 it is {3}; if {2} is meant, write floor(a / b)",
                   a, b, a / b, float_text(static_cast<double>(a) / static_cast<double>(b))));
}

double Context::length(Span span, double value, Unit unit_of_value) {
  if (!unit) {
    fail(span,
         "a length needs the scene's unit, which is computed and not known here: write it as a "
         "plain text in the Settings, such as unit -> \"mm\"");
  }
  has_lengths_ = true;
  if (unit_of_value == *unit) return value;
  return value * tenths_of_millimetre(unit_of_value) / tenths_of_millimetre(*unit);
}

void Context::print(Span span, const std::string& line) {
  printed_bytes_ += line.size() + 1;
  if (printed_bytes_ > limits.string_bytes)
    pass_limit(span, text::format("the script prints more than {} bytes", limits.string_bytes));
  if (options.print) options.print(line);
}

}  // namespace crt::lang
