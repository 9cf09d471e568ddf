// This file has what the modifiers of an entity do.
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "crt/transform.hpp"
#include "crt/validate.hpp"
#include "lang/failure.hpp"
#include "lang/interpreter.hpp"
#include "text/format.hpp"

namespace crt::lang {

std::string_view word_of(ModifierKind kind) {
  switch (kind) {
    case ModifierKind::scale:
      return "scale";
    case ModifierKind::translate:
      return "translate";
    case ModifierKind::rotate:
      return "rotate";
    case ModifierKind::mirror:
      return "mirror";
    case ModifierKind::matrix:
      return "matrix";
    case ModifierKind::material:
      return "material";
    case ModifierKind::id:
      return "id";
    case ModifierKind::shadow:
      return "shadow";
    case ModifierKind::visible:
      return "visible";
  }
  return "";
}

namespace {

const char* what_it_takes(ModifierKind kind) {
  switch (kind) {
    case ModifierKind::scale:
      return "a number or a Vec3";
    case ModifierKind::translate:
    case ModifierKind::mirror:
      return "a Vec3";
    case ModifierKind::rotate:
      return "a Vec3 of degrees, or a number with an 'axis'";
    case ModifierKind::matrix:
      return "a List of 12 numbers, or of three rows of 4";
    case ModifierKind::material:
      return "a Material";
    case ModifierKind::id:
      return "an Integer";
    case ModifierKind::shadow:
    case ModifierKind::visible:
      return "a Boolean";
  }
  return "";
}

[[noreturn]] void wrong_type(const Modifier& modifier, const Value& operand) {
  fail(modifier.operand->span, "'{}' takes {}, not {}", word_of(modifier.kind),
       what_it_takes(modifier.kind), operand);
}

/// Reads the numbers of a matrix, row by row. A row may be a List of its own.
class MatrixReader {
 public:
  static constexpr std::size_t rows = 3;
  static constexpr std::size_t columns = 4;

  explicit MatrixReader(const Modifier& modifier) : modifier_(modifier) {}

  Transform read(const ListValue& list) {
    const bool has_rows =
        list.items.size() == rows && std::holds_alternative<List>(list.items.front());
    if (!has_rows) {
      read_numbers(list, rows * columns);
    } else {
      for (const Value& row : list.items) {
        const List* numbers = std::get_if<List>(&row);
        if (!numbers) refuse_item(row);
        read_numbers(**numbers, columns);
      }
    }
    const auto& m = numbers_;
    return {.row_x = {m[0], m[1], m[2]},
            .row_y = {m[4], m[5], m[6]},
            .row_z = {m[8], m[9], m[10]},
            .translation = {m[3], m[7], m[11]}};
  }

 private:
  void read_numbers(const ListValue& list, std::size_t count) {
    if (list.items.size() != count)
      fail(modifier_.operand->span, "'matrix' takes {}, not a List of {}",
           what_it_takes(ModifierKind::matrix), list.items.size());
    for (const Value& item : list.items) {
      double storage = 0;
      const double* number = as_float(item, storage);
      if (!number) refuse_item(item);
      numbers_[count_++] = *number;
    }
  }

  [[noreturn]] void refuse_item(const Value& item) const {
    fail(modifier_.operand->span, "'matrix' takes {}; it has {} in it",
         what_it_takes(ModifierKind::matrix), item);
  }

