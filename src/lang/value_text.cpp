// This file looks into values: as text, for equality, and by index.
#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "lang/failure.hpp"
#include "lang/operators.hpp"
#include "lang/suggestion.hpp"
#include "lang/utf8.hpp"
#include "lang/word_byte.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// Writes a value to the end of a text that is paid for as it grows.
class Writer {
 public:
  Writer(Context& context, Span span) : context_(context), span_(span) {}

  std::string take() { return std::move(text_); }

  void write(const Value& value, bool quoted) {
    context_.step(span_);
    if (const auto* integer = std::get_if<std::int64_t>(&value))
      return put(text::format("{}", *integer));
    if (const auto* number = std::get_if<double>(&value)) return put(float_text(*number));
    if (const auto* boolean = std::get_if<bool>(&value)) return put(*boolean ? "true" : "false");
    if (const auto* v = std::get_if<Vec3>(&value))
      return put(
          text::format("vec3({}, {}, {})", float_text(v->x), float_text(v->y), float_text(v->z)));
    if (const auto* color = std::get_if<Color>(&value)) return write_color(*color);
    if (const auto* string = std::get_if<String>(&value))
      return write_string((*string)->text, quoted);
    if (const auto* list = std::get_if<List>(&value)) return write_list(**list);
    if (const auto* dictionary = std::get_if<Dictionary>(&value))
      return write_dictionary(**dictionary);
    put(text::format("<{}>", type_name(value)));
  }

 private:
  void put(std::string_view piece) {
    context_.check_string_size(span_, text_.size() + piece.size());
    context_.spend(span_, piece.size() / bytes_per_step);
    text_ += piece;
  }

  void write_color(const Color& color) {
    const std::string channels =
        text::format("{}, {}, {}", float_text(color.r), float_text(color.g), float_text(color.b));
    put(color.a == 1 ? text::format("rgb({})", channels)
                     : text::format("rgba({}, {})", channels, float_text(color.a)));
  }

  /// Writes a string, within a list in quotes, so that ["a, b"] and ["a", "b"] look different.
  void write_string(std::string_view text, bool quoted) {
    if (!quoted) return put(text);
    put("\"");
    put(text);
    put("\"");
  }

  void write_list(const ListValue& list) {
    put("[");
    for (std::size_t i = 0; i < list.items.size(); ++i) {
      if (i > 0) put(", ");
      write(list.items[i], true);
    }
    put("]");
  }

  void write_dictionary(const DictionaryValue& dictionary) {
    put("{");
    bool is_first = true;
    for (const auto& [symbol, value] : dictionary.entries) {
      if (!std::exchange(is_first, false)) put(", ");
      const std::string_view name = context_.symbols.name(symbol);
      const bool is_plain = !name.empty() && std::all_of(name.begin(), name.end(), is_word_byte) &&
                            ((name[0] >= 'a' && name[0] <= 'z') || name[0] == '_');
      if (is_plain) {
        put(name);
      } else {
        write_string(name, true);
      }
      put(" -> ");
      write(value, true);
    }
    put("}");
  }

  Context& context_;
  Span span_;
  std::string text_;
};

bool equal_lists(Context& context, Span span, const ListValue& a, const ListValue& b) {
  if (a.items.size() != b.items.size()) return false;
  for (std::size_t i = 0; i < a.items.size(); ++i) {
    context.step(span);
    if (!equal(context, span, a.items[i], b.items[i])) return false;
  }
  return true;
}

bool equal_dictionaries(Context& context, Span span, const DictionaryValue& a,
                        const DictionaryValue& b) {
  if (a.entries.size() != b.entries.size()) return false;
  for (const auto& [name, value] : a.entries) {
    context.step(span);
    const Value* const other = b.entries.find(name);
    if (!other || !equal(context, span, value, *other)) return false;
  }
  return true;
}

/// Any other two values are equal if they are one and the same.
struct Identity {
  const void* operator()(const Nothing&) const { return nullptr; }
  const void* operator()(const Builtin* builtin) const { return builtin; }
  const void* operator()(const Entity& entity) const { return entity.shared_node().get(); }
  const void* operator()(const SharedMaterial& material) const { return &*material; }
  const void* operator()(const Field& field) const { return &field.node(); }
  template <class Pointee>
  const void* operator()(const std::shared_ptr<Pointee>& pointer) const {
    return pointer.get();
  }
  template <class Other>
  const void* operator()(const Other& other) const {
    return &other;
  }
};

[[noreturn]] void index_out_of_range(Span span, std::int64_t index, std::size_t size,
                                     std::string_view what) {
  if (size == 0) fail(span, "there is no item {} in an empty {}", index, what);
  fail(span, "there is no item {} in a {} of {}; they count from 0", index, what, size);
}

Value character(Context& context, Span span, const std::string& text, std::int64_t index) {
  context.spend(span, text.size() / bytes_per_step);
  std::int64_t left = index;
  if (index < 0) left += static_cast<std::int64_t>(count_code_points(text));
  std::size_t position = 0;
  for (; left > 0 && position < text.size(); --left) decode_utf8(text, position);
  if (left < 0 || position >= text.size())
    index_out_of_range(span, index, count_code_points(text), "String");
  const std::size_t begin = position;
  decode_utf8(text, position);
  return context.make_string(span, text.substr(begin, position - begin));
}

}  // namespace

