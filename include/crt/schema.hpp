// The schema says once what there is: the fields of each public struct, with their ranges and what
// they are called elsewhere. The tables themselves are in crt/schema_tables.hpp. Checks, scripts,
// source code that is written, C, editors and the reference are derived from them.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

namespace crt::schema {

/// A Name is a short text that is made when the program is compiled.
class Name {
 public:
  constexpr Name() = default;
  /// Takes a text of at most 31 bytes.
  constexpr Name(std::string_view text) {  // NOLINT(google-explicit-constructor): like a string
    for (const char c : text) add(c);
  }
  /// Takes such a text, which 0 ends.
  constexpr Name(const char* text)  // NOLINT(google-explicit-constructor): like a string
      : Name(std::string_view(text)) {}
  /// Adds a letter at the end.
  constexpr void add(char c) { letters_.at(size_++) = c; }
  /// Returns the text, which ends with the Name.
  constexpr std::string_view text() const { return {letters_.data(), size_}; }

 private:
  std::array<char, 32> letters_{};
  std::size_t size_ = 0;
};

/// Returns what scripts call a field of C++: "cornerA" for "corner_a", "bumpheight" for
/// "bump_height".
constexpr Name script_name(std::string_view name) {
  Name result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_last_letter = i > 0 && i + 1 == name.size() && name[i - 1] == '_';
    const bool is_small = name[i] >= 'a' && name[i] <= 'z';
    if (name[i] != '_')
      result.add(is_last_letter && is_small ? static_cast<char>(name[i] - 'a' + 'A') : name[i]);
  }
  return result;
}

/// Returns what C calls a type of C++: "half_plane" for "HalfPlane".
constexpr Name c_name(std::string_view name) {
  Name result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool is_capital = name[i] >= 'A' && name[i] <= 'Z';
    if (is_capital && i > 0) result.add('_');
    result.add(is_capital ? static_cast<char>(name[i] - 'A' + 'a') : name[i]);
  }
  return result;
}

/// A Rule says which values a field may have. Lengths are in scene units.
struct Rule {
  /// Lists the kinds of rules.
  enum Kind {
    any,             ///< what more there is to say is checked for the whole struct
    between,         ///< a number from `low` to `high`
    above,           ///< a number above 0, at most `high`
    power_of_two,    ///< from `low` to `high`
    length,          ///< a number, or three, from 1e-100 to 1e100
    length_or_zero,  ///< likewise, or 0
    point,           ///< three coordinates of at most 1e100
    direction,       ///< likewise, and not (0, 0, 0)
    apart,           ///< a point other than that in the field `other`
    corner,          ///< a point that differs from the one in `other` in each coordinate
    channels,        ///< a colour whose channels are from 0 to `high`
    made,            ///< something that must be there; the function `other` makes it
  };
  Kind kind = any;           ///< the kind of rule
  double low = 0;            ///< the least number
  double high = 0;           ///< the greatest number
  std::string_view other{};  ///< a field or a function, by its name in C++
};

/// @name Rules as rows have them
/// @{

inline constexpr Rule any{};
inline constexpr Rule length{.kind = Rule::length};
inline constexpr Rule length_or_zero{.kind = Rule::length_or_zero};
inline constexpr Rule point{.kind = Rule::point};
inline constexpr Rule direction{.kind = Rule::direction};
/// Takes numbers from `low` to `high`.
constexpr Rule between(double low, double high) {
  return {.kind = Rule::between, .low = low, .high = high};
}
/// Takes numbers above 0 up to `high`.
constexpr Rule above_0_to(double high) {
  return {.kind = Rule::above, .high = high};
}
/// Takes powers of two from `low` to `high`.
constexpr Rule power_of_two(double low, double high) {
  return {.kind = Rule::power_of_two, .low = low, .high = high};
}
/// Takes points other than that of another field.
constexpr Rule apart_from(std::string_view field) {
  return {.kind = Rule::apart, .other = field};
}
/// Takes the corner of a box that is opposite to that of another field.
constexpr Rule opposite_to(std::string_view field) {
  return {.kind = Rule::corner, .other = field};
}
/// Takes colours whose channels are at most `high`.
constexpr Rule channels_to(double high) {
  return {.kind = Rule::channels, .high = high};
}
/// Takes what a function has made.
constexpr Rule made_by(std::string_view function) {
  return {.kind = Rule::made, .other = function};
}

inline constexpr double largest_length = 1e100;  ///< of lengths and coordinates
inline constexpr double largest_factor = 1e30;   ///< of numbers without a unit, and of radians
inline constexpr Rule share = between(0, 1);
inline constexpr Rule factor = between(0, largest_factor);
inline constexpr Rule extent = above_0_to(largest_length);
inline constexpr Rule radians = between(-largest_factor, largest_factor);
inline constexpr Rule brightness = channels_to(largest_factor);

/// @}