  const Modifier& modifier_;
  std::array<double, rows * columns> numbers_{};
  std::size_t count_ = 0;
};

/// Returns the map of a modifier that moves, or nothing for an operand of the wrong type.
std::optional<Transform> transform_of(const Modifier& modifier, const Value& operand,
                                      const std::optional<Vec3>& axis) {
  const auto* vector = std::get_if<Vec3>(&operand);
  const auto* list = std::get_if<List>(&operand);
  double storage = 0;
  const double* number = as_float(operand, storage);
  switch (modifier.kind) {
    case ModifierKind::scale:
      if (vector) return scale(*vector);
      if (number) return scale(*number);
      return std::nullopt;
    case ModifierKind::translate:
      if (vector) return translate(*vector);
      return std::nullopt;
    case ModifierKind::rotate:
      if (vector && !axis) return rotate_degrees(*vector);
      if (number && axis) return rotate_degrees(*axis, *number);
      return std::nullopt;
    case ModifierKind::mirror:
      if (vector) return mirror(*vector);
      return std::nullopt;
    case ModifierKind::matrix:
      if (list) return MatrixReader(modifier).read(**list);
      return std::nullopt;
    case ModifierKind::material:
    case ModifierKind::id:
    case ModifierKind::shadow:
    case ModifierKind::visible:
      break;
  }
  return std::nullopt;
}

std::uint32_t id_of(const Modifier& modifier, std::int64_t number) {
  constexpr std::int64_t most = std::numeric_limits<std::uint32_t>::max();
  if (number < 0 || number > most)
    fail(modifier.operand->span, "'id' must be between 0 and {} (it is {})", most, number);
  return static_cast<std::uint32_t>(number);
}

/// Returns an entity moved as if `about` were the origin, if that is given.
Entity moved_about(const Entity& entity, const Transform& transform,
                   const std::optional<Vec3>& about) {
  if (!about) return entity.transformed(transform);
  return entity.transformed(translate(-*about))
      .transformed(transform)
      .transformed(translate(*about));
}

Entity modified(const Entity& entity, const Modifier& modifier, const Value& operand,
                const std::optional<Vec3>& axis, const std::optional<Vec3>& about) {
  if (modifier.kind == ModifierKind::material) {
    if (const auto* material = std::get_if<SharedMaterial>(&operand))
      return entity.with_material(*material);
  } else if (modifier.kind == ModifierKind::id) {
    if (const auto* number = std::get_if<std::int64_t>(&operand))
      return entity.with_id(id_of(modifier, *number));
  } else if (modifier.kind == ModifierKind::shadow || modifier.kind == ModifierKind::visible) {
    const auto* yes = std::get_if<bool>(&operand);
    if (yes && modifier.kind == ModifierKind::shadow) return entity.with_shadow(*yes);
    if (yes) return entity.with_visible(*yes);
  } else if (const std::optional<Transform> transform = transform_of(modifier, operand, axis)) {
    return moved_about(entity, *transform, about);
  }
  wrong_type(modifier, operand);
}

}  // namespace

/// Returns the vector that follows a word of a modifier, if it is there.
std::optional<Vec3> Interpreter::vector_after(std::string_view word, const Expression* operand) {
  if (!operand) return std::nullopt;
  const Value value = evaluate(*operand);
  if (const auto* vector = std::get_if<Vec3>(&value)) return *vector;
  fail(operand->span, "'{}' takes a Vec3, not {}", word, value);
}

[[gnu::noinline]] Entity Interpreter::modify(const Entity& entity, const Modifier& modifier) {
  const Value operand = evaluate(*modifier.operand);
  const std::optional<Vec3> axis = vector_after("axis", modifier.axis);
  const std::optional<Vec3> about = vector_after("about", modifier.about);
  context_.count_made(modifier.operand->span);
  if (modifier.kind == ModifierKind::material && std::holds_alternative<SharedMaterial>(operand))
    note_material(entity, modifier.operand->span);
  try {
    return modified(entity, modifier, operand, axis, about);
  } catch (const Error& error) {
    std::string message = error.what();
    // The core names the parameter of its function, which in a script is the modifier itself.
    std::string_view argument = error.argument();
    if (argument == "axis")
      throw Failure{.span = modifier.axis->span,
                    .message = "'axis'" + message.substr(4),
                    .code = error.code()};
    if (modifier.kind == ModifierKind::matrix) argument = "a transform";
    if (message.starts_with(argument))
      message.replace(0, argument.size(), text::format("'{}'", word_of(modifier.kind)));
    throw Failure{.span = modifier.operand->span, .message = message, .code = error.code()};
  }
}

/// Notes whether a material that is given at `span` changes anything.
void Interpreter::note_material(const Entity& entity, Span span) {
  bool& changes = materials_given_.try_emplace(span.begin, span, false).first->second.second;
  changes = changes || entity.is_empty() || lacks_material(entity);
}

void Interpreter::warn_of_idle_materials() const {
  for (const auto& [begin, given] : materials_given_) {
    const auto& [span, changes] = given;
    if (!changes)
      context_.reporter.warning(
          span, "this changes nothing, as every part has a material of its own already");
  }
}

}  // namespace crt::lang
