// The table of objects lists attributes with their defaults, and what they become. The numbers
// behind the defaults are those of the core's structs. The texts are for the reference, and a test
// compares both with docs/language.md.
#include <algorithm>
#include <memory>
#include <numbers>

#include "crt/validate.hpp"
#include "lang/failure.hpp"
#include "lang/field_objects.hpp"
#include "lang/mesh_object.hpp"
#include "lang/no_size.hpp"
#include "lang/object_builder.hpp"
#include "lang/text_object.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

// ---- entities -------------------------------------------------------------------------------

void warn_of(const NoSize& no_size, const ObjectSite& site) {
  const Given* const blamed = find_given(site.attributes, no_size.attribute);
  site.context.reporter.warning(
      blamed->value_span,
      text::format("'{}' {}: what has no size draws nothing", no_size.attribute, no_size.reason));
}

template <class Shape>
ObjectType entity(std::string_view name, std::vector<AttributeType> attributes) {
  attributes.push_back(attribute("material", &Shape::material, "a grey of 0.5"));
  return object<Shape>(
      name, std::move(attributes), +[](Shape shape, const ObjectSite& site) -> Value {
        site.context.count_made(site.name_span);
        const std::optional<NoSize> no_size = give_size(shape);
        Entity entity(std::move(shape));
        if (!no_size) return entity;
        warn_of(*no_size, site);
        return empty_entity();
      });
}

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

std::vector<ObjectType> entity_types() {
  return {
      entity<Sphere>("Sphere",
                     {required("center", &Sphere::center), required("radius", &Sphere::radius)}),
      entity<Box>("Box",
                  {required("cornerA", &Box::corner_a), required("cornerB", &Box::corner_b)}),
      entity<Plane>("Plane",
                    {required("normal", &Plane::normal), required("position", &Plane::position)}),
      entity<HalfPlane>("HalfPlane", {required("normal", &HalfPlane::normal),
                                      required("position", &HalfPlane::position),
                                      required("direction", &HalfPlane::direction)}),
      entity<Cylinder>("Cylinder",
                       {required("from", &Cylinder::from), required("to", &Cylinder::to),
                        required("radius", &Cylinder::radius)}),
      entity<Cone>("Cone",
                   {required("from", &Cone::from), required("to", &Cone::to),
                    required("radius", &Cone::radius), attribute("radius2", &Cone::radius2, "0")}),
      entity<Capsule>("Capsule", {required("from", &Capsule::from), required("to", &Capsule::to),
                                  required("radius", &Capsule::radius)}),
      entity<Torus>("Torus",
                    {required("center", &Torus::center), required("axis", &Torus::axis),
                     required("radius", &Torus::radius), required("thickness", &Torus::thickness)}),
      entity<Disc>("Disc", {required("center", &Disc::center), required("normal", &Disc::normal),
                            required("radius", &Disc::radius)}),
      entity<Triangle>("Triangle", {required("a", &Triangle::a), required("b", &Triangle::b),
                                    required("c", &Triangle::c)}),
      entity<Extrusion>("Extrusion", {required("profile", &Extrusion::profile),
                                      required("height", &Extrusion::to)}),
      entity<Revolution>("Revolution", {required("profile", &Revolution::profile),
                                        degrees("angle", &Revolution::angle, "360",
                                                "must be greater than 0 and at most 360 degrees")}),
      object<HeightFieldOfScript>(
          "HeightField",
          {attribute("image", &HeightFieldOfScript::image, "none"),
           attribute("heights", &HeightFieldOfScript::rows, "none"),
           required("cornerA", &HeightFieldOfScript::corner_a),
           required("cornerB", &HeightFieldOfScript::corner_b),
           attribute("material", &HeightFieldOfScript::material, "a grey of 0.5")},
          finish_height_field),
      entity<Quadric>("Quadric", {required("squares", &Quadric::squares),
                                  attribute("products", &Quadric::products, "vec3(0, 0, 0)"),
                                  attribute("linear", &Quadric::linear, "vec3(0, 0, 0)"),
                                  required("constant", &Quadric::constant)}),
      mesh_object(),
      text_object(),
  };
}

