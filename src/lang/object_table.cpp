// The table of objects says what they become. Most attributes are rows of the schema. The texts are
// for the reference, and a test compares them with docs/language.md.
#include <algorithm>
#include <memory>
#include <numbers>

#include "crt/schema_materials.hpp"
#include "crt/schema_primitives.hpp"
#include "crt/schema_scene.hpp"
#include "crt/validate.hpp"
#include "lang/failure.hpp"
#include "lang/field_objects.hpp"
#include "lang/mesh_object.hpp"
#include "lang/schema_objects.hpp"
#include "lang/text_object.hpp"
#include "text/format.hpp"

namespace crt::lang {

void warn_of(const NoSize& no_size, const ObjectSite& site) {
  const Given* const blamed = find_given(site.attributes, no_size.attribute);
  site.context.reporter.warning(
      blamed->value_span,
      text::format("'{}' {}: what has no size draws nothing", no_size.attribute, no_size.reason));
}

namespace {

// ---- entities -------------------------------------------------------------------------------

/// A HeightFieldOfScript has its heights in one of two forms.
struct HeightFieldOfScript {
  HeightImage image;
  HeightRows rows;
  Vec3 corner_a{0, 0, 0};
  Vec3 corner_b{0, 0, 0};
  std::optional<SharedMaterial> material;
};

Value finish_height_field(HeightFieldOfScript given, const ObjectSite& site) {
  site.context.count_made(site.name_span);
  if ((given.image.grid == nullptr) == (given.rows.grid == nullptr)) {
    fail(site.name_span, "HeightField needs one of the attributes 'image' and 'heights'");
  }
  Box box{.corner_a = given.corner_a, .corner_b = given.corner_b};
  const std::optional<NoSize> no_size = give_size(box);
  Entity entity(HeightField{.heights = given.image.grid ? given.image.grid : given.rows.grid,
                            .corner_a = box.corner_a,
                            .corner_b = box.corner_b,
                            .material = std::move(given.material)});
  if (!no_size) return entity;
  warn_of(*no_size, site);
  return empty_entity();
}

ObjectType height_field() {
  using Fields = HeightFieldOfScript;
  return object<Fields>(
      "HeightField",
      {attribute("image", &Fields::image, "none"), attribute("heights", &Fields::rows, "none"),
       required("cornerA", &Fields::corner_a), required("cornerB", &Fields::corner_b),
       attribute("material", &Fields::material, "a grey of 0.5")},
      finish_height_field);
}

/// Lets an object say what meets its entity.
void take_visibility(ObjectType& type) {
  for (const std::string_view name : {"shadow", "visible"}) {
    type.attributes.push_back({.name = name,
                               .type = type_text(static_cast<const bool*>(nullptr)),
                               .default_text = "true",
                               .choices = {},
                               .rule = {},
                               .about = {},
                               .assign = [](void*, const Given& given, Context& context) {
                                 bool is_boolean = false;
                                 convert(given, context, is_boolean);
                               }});
  }
  type.build = [build = std::move(type.build)](const ObjectSite& site) -> Value {
    Value value = build(site);
    const auto given = [&](std::string_view name) {
      const Given* const attribute = find_given(site.attributes, name);
      return attribute == nullptr ? nullptr : std::get_if<bool>(&attribute->value);
    };
    if (const bool* casts = given("shadow")) value = std::get<Entity>(value).with_shadow(*casts);
    if (const bool* is = given("visible")) value = std::get<Entity>(value).with_visible(*is);
    return value;
  };
}

/// Lists the entities in the order in which messages do.
std::vector<ObjectType> entity_types() {
  std::vector<ObjectType> types = {entity<Sphere>(),    entity<Box>(),       entity<Plane>(),
                                   entity<HalfPlane>(), entity<Cylinder>(),  entity<Cone>(),
                                   entity<Capsule>(),   entity<Torus>(),     entity<Disc>(),
                                   entity<Triangle>(),  entity<Extrusion>(), entity<Revolution>(),
                                   height_field(),      entity<Quadric>(),   mesh_object(),
                                   text_object(),       entity<Implicit>()};
  for (ObjectType& type : field_objects()) types.push_back(std::move(type));
  // All others follow. Only programs can make a Custom.
  const auto add = [&types]<class Kind>(std::type_identity<Kind>) {
    const auto is_it = [](const ObjectType& type) { return type.name == schema::table<Kind>.name; };
    if constexpr (!std::is_same_v<Kind, Custom>) {
      if (std::none_of(types.begin(), types.end(), is_it)) types.push_back(entity<Kind>());
    }
  };
  schema::for_each_kind<Primitive>(add);
  schema::for_each_kind<schema::MadeSolids>(add);
  for (ObjectType& type : types) take_visibility(type);
  return types;
}

// ---- materials and patterns -----------------------------------------------------------------

/// Warns of colours of a surface that are brighter than white. Scripts of 2015 are what they are.
void warn_of_bright_colors(const ObjectSite& site) {
  if (site.context.compat == compat_2015) return;
  for (const Given& given : site.attributes) {
    const auto* color = std::get_if<Color>(&given.value);
    const bool is_share = given.type->name != "absorption" && given.type->name != "emission";
    if (color == nullptr || !is_share || std::max({color->r, color->g, color->b}) <= 1) continue;
    site.context.reporter.warning(
        given.value_span,
        text::format("'{}' is brighter than white: the components of a surface's colour are shares "
                     "from 0 to 1",
                     given.type->name));
  }
}

Value finish_material(Material material, const ObjectSite& site) {
  const bool too_bright = material.reflectivity + material.transparency > 1;
  const SharedMaterial shared(std::move(material));
  if (too_bright) {
    site.context.reporter.warning(
        site.name_span,
        "'reflectivity' and 'transparency' together are more than 1: more light leaves than comes");
  }
  warn_of_bright_colors(site);
  return shared;
}

Value finish_principled(PrincipledMaterial material, const ObjectSite& site) {
  SharedMaterial shared(std::move(material));
  warn_of_bright_colors(site);
  return shared;
}

template <class Kind>
Value finish_pattern(Kind kind, const ObjectSite& site) {
  warn_of_bright_colors(site);
  auto pattern = std::make_shared<const Pattern>(std::move(kind));
  validate(*pattern);
  return pattern;
}

/// Lets an attribute be a colour or another pattern in its place.
template <class Kind>
void take_patterns(AttributeType& type, Color Kind::*color, SharedPattern Kind::*pattern) {
  type.type = type_text(static_cast<const std::variant<Color, Pattern>*>(nullptr));
  type.assign = [color, pattern](void* object, const Given& given, Context& context) {
    auto& kind = *static_cast<Kind*>(object);
    std::variant<Color, Pattern> value;
    convert(given, context, value);
    if (auto* inner = std::get_if<Pattern>(&value)) {
      kind.*pattern = nested(std::move(*inner));
    } else {
      kind.*color = std::get<Color>(value);
    }
  };
}

/// Makes the row of a pattern. Two colours come first, then the stops that take their place.
template <class Kind>
ObjectType pattern() {
  std::vector<AttributeType> attributes = attributes_of<Kind>();
  if constexpr (requires(Kind kind) { kind.pattern_a; }) {
    take_patterns(attributes[0], &Kind::color_a, &Kind::pattern_a);
    take_patterns(attributes[1], &Kind::color_b, &Kind::pattern_b);
  }
  if constexpr (requires(Kind kind) { kind.colors; })
    std::rotate(attributes.begin() + 2, attributes.end() - 1, attributes.end());
  return object<Kind>(schema::table<Kind>.name, std::move(attributes), finish_pattern<Kind>);
}

// ---- camera, lights, background -----------------------------------------------------------------

Value finish_camera(Camera camera, const ObjectSite& site) {
  const Given* const aperture = find_given(site.attributes, "aperture");
  const Given* const lens_radius = find_given(site.attributes, "lensradius");
  if (aperture && lens_radius) {
    fail(lens_radius->name_span,
         "the camera has an 'aperture' already, which is the same in thousandths: one of the two "
         "has to go");
  }
  if (lens_radius) camera.aperture = 0;  // That of 2015 is not meant.
  // The projection comes from Settings, which checks the camera again. Spherical allows the most.
  Camera widest = camera;
  widest.projection = Projection::spherical;
  validate(widest);
  return std::make_shared<const Camera>(camera);
}

/// Holds the three kinds of background in one. The given attributes decide which it is.
struct BackgroundFields {
  std::optional<Color> color;
  std::optional<Color> horizon;
  std::optional<Color> sky;
  std::shared_ptr<const Image> image;
  std::optional<double> angle;
  std::optional<PanoramaProjection> projection;
};

Background choose_background(const BackgroundFields& fields, Span span) {
  const bool solid = fields.color.has_value();
  const bool gradient = fields.horizon || fields.sky;
  const bool panorama = fields.image || fields.angle || fields.projection;
  const auto refuse = [span](const char* message) { fail(span, "{}", message); };
  if (solid + gradient + panorama > 1)
    refuse(
        "Background takes either color, or horizon and sky, or image with angle and projection; "
        "not two of "
        "these");
  if (gradient && !(fields.horizon && fields.sky))
    refuse("Background needs both of horizon and sky");
  if (panorama && !fields.image)
    refuse("Background needs the attribute 'image' for its angle and projection");
  if (gradient) return GradientBackground{*fields.horizon, *fields.sky};
  if (panorama) {
    return PanoramaBackground{fields.image,
                              fields.projection.value_or(PanoramaProjection::spherical),
                              fields.angle.value_or(0)};
  }
  SolidBackground background;
  if (solid) background.color = *fields.color;
  return background;
}

Value finish_background(BackgroundFields fields, const ObjectSite& site) {
  auto background = std::make_shared<const Background>(choose_background(fields, site.name_span));
  validate(*background);
  return background;
}

ObjectType background() {
  using Fields = BackgroundFields;
  return object<Fields>(
      "Background",
      {attribute("color", &Fields::color, "rgb(1, 1, 1)"),
       attribute("horizon", &Fields::horizon, "none"), attribute("sky", &Fields::sky, "none"),
       attribute("image", &Fields::image, "none"), attribute("angle", &Fields::angle, "0"),
       attribute("projection", &Fields::projection, "\"spherical\"")},
      finish_background);
}

Value finish_sky(SkyBackground sky, const ObjectSite&) {
  auto background = std::make_shared<const Background>(sky);
  validate(*background);
  return background;
}

}  // namespace

std::span<const ObjectType> object_types() {
  static const std::vector<ObjectType> table = [] {
    std::vector<ObjectType> types = entity_types();
    types.push_back(object<Material>("Material", attributes_of<Material>(), finish_material));
    types.push_back(object<PrincipledMaterial>(
        "PrincipledMaterial", attributes_of<PrincipledMaterial>(), finish_principled));
    schema::for_each_kind<Pattern>(
        [&types]<class Kind>(std::type_identity<Kind>) { types.push_back(pattern<Kind>()); });
    types.push_back(object<Camera>("Camera", attributes_of<Camera>(), finish_camera));
    schema::for_each_kind<Light>(
        [&types]<class Kind>(std::type_identity<Kind>) { types.push_back(light<Kind>()); });
    types.push_back(background());
    types.push_back(object<SkyBackground>("Sky", attributes_of<SkyBackground>(), finish_sky));
    return types;
  }();
  return table;
}

}  // namespace crt::lang
