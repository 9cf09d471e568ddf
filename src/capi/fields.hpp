// Structs of C and C++ have fields of the same names, by the schema. These functions copy them.
#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "capi/growable.hpp"
#include "capi/structs.hpp"
#include "crt/pattern.hpp"
#include "crt/principled.hpp"
#include "crt/schema.hpp"
#include "text/format.hpp"

namespace crt::capi {

/// This value stands for a factor that follows from others.
inline constexpr double automatic = -1;

/// A CPlace is the field of a struct of C that has a name. Nothing is done to one that is not
/// there.
template <class Byte>
class CPlace {
 public:
  CPlace(Byte* place, std::size_t size) : place_(place), size_(size) {}

  template <class Value>
  void write(const Value& value) const {
    if (size_ == sizeof value) std::memcpy(place_, &value, sizeof value);
  }
  template <class Value>
  void read(Value& value) const {
    // NOLINTNEXTLINE(bugprone-sizeof-expression): a field may be a pointer
    if (size_ == sizeof value) std::memcpy(&value, place_, sizeof value);
  }

 private:
  Byte* place_;
  std::size_t size_;
};

/// Returns the place of a field of a struct.
template <class Struct>
auto place_in(Struct& object, std::string_view name) {
  using Byte = std::conditional_t<std::is_const_v<Struct>, const char, char>;
  auto* const bytes = reinterpret_cast<Byte*>(&object);
  for (const CField& field : c_fields<std::remove_const_t<Struct>>()) {
    if (field.name == name) return CPlace<Byte>(bytes + field.offset, field.size);
  }
  return CPlace<Byte>(bytes, 0);
}

/// A flag whose name in C begins so is the opposite of that of C++.
inline bool is_opposite(std::string_view c_name) {
  return c_name.starts_with("no_");
}

/// Writes the fields of a struct of C++ into one of C. Patterns, pictures and stops are left out.
template <class Struct, class C>
void put_fields(C& out, const Struct& object) {
  schema::for_each_field<Struct>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    const Value& value = object.*row.member;
    const auto place = place_in(out, row.c_name());
    const auto put_color = [&](const Color& color) {
      place.write(Vec3(color.r, color.g, color.b));
      place_in(out, row.uses.alpha).write(color.a);
    };
    if constexpr (std::is_same_v<Value, bool>) {
      place.write(std::int32_t{value != is_opposite(row.c_name())});
    } else if constexpr (std::is_enum_v<Value>) {
      place.write(static_cast<std::int32_t>(value));
    } else if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, Vec3>) {
      place.write(value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      place.write(value.c_str());
    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
      place.write(value.value_or(automatic));
    } else if constexpr (std::is_same_v<Value, Color>) {
      put_color(value);
    } else if constexpr (std::is_same_v<Value, std::variant<Color, Pattern>>) {
      if (const auto* color = std::get_if<Color>(&value)) put_color(*color);
    } else if constexpr (std::is_same_v<Value, Share>) {
      if (const auto* number = std::get_if<double>(&value)) place.write(*number);
    }
  });
}

/// Reads the fields of a struct of C++ from one of C, which messages call `name`. Patterns,
/// pictures and stops are left as they are.
template <class Struct, class C>
void take_fields(Struct& object, const C& given, const char* name) {
  schema::for_each_field<Struct>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    Value& value = object.*row.member;
    const auto place = place_in(given, row.c_name());
    const auto take_color = [&](Color& color) {
      Vec3 rgb(color.r, color.g, color.b);
      place.read(rgb);
      color = {rgb.x, rgb.y, rgb.z, 1};
      place_in(given, row.uses.alpha).read(color.a);
    };
    std::int32_t number = 0;
    if constexpr (std::is_same_v<Value, bool>) {
      place.read(number);
      value = (number != 0) != is_opposite(row.c_name());
    } else if constexpr (std::is_enum_v<Value>) {
      const auto& choices = schema::choices<Value>;
      place.read(number);
      value = to_enum(number, static_cast<Value>(choices.names.size() - 1),
                      text::format("{}.{}", name, row.name).c_str(), choices.c_type.data());
    } else if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, Vec3>) {
      place.read(value);
    } else if constexpr (std::is_same_v<Value, std::string>) {
      const char* text = nullptr;
      place.read(text);
      value = text == nullptr ? "" : text;
    } else if constexpr (std::is_same_v<Value, std::optional<double>>) {
      double factor = automatic;
      place.read(factor);
      if (factor != automatic) value = factor;
    } else if constexpr (std::is_same_v<Value, Color>) {
      take_color(value);
    } else if constexpr (std::is_same_v<Value, std::variant<Color, Pattern>>) {
      take_color(value.template emplace<Color>());
    } else if constexpr (std::is_same_v<Value, Share>) {
      place.read(value.template emplace<double>());
    }
  });
}

/// Reads the patterns of a struct of C++ from one of C: those that stand in the place of a colour
/// or a number, and others.
template <class Struct, class C>
void take_patterns(Struct& object, const C& given, const char* name) {
  const auto pattern_in = [&](std::string_view field) -> std::optional<Pattern> {
    const crt_pattern* pattern = nullptr;
    place_in(given, field).read(pattern);
    if (pattern == nullptr) return std::nullopt;
    return to_pattern(pattern, text::format("{}.{}", name, field).c_str());
  };
  schema::for_each_field<Struct>([&]<class Row>(const Row& row) {
    using Value = typename Row::Value;
    if constexpr (std::is_same_v<Value, std::optional<Pattern>>) {
      object.*row.member = pattern_in(row.c_name());
    } else if constexpr (requires(Value & value, Pattern pattern) { value = pattern; }) {
      if (std::optional<Pattern> pattern = pattern_in(row.uses.map))
        object.*row.member = std::move(*pattern);
    }
  });
}

/// Makes the kind of a variant that has a number, its place there, and calls visit(kind) with it.
/// Throws that the argument has a value which `list`, an enumeration of crt.h, has not.
template <class Variant, class Visit>
void with_kind(std::int32_t type, const char* argument, const char* list, const Visit& visit) {
  std::int32_t place = 0;
  bool is_known = false;
  schema::for_each_kind<Variant>([&]<class Kind>(std::type_identity<Kind>) {
    if (place++ != type) return;
    is_known = true;
    visit(Kind{});
  });
  if (!is_known) reject_value(argument, type, list);
}

/// Writes the defaults of all kinds of a variant into a struct of C, the first kind's last.
template <class Variant, class C>
void put_defaults(C& out) {
  for (auto kind = static_cast<std::int32_t>(std::variant_size_v<Variant>); kind-- > 0;)
    with_kind<Variant>(kind, "type", "kind", [&out](const auto& one) { put_fields(out, one); });
}

}  // namespace crt::capi