// ---- materials and patterns -----------------------------------------------------------------

/// Warns of colours of a surface that are brighter than white. Scripts of 2015 are what they are.
void warn_of_bright_colors(const ObjectSite& site) {
  if (site.context.compat == compat_2015) return;
  for (const Given& given : site.attributes) {
    const auto* color = std::get_if<Color>(&given.value);
    const bool is_absorption = given.type->name == "absorption";
    if (color == nullptr || is_absorption || std::max({color->r, color->g, color->b}) <= 1)
      continue;
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

ObjectType material() {
  return object<Material>(
      "Material",
      {attribute("color", &Material::color, "rgb(0.5, 0.5, 0.5)"),
       attribute("reflectivity", &Material::reflectivity, "0"),
       attribute("transparency", &Material::transparency, "0"),
       attribute("refractiveindex", &Material::refractive_index, "1"),
       attribute("diffuse", &Material::diffuse, "1 - reflectivity - transparency, at least 0"),
       attribute("specular", &Material::specular, "0"),
       attribute("shininess", &Material::shininess, "3"),
       attribute("absorption", &Material::absorption, "rgb(0, 0, 0)"),
       attribute("bump", &Material::bump, "none"),
       attribute("bumpheight", &Material::bump_height, "0.1")},
      finish_material);
}

template <class Kind>
Value finish_pattern(Kind kind, const ObjectSite& site) {
  warn_of_bright_colors(site);
  auto pattern = std::make_shared<const Pattern>(std::move(kind));
  validate(*pattern);
  return pattern;
}

/// Makes an attribute that is a colour or another pattern in its place.
template <class Kind>
AttributeType color_or_pattern(std::string_view name, Color Kind::*color,
                               SharedPattern Kind::*pattern, std::string_view default_text) {
  AttributeType type = attribute(name, color, default_text);
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
  return type;
}

/// Makes the row of a pattern of two colours: these, its own attributes, then its size and place.
template <class Kind>
ObjectType two_colors(std::string_view name, std::string_view color_a, std::string_view color_b,
                      std::vector<AttributeType> own) {
  std::vector<AttributeType> attributes = {
      color_or_pattern("colorA", &Kind::color_a, &Kind::pattern_a, color_a),
      color_or_pattern("colorB", &Kind::color_b, &Kind::pattern_b, color_b)};
  if constexpr (requires(Kind kind) { kind.colors; })
    attributes.push_back(attribute("colors", &Kind::colors, "none"));
  attributes.insert(attributes.end(), own.begin(), own.end());
  attributes.push_back(attribute("scale", &Kind::scale, "1"));
  attributes.push_back(attribute("offset", &Kind::offset, "vec3(0, 0, 0)"));
  return object<Kind>(name, std::move(attributes), finish_pattern<Kind>);
}

std::vector<ObjectType> patterns() {
  constexpr const char* white = "rgb(1, 1, 1)";
  constexpr const char* black = "rgb(0, 0, 0)";
  return {
      two_colors<Checker>("Checker", white, black, {}),
      two_colors<Stripes>("Stripes", white, black,
                          {attribute("direction", &Stripes::direction, "vec3(1, 0, 0)")}),
      two_colors<Gradient>("Gradient", white, black,
                           {attribute("direction", &Gradient::direction, "vec3(0, 1, 0)")}),
      two_colors<Noise>("Noise", white, black, {attribute("octaves", &Noise::octaves, "4")}),
      two_colors<Marble>("Marble", white, black,
                         {attribute("direction", &Marble::direction, "vec3(1, 0, 0)"),
                          attribute("turbulence", &Marble::turbulence, "1"),
                          attribute("octaves", &Marble::octaves, "4")}),
      two_colors<Wood>("Wood", "rgb(0.6, 0.4, 0.2)", "rgb(0.3, 0.15, 0.05)",
                       {attribute("direction", &Wood::direction, "vec3(0, 1, 0)"),
                        attribute("turbulence", &Wood::turbulence, "0.1"),
                        attribute("octaves", &Wood::octaves, "3")}),
      object<ImageMap>(
          "ImageMap",
          {required("image", &ImageMap::image), attribute("repeatU", &ImageMap::repeat_u, "1"),
           attribute("repeatV", &ImageMap::repeat_v, "1"),
           attribute("mapping", &ImageMap::mapping, "\"uv\""),
           attribute("direction", &ImageMap::direction, "vec3(0, 0, 1)"),
           attribute("scale", &ImageMap::scale, "1"),
           attribute("offset", &ImageMap::offset, "vec3(0, 0, 0)")},
          finish_pattern<ImageMap>),
  };
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

ObjectType camera() {
  return object<Camera>(
      "Camera",
      {required("position", &Camera::position), required("pointing", &Camera::pointing),
       degrees("fov", &Camera::fov, "60", "must be greater than 0 and less than 180 degrees"),
       degrees("roll", &Camera::roll, "0", "must be a number of degrees of at most 1e30"),
       attribute("aperture", &Camera::aperture, "0"),
       attribute("lensradius", &Camera::lens_radius, "0"),
       attribute("focaldistance", &Camera::focal_distance, "1"),
       attribute("apertureshape", &Camera::aperture_shape, "\"circle\"")},
      finish_camera);
}

template <class Kind>
Value finish_light(Kind kind, const ObjectSite&) {
  auto light = std::make_shared<const Light>(kind);
  validate(*light);
  return light;
}

std::vector<ObjectType> lights() {
  return {
      object<PointLight>(
          "PointLight",
          {required("origin", &PointLight::origin), required("color", &PointLight::color),
           attribute("falloff", &PointLight::falloff, "0"),
           attribute("ambient", &PointLight::ambient, "0")},
          finish_light<PointLight>),
      object<ParallelLight>(
          "ParallelLight",
          {required("from", &ParallelLight::from), required("pointing", &ParallelLight::pointing),
           required("color", &ParallelLight::color),
           attribute("ambient", &ParallelLight::ambient, "0")},
          finish_light<ParallelLight>),
      object<SpotLight>(
          "SpotLight",
          {required("origin", &SpotLight::origin), required("pointing", &SpotLight::pointing),
           required("color", &SpotLight::color),
           degrees("angle", &SpotLight::angle, "60",
                   "must be greater than 0 and at most 360 degrees"),
           degrees("penumbra", &SpotLight::penumbra, "5",
                   "must be between 0 and half of 'angle' (in degrees)"),
           attribute("falloff", &SpotLight::falloff, "0"),
           attribute("ambient", &SpotLight::ambient, "0")},
          finish_light<SpotLight>),
      object<CylinderLight>(
          "CylinderLight",
          {required("origin", &CylinderLight::origin),
           required("pointing", &CylinderLight::pointing), required("color", &CylinderLight::color),
           required("radius", &CylinderLight::radius),
           attribute("falloff", &CylinderLight::falloff, "0"),
           attribute("ambient", &CylinderLight::ambient, "0")},
          finish_light<CylinderLight>),
  };
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

}  // namespace

std::span<const ObjectType> object_types() {
  static const std::vector<ObjectType> table = [] {
    std::vector<ObjectType> types = entity_types();
    for (ObjectType& type : field_objects()) types.push_back(std::move(type));
    types.push_back(material());
    for (ObjectType& type : patterns()) types.push_back(std::move(type));
    types.push_back(camera());
    for (ObjectType& type : lights()) types.push_back(std::move(type));
    types.push_back(background());
    return types;
  }();
  return table;
}

}  // namespace crt::lang