std::string text_of(Context& context, Span span, const Value& value) {
  Writer writer(context, span);
  writer.write(value, false);
  return writer.take();
}

bool equal(Context& context, Span span, const Value& left, const Value& right) {
  double left_room = 0;
  double right_room = 0;
  if (left.index() != right.index()) {
    const double* a = as_float(left, left_room);
    const double* b = as_float(right, right_room);
    return a && b && *a == *b;
  }
  if (const auto* a = std::get_if<std::int64_t>(&left)) return *a == std::get<std::int64_t>(right);
  if (const auto* a = std::get_if<double>(&left)) return *a == std::get<double>(right);
  if (const auto* a = std::get_if<bool>(&left)) return *a == std::get<bool>(right);
  if (const auto* a = std::get_if<Vec3>(&left)) return *a == std::get<Vec3>(right);
  if (const auto* a = std::get_if<Color>(&left)) return *a == std::get<Color>(right);
  if (const auto* a = std::get_if<String>(&left)) {
    context.spend(span, (*a)->text.size() / bytes_per_step);
    return (*a)->text == std::get<String>(right)->text;
  }
  if (const auto* a = std::get_if<List>(&left))
    return equal_lists(context, span, **a, *std::get<List>(right));
  if (const auto* a = std::get_if<Dictionary>(&left))
    return equal_dictionaries(context, span, **a, *std::get<Dictionary>(right));
  return std::visit(Identity{}, left) == std::visit(Identity{}, right);
}

Value entry(Context& context, Span span, const DictionaryValue& dictionary, std::string_view name) {
  context.spend(span, name.size() / bytes_per_step);
  const std::optional<Symbol> symbol = context.symbols.find(name);
  const Value* const value = symbol ? dictionary.entries.find(*symbol) : nullptr;
  if (value) {
    if (std::holds_alternative<Unknown>(*value)) throw Abandoned{};
    return *value;
  }
  std::vector<std::string_view> names;
  for (const auto& [known, other] : dictionary.entries)
    names.push_back(context.symbols.name(known));
  fail(span, "the Dictionary has no '{}'{}", abbreviated(std::string(name)),
       did_you_mean(name, names));
}

Value slice(Context& context, Span span, const Value& base, std::optional<std::int64_t> first,
            std::optional<std::int64_t> end) {
  const List* list = std::get_if<List>(&base);
  const String* string = std::get_if<String>(&base);
  if (!list && !string) fail(span, "a slice is one of a List or a String, not of {}", base);
  if (string) context.spend(span, (*string)->text.size() / bytes_per_step);
  const auto size =
      static_cast<std::int64_t>(list ? (*list)->items.size() : count_code_points((*string)->text));
  const auto place = [size](std::int64_t bound) {
    return std::clamp<std::int64_t>(bound < 0 ? bound + size : bound, 0, size);
  };
  const std::int64_t begin = place(first.value_or(0));
  const std::int64_t count = std::max<std::int64_t>(place(end.value_or(size)) - begin, 0);
  if (list) {
    const auto from = (*list)->items.begin() + begin;
    return context.make_list(span, std::vector<Value>(from, from + count));
  }
  std::size_t position = 0;
  const auto pass = [&](std::int64_t characters) {
    for (; characters > 0; --characters) decode_utf8((*string)->text, position);
    return position;
  };
  const std::size_t from = pass(begin);
  return context.make_string(span, (*string)->text.substr(from, pass(count) - from));
}

Value item(Context& context, Span index_span, const Value& base, const Value& index) {
  const auto* dictionary = std::get_if<Dictionary>(&base);
  const auto* name = std::get_if<String>(&index);
  if (dictionary && name) return entry(context, index_span, **dictionary, (*name)->text);
  const auto* number = std::get_if<std::int64_t>(&index);
  if (dictionary) fail(index_span, "an entry of a Dictionary is read by a String, not {}", index);
  if (!number) fail(index_span, "an index is an Integer, not {}", index);
  const std::int64_t i = *number;
  const auto within = [&](std::size_t size, std::string_view what) {
    if (i < 0 || static_cast<std::uint64_t>(i) >= size)
      index_out_of_range(index_span, i, size, what);
    return static_cast<std::size_t>(i);
  };
  if (const auto* list = std::get_if<List>(&base)) {
    const std::size_t size = (*list)->items.size();
    const bool from_end = i < 0 && i >= -static_cast<std::int64_t>(size);
    return (*list)->items[from_end ? size - static_cast<std::size_t>(-i) : within(size, "List")];
  }
  if (const auto* vector = std::get_if<Vec3>(&base))
    return (*vector)[static_cast<int>(within(3, "Vec3"))];
  if (const auto* color = std::get_if<Color>(&base)) {
    const double channels[] = {color->r, color->g, color->b, color->a};
    return channels[within(std::size(channels), "Color")];
  }
  if (const auto* string = std::get_if<String>(&base)) {
    return character(context, index_span, (*string)->text, i);
  }
  fail(index_span, "{} has no items to be read by an index", base);
}

}  // namespace crt::lang
