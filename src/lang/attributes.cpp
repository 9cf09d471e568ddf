#include "lang/attributes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "crt/curves.hpp"
#include "lang/colors.hpp"
#include "lang/failure.hpp"
#include "lang/fields.hpp"
#include "lang/suggestion.hpp"
#include "lang/utf8.hpp"
#include "text/format.hpp"
#include "text/letters.hpp"

namespace crt::lang {

namespace {

[[noreturn]] void reject(const Given& given, const std::string& message) {
  fail(given.value_span, "'{}' {}", given.type->name, message);
}

[[noreturn]] void wrong_type(const Given& given) {
  const std::string_view wanted = given.type->type;
  reject(given, text::format("must be {} {}, not {}", article(wanted), wanted,
                             type_with_article(given.value)));
}

void require_finite(const Given& given, double number) {
  if (!std::isfinite(number))
    reject(given, text::format("must be a finite number, not {}", float_text(number)));
}

template <class Wanted>
const Wanted& get(const Given& given) {
  const auto* value = std::get_if<Wanted>(&given.value);
  if (!value) wrong_type(given);
  return *value;
}

/// Returns a colour that is given as one, or as a text such as "#ff8800".
std::optional<Color> color_of(const Given& given, const Value& value) {
  if (const auto* color = std::get_if<Color>(&value)) return *color;
  const auto* text = std::get_if<String>(&value);
  if (!text) return std::nullopt;
  const std::optional<Color> color = color_of_text((*text)->text);
  if (!color) {
    reject(given, text::format("must be a Color or a text such as \"#ff8800\", not \"{}\"",
                               abbreviated((*text)->text)));
  }
  return color;
}

/// The memory of a stop of a pattern is paid for by so many steps, whenever the pattern is copied.
constexpr std::size_t steps_per_stop = 4;

const Pattern& copied(const Given& given, Context& context, const Pattern& pattern) {
  std::visit(
      [&](const auto& kind) {
        if constexpr (requires { kind.colors; })
          context.spend(given.value_span, steps_per_stop * kind.colors.size());
      },
      pattern);
  return pattern;
}

/// A ContourItem is an item of a contour's List: the numbers of a corner, or of a curve with its
/// control points.
struct ContourItem {
  std::array<double, 6> numbers{};
  std::size_t count = 0;

