#include "lang/field_objects.hpp"

#include <optional>
#include <string_view>
#include <utility>

#include "crt/implicit_shapes.hpp"
#include "lang/failure.hpp"
#include "lang/fields.hpp"
#include "lang/object_builder.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// BlobParts are a List of parts as a script has them.
struct BlobParts {
  std::vector<BlobPart> parts;

  friend constexpr std::string_view type_text(const BlobParts*) { return "List of parts"; }
};

/// These are a blob and a superellipsoid as a script has them.
struct BlobOfScript {
  BlobParts parts;
  double threshold = 0;
  std::optional<SharedMaterial> material;
};
struct SuperellipsoidOfScript {
  double east_west = 1;
  double north_south = 1;
  std::optional<SharedMaterial> material;
};

/// Reads [center, radius, strength] or [from, to, radius, strength].
std::optional<BlobPart> blob_part(const Value& value) {
  const List* list = std::get_if<List>(&value);
  if (list == nullptr) return std::nullopt;
  const std::vector<Value>& items = (*list)->items;
  constexpr std::size_t items_of_ball = 3;
  const bool is_ball = items.size() == items_of_ball;
  if (!is_ball && items.size() != items_of_ball + 1) return std::nullopt;
  const auto* from = std::get_if<Vec3>(&items[0]);
  const auto* to = std::get_if<Vec3>(&items[is_ball ? 0 : 1]);
  double radius = 0;
  double strength = 0;
  const double* r = as_float(items[items.size() - 2], radius);
  const double* s = as_float(items.back(), strength);
  if (from == nullptr || to == nullptr || r == nullptr || s == nullptr) return std::nullopt;
  return BlobPart{.from = *from, .to = *to, .radius = *r, .strength = *s};
}

void convert(const Given& given, Context& context, BlobParts& field) {
  const List* list = std::get_if<List>(&given.value);
  if (list == nullptr) {
    fail(given.value_span, "'{}' must be a {}, not {}", given.type->name, given.type->type,
         given.value);
  }
  context.spend(given.value_span, (*list)->items.size());
  for (const Value& item : (*list)->items) {
    const std::optional<BlobPart> part = blob_part(item);
    if (!part) {
      fail(given.value_span,
           "'{}' must have parts such as [vec3(0, 0, 0), 1, 1] with a center, a radius and a "
           "strength, or [vec3(0, 0, 0), vec3(1, 0, 0), 1, 1] along a line; it has {} in it",
           given.type->name, item);
    }
    field.parts.push_back(*part);
  }
}

Value finish_blob(BlobOfScript given, const ObjectSite& site) {
  // A part has some ten operations.
  constexpr std::size_t steps_per_part = 10 * steps_per_field;
  site.context.count_made(site.name_span);
  site.context.spend(site.name_span, steps_per_part * given.parts.parts.size());
  Implicit made = blob(given.parts.parts, given.threshold);
  made.material = std::move(given.material);
  return Entity(std::move(made));
}

Value finish_superellipsoid(SuperellipsoidOfScript given, const ObjectSite& site) {
  constexpr std::size_t operations = 12;
  site.context.count_made(site.name_span);
  site.context.spend(site.name_span, operations * steps_per_field);
  Implicit made = superellipsoid(given.east_west, given.north_south);
  made.material = std::move(given.material);
  return Entity(std::move(made));
}

}  // namespace

std::vector<ObjectType> field_objects() {
  return {
      object<BlobOfScript>(
          "Blob",
          {required("parts", &BlobOfScript::parts), required("threshold", &BlobOfScript::threshold),
           attribute("material", &BlobOfScript::material, "a grey of 0.5")},
          finish_blob),
      object<SuperellipsoidOfScript>(
          "Superellipsoid",
          {required("eastwest", &SuperellipsoidOfScript::east_west),
           required("northsouth", &SuperellipsoidOfScript::north_south),
           attribute("material", &SuperellipsoidOfScript::material, "a grey of 0.5")},
          finish_superellipsoid),
  };
}

}  // namespace crt::lang