/// Uses say how a field stands in scripts, in C and elsewhere, where that does not follow from its
/// name and type.
struct Uses {
  bool required = false;            ///< a script must give it
  bool in_scripts = true;           ///< scripts have it
  bool in_c = true;                 ///< C and Python have it
  std::string_view script{};        ///< its name there
  std::string_view c{};             ///< its name in C and Python
  std::string_view alpha{};         ///< what these call the alpha of a colour, if they have it
  std::string_view map{};           ///< and a pattern in the place of a colour or a number
  std::string_view default_text{};  ///< how scripts say a default that is no value
  /// Scripts have the angle in degrees. This is their message about one that is out of range.
  std::string_view degrees{};
  std::string_view option{};    ///< what the command's help says
  bool always_written = false;  ///< scripts of other years have another default
};

/// Says of a row that scripts must give the field.
inline constexpr Uses required{.required = true};

/// A Field is a row: a field of a struct.
template <class Struct, class Type>
struct Field {
  using Owner = Struct;    ///< the struct
  using Value = Type;      ///< the field's type
  std::string_view name;   ///< its name in C++
  Type Struct::*member;    ///< the field itself
  Rule rule;               ///< which values it may have
  Uses uses;               ///< where it stands, and how
  std::string_view about;  ///< what it means, as scripts have it: a cell of the reference
  Name derived_script_name;

  /// Returns its name in scripts.
  constexpr std::string_view script_name() const { return derived_script_name.text(); }
  /// Returns its name in C and Python, which is empty if they do not have it.
  constexpr std::string_view c_name() const {
    return !uses.in_c ? std::string_view() : uses.c.empty() ? name : uses.c;
  }
};

/// Makes a row.
template <class Struct, class Type>
constexpr Field<Struct, Type> field(std::string_view name, Type Struct::*member, Rule rule,
                                    Uses uses, std::string_view about) {
  return {name, member, rule,
          uses, about,  uses.script.empty() ? script_name(name) : Name(uses.script)};
}

/// A Table has the rows of a struct, in the order in which it declares its fields.
template <class... Fields>
struct Table {
  /// Takes what C++, scripts and Python call the struct, and its rows.
  constexpr explicit Table(std::string_view name_of_struct, const Fields&... rows)
      : name(name_of_struct), fields(rows...) {}

  std::string_view name;         ///< what C++, scripts and Python call the struct
  std::tuple<Fields...> fields;  ///< the rows
};

/// Holds the table of a struct. It is specialised for each.
template <class Struct>
inline constexpr auto table = nullptr;

/// Calls visit(field) for each row of a struct.
template <class Struct, class Visit>
constexpr void for_each_field(const Visit& visit) {
  std::apply([&visit](const auto&... field) { (visit(field), ...); }, table<Struct>.fields);
}

/// Returns a field of an object by its name in C++. Such a field must be there.
template <class Value, class Struct>
constexpr const Value& value_of(const Struct& object, std::string_view name) {
  const Value* found = nullptr;
  for_each_field<Struct>([&]<class Row>(const Row& field) {
    if constexpr (std::is_same_v<typename Row::Value, Value>)
      if (field.name == name) found = &(object.*field.member);
  });
  return *found;
}

/// Calls visit(std::type_identity<Kind>()) for each kind that a variant may have.
template <class Variant, class Visit>
constexpr void for_each_kind(const Visit& visit) {
  []<class... Kinds>(std::type_identity<std::variant<Kinds...>>, const Visit& each) {
    (each(std::type_identity<Kinds>()), ...);
  }(std::type_identity<Variant>(), visit);
}

/// Choices name the values of an enumeration, from 0 on.
template <std::size_t Count>
struct Choices {
  std::string_view type;                      ///< the enumeration in C++ and Python
  std::string_view c_type;                    ///< that of C
  std::string_view c_prefix;                  ///< what its values begin with there
  std::array<std::string_view, Count> names;  ///< in C++
  std::array<Name, Count> script_names;       ///< without "_"
};

/// Makes the choices of an enumeration.
template <class... Names>
constexpr Choices<sizeof...(Names)> choice(std::string_view type, std::string_view c_type,
                                           std::string_view c_prefix, const Names&... names) {
  const auto word = [](std::string_view name) {
    Name result;
    for (const char c : name)
      if (c != '_') result.add(c);
    return result;
  };
  return {type, c_type, c_prefix, {names...}, {word(names)...}};
}

/// Holds the choices of an enumeration. It is specialised for each.
template <class Enum>
inline constexpr auto choices = nullptr;

/// Returns the number of a value of an enumeration in its choices.
template <class Enum>
constexpr std::size_t place_of(Enum value) {
  return static_cast<std::size_t>(value);
}

/// Says whether a value is one of an enumeration.
template <class Enum>
constexpr bool is_choice(Enum value) {
  return place_of(value) < choices<Enum>.names.size();
}

/// Returns what scripts call a value of an enumeration.
template <class Enum>
constexpr std::string_view script_name_of(Enum value) {
  return choices<Enum>.script_names.at(place_of(value)).text();
}

}  // namespace crt::schema