  bool is_curve() const { return count == 4 || count == 6; }
  CurvePoint point(std::size_t i) const { return {numbers[2 * i], numbers[2 * i + 1]}; }
  ProfilePoint corner() const {
    if (!is_curve()) return {.x = numbers[0], .y = numbers[1], .bulge = numbers[2]};
    return {.x = numbers[count - 2], .y = numbers[count - 1]};
  }
  /// Adds the piece that leads here from the corner before.
  void append_to(Contour& contour) const {
    if (count == 6) {
      append_cubic(contour, point(0), point(1), point(2));
    } else if (count == 4) {
      append_quadratic(contour, point(0), point(1));
    } else {
      contour.push_back(corner());
    }
  }
};

std::optional<ContourItem> contour_item(const Value& value) {
  const List* list = std::get_if<List>(&value);
  ContourItem item{.count = list ? (*list)->items.size() : 0};
  if (item.count != 2 && item.count != 3 && !item.is_curve()) return std::nullopt;
  for (std::size_t i = 0; i < item.count; ++i) {
    double storage = 0;
    const double* number = as_float((*list)->items[i], storage);
    if (!number) return std::nullopt;
    item.numbers[i] = *number;
  }
  return item;
}

void append(const Given& given, const ContourItem& item, Contour& contour) {
  try {
    item.append_to(contour);
  } catch (const Error& error) {
    reject(given, text::format("has a curve that is wrong: {}", error.what()));
  }
}

/// The memory of a corner of a profile, with what a prepared scene makes of it, is paid for by so
/// many steps.
constexpr std::size_t steps_per_corner = 64;

Contour contour_of(const Given& given, Context& context, const std::vector<Value>& items) {
  Contour contour;
  contour.reserve(items.size());
  std::optional<ContourItem> closing;
  for (const Value& value : items) {
    const std::optional<ContourItem> item = contour_item(value);
    if (!item) {
      reject(given, text::format(
                        "must have corners such as [0, 1], or [0, 1, 0.5] with the bulge of an "
                        "arc, or [1, 0, 1, 1, 0, 1] with the control points of a curve; it has {} "
                        "in it",
                        type_with_article(value)));
    }
    const std::size_t before = contour.size();
    if (contour.empty()) {
      contour.push_back(item->corner());
      if (item->is_curve()) closing = item;
    } else {
      append(given, *item, contour);
    }
    context.spend(given.value_span, steps_per_corner * (1 + contour.size() - before));
  }
  if (closing) append(given, *closing, contour);
  return contour;
}

}  // namespace

std::size_t choose(const Given& given, std::span<const schema::Name> words) {
  const std::string text = text::in_small_letters(get<String>(given)->text);
  std::vector<std::string_view> names;
  std::vector<std::string> quoted;
  for (const schema::Name& word : words) {
    if (word.text() == text) return names.size();
    names.push_back(word.text());
    quoted.push_back(text::format("\"{}\"", word.text()));
  }
  const std::string_view meant = nearest(text, names);
  const std::string suggestion = meant.empty() ? "" : text::format("; did you mean \"{}\"?", meant);
  reject(given, text::format("must be {}{}", enumerate(quoted), suggestion));
}

void convert(const Given& given, Context& context, double& field) {
  double storage = 0;
  const double* number = as_float(given.value, storage);
  if (!number) wrong_type(given);
  if (number == &storage) context.used_as_float(given.value_span);
  require_finite(given, *number);
  field = *number;
}

void convert(const Given& given, Context&, int& field) {
  const std::int64_t number = get<std::int64_t>(given);
  constexpr std::int64_t most = std::numeric_limits<int>::max();
  if (number > most || number < -most)
    reject(given, text::format("is far out of range (it is {})", number));
  field = static_cast<int>(number);
}

void convert(const Given& given, Context&, std::uint64_t& field) {
  const std::int64_t number = get<std::int64_t>(given);
  if (number < 0) reject(given, text::format("must be at least 0 (it is {})", number));
  field = static_cast<std::uint64_t>(number);
}

void convert(const Given& given, Context&, bool& field) {
  field = get<bool>(given);
}

void convert(const Given& given, Context&, std::string& field) {
  field = get<String>(given)->text;
}

void convert(const Given& given, Context&, Vec3& field) {
  const Vec3& vector = get<Vec3>(given);
  for (int axis = 0; axis < 3; ++axis) require_finite(given, vector[axis]);
  field = vector;
}

void convert(const Given& given, Context& context, std::vector<Vec3>& field) {
  const std::vector<Value>& items = get<List>(given)->items;
  context.spend(given.value_span, items.size());
  field.clear();
  for (const Value& item : items) {
    const auto* point = std::get_if<Vec3>(&item);
    if (point == nullptr) {
      reject(given, text::format("must be a List of points such as [vec3(0, 0, 0), vec3(1, 2, 0)]; "
                                 "it has {} in it",
                                 type_with_article(item)));
    }
    field.push_back(*point);
  }
}

void convert(const Given& given, Context& context, std::vector<double>& field) {
  double storage = 0;
  if (const double* number = as_float(given.value, storage)) {
    require_finite(given, *number);
    field = {*number};
    return;
  }
  const std::vector<Value>& items = get<List>(given)->items;
  context.spend(given.value_span, items.size());
  field.clear();
  for (const Value& item : items) {
    const double* number = as_float(item, storage);
    if (number == nullptr) {
      reject(given, text::format("must be a number, or a List of numbers such as [0.5, 1]; it has "
                                 "{} in it",
                                 type_with_article(item)));
    }
    require_finite(given, *number);
    field.push_back(*number);
  }
}

void convert(const Given& given, Context& context, std::vector<std::vector<std::uint32_t>>& field) {
  const auto wrong = [&](const Value& value) {
    reject(given,
           text::format("must be a List of faces such as [[0, 1, 2, 3], [2, 1, 4]]; it has {} "
                        "in it",
                        type_with_article(value)));
  };
  field.clear();
  for (const Value& face : get<List>(given)->items) {
    const List* list = std::get_if<List>(&face);
    if (list == nullptr) wrong(face);
    context.spend(given.value_span, 1 + (*list)->items.size());
    std::vector<std::uint32_t>& numbers = field.emplace_back();
    for (const Value& item : (*list)->items) {
      const auto* number = std::get_if<std::int64_t>(&item);
      if (number == nullptr) wrong(item);
      if (*number < 0 || *number > std::numeric_limits<std::uint32_t>::max())
        reject(given, text::format("has the corner {}, which is no place in a List", *number));
      numbers.push_back(static_cast<std::uint32_t>(*number));
    }
  }
}

void convert(const Given& given, Context&, Color& field) {
  const std::optional<Color> color = color_of(given, given.value);
  if (!color) wrong_type(given);
  for (const double channel : {color->r, color->g, color->b, color->a})
    require_finite(given, channel);
  field = *color;
}

void convert(const Given& given, Context& context, Pattern& field) {
  field = copied(given, context, *get<std::shared_ptr<const Pattern>>(given));
}

void convert(const Given& given, Context& context, std::variant<Color, Pattern>& field) {
  if (const auto* pattern = std::get_if<std::shared_ptr<const Pattern>>(&given.value)) {
    field = copied(given, context, **pattern);
  } else {
    convert(given, context, field.emplace<Color>());
  }
}

void convert(const Given& given, Context& context, Share& field) {
  if (const auto* pattern = std::get_if<std::shared_ptr<const Pattern>>(&given.value)) {
    field = copied(given, context, **pattern);
  } else {
    convert(given, context, field.emplace<double>());
  }
}

void convert(const Given& given, Context& context, std::vector<ColorStop>& field) {
  const std::vector<Value>& items = get<List>(given)->items;
  // The core refuses more stops than a few. Here they must only not be copied by the million.
  constexpr std::size_t max_items = 1000;
  field.clear();
  for (std::size_t i = 0; i < std::min(items.size(), max_items); ++i) {
    const List* stop = std::get_if<List>(&items[i]);
    double storage = 0;
    const bool is_pair = stop && (*stop)->items.size() == 2;
    const double* position = is_pair ? as_float((*stop)->items[0], storage) : nullptr;
    const std::optional<Color> color = is_pair ? color_of(given, (*stop)->items[1]) : std::nullopt;
    if (!position || !color)
      reject(given, "must be a List such as [[0, rgb(1, 0, 0)], [0.4, rgb(0, 1, 0)], ...]");
    field.push_back({*position, *color});
  }
  context.spend(given.value_span, steps_per_stop * field.size());
}

void convert(const Given& given, Context&, FillRule& field) {
  constexpr std::array<schema::Name, 2> words = {"evenodd", "nonzero"};
  field = choose(given, words) == 0 ? FillRule::even_odd : FillRule::nonzero;
}

void convert(const Given& given, Context&, TextAlignment& field) {
  constexpr std::array<schema::Name, 3> words = {"left", "center", "right"};
  field = static_cast<TextAlignment>(choose(given, words));
}

void convert(const Given& given, Context&, SharedMaterial& field) {
  field = get<SharedMaterial>(given);
}

void convert(const Given& given, Context& context, std::shared_ptr<const Image>& field) {
  FileName file;
  convert(given, context, file);
  field = context.files.image(file.name, file.directory, file.span, context.reporter);
}

void convert(const Given& given, Context& context, FileName& field) {
  field = {.name = get<String>(given)->text,
           .directory = context.sources.source_of(given.value_span).directory,
           .span = given.value_span};
}

std::vector<Contour> contours_of(const Given& given, Context& context) {
  const std::vector<Value>& items = get<List>(given)->items;
  const auto is_contour = [](const Value& item) {
    const List* list = std::get_if<List>(&item);
    return list && !(*list)->items.empty() && std::holds_alternative<List>((*list)->items[0]);
  };
  std::vector<Contour> contours;
  if (std::all_of(items.begin(), items.end(), is_contour)) {
    for (const Value& item : items) {
      contours.push_back(contour_of(given, context, std::get<List>(item)->items));
    }
  } else {
    contours.push_back(contour_of(given, context, items));
  }
  return contours;
}

void convert(const Given& given, Context& context, std::shared_ptr<const Profile>& field) {
  field = make_profile(contours_of(given, context));
}

void convert(const Given& given, Context& context, std::shared_ptr<const Font>& field) {
  FileName file;
  convert(given, context, file);
  field = context.files.font(file.name, file.directory, file.span);
}

void convert(const Given& given, Context& context, HeightImage& field) {
  FileName file;
  convert(given, context, file);
  field.grid = context.files.heights(file.name, file.directory, file.span, context.reporter);
}

void convert(const Given& given, Context& context, HeightRows& field) {
  const std::vector<Value>& rows = get<List>(given)->items;
  std::vector<double> heights;
  std::size_t columns = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const List* row = std::get_if<List>(&rows[i]);
    if (!row) {
      reject(given, text::format("must have rows such as [0, 0.5, 1]; it has {} in it",
                                 type_with_article(rows[i])));
    }
    const std::vector<Value>& items = (*row)->items;
    if (i == 0) columns = items.size();
    if (items.size() != columns) {
      reject(given,
             text::format("must have rows of one length; row {} has {} heights, row 0 has {}", i,
                          items.size(), columns));
    }
    context.spend(given.value_span, items.size());
    context.files.take_pixels(items.size(), given.value_span);
    for (const Value& item : items) {
      double storage = 0;
      const double* number = as_float(item, storage);
      if (!number) {
        reject(given,
               text::format("must have numbers; it has {} in row {}", type_with_article(item), i));
      }
      heights.push_back(*number);
    }
  }
  // One that has too many rows has too many heights in memory already.
  field.grid = make_height_grid(std::move(heights), static_cast<std::uint32_t>(columns),
                                static_cast<std::uint32_t>(rows.size()));
}

void convert(const Given& given, Context&, Field& field) {
  double storage = 0;
  if (const double* number = as_float(given.value, storage)) require_finite(given, *number);
  const std::optional<Field> value = as_field(given.value);
  if (!value) wrong_type(given);
  field = *value;
}

void convert(const Given& given, Context&, Camera& field) {
  field = *get<std::shared_ptr<const Camera>>(given);
}

void convert(const Given& given, Context&, std::vector<Light>& field) {
  field.clear();
  for (const Value& item : get<List>(given)->items) {
    const auto* light = std::get_if<std::shared_ptr<const Light>>(&item);
    if (!light)
      reject(given,
             text::format("must be a List of lights; it has {} in it", type_with_article(item)));
    field.push_back(**light);
  }
}

void convert(const Given& given, Context&, Background& field) {
  field = *get<std::shared_ptr<const Background>>(given);
}

void convert(const Given& given, Context&, std::optional<SharedMaterial>& field) {
  field = get<SharedMaterial>(given);
}

}  // namespace crt::lang
