// This file looks into values: as text, for equality, and by index.
#include <iterator>

#include "lang/failure.hpp"
#include "lang/operators.hpp"
#include "lang/utf8.hpp"
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
  void write_string(const std::string& text, bool quoted) {
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
  std::size_t position = 0;
  for (std::int64_t i = 0; i < index && position < text.size(); ++i) decode_utf8(text, position);
  if (position >= text.size()) index_out_of_range(span, index, count_code_points(text), "String");
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
  return std::visit(Identity{}, left) == std::visit(Identity{}, right);
}

Value item(Context& context, Span index_span, const Value& base, const Value& index) {
  const auto* number = std::get_if<std::int64_t>(&index);
  if (!number) fail(index_span, "an index is an Integer, not {}", index);
  const std::int64_t i = *number;
  const auto within = [&](std::size_t size, std::string_view what) {
    if (i < 0 || static_cast<std::uint64_t>(i) >= size)
      index_out_of_range(index_span, i, size, what);
    return static_cast<std::size_t>(i);
  };
  if (const auto* list = std::get_if<List>(&base))
    return (*list)->items[within((*list)->items.size(), "List")];
  if (const auto* vector = std::get_if<Vec3>(&base))
    return (*vector)[static_cast<int>(within(3, "Vec3"))];
  if (const auto* color = std::get_if<Color>(&base)) {
    const double channels[] = {color->r, color->g, color->b, color->a};
    return channels[within(std::size(channels), "Color")];
  }
  if (const auto* string = std::get_if<String>(&base)) {
    if (i < 0) index_out_of_range(index_span, i, count_code_points((*string)->text), "String");
    return character(context, index_span, (*string)->text, i);
  }
  fail(index_span, "{} has no items to be read by an index", base);
}

}  // namespace crt::lang
