#include "lang/settings.hpp"

#include "crt/schema_scene.hpp"
#include "crt/schema_settings.hpp"
#include "crt/validate.hpp"
#include "lang/failure.hpp"
#include "lang/object_builder.hpp"

namespace crt::lang {

namespace {

/// Holds what a Settings block can set: the settings themselves, and what else of the scene is not
/// geometry.
struct SettingsFields : Settings {
  std::optional<Projection> projection;
  std::optional<Camera> camera;
  std::optional<Background> background;
  std::vector<Light> lights;
};

ObjectType make_settings_type() {
  using Fields = SettingsFields;
  ObjectType type{.name = "Settings", .attributes = attributes_of<Settings, Fields>(), .build = {}};
  type.attributes.push_back(attribute("projection", &Fields::projection, "\"pinhole\""));
  type.attributes.push_back(
      attribute("camera", &Fields::camera, "at vec3(0, 0, -1), pointing at vec3(0, 0, 0)"));
  type.attributes.push_back(attribute("lights", &Fields::lights, "[]"));
  type.attributes.push_back(attribute("background", &Fields::background, "Background { }"));
  return type;
}

/// Returns what Settings begin with.
SettingsFields initial_fields(const Context& context) {
  SettingsFields fields;
  if (context.compat == compat_2015) static_cast<Settings&>(fields) = settings_of_2015();
  return fields;
}

/// Sets compat from the options, or else from what was read before anything ran, as the script
/// cannot compute it.
void settle_compat(const Context& context, const std::vector<Given>& attributes,
                   Settings& settings) {
  if (context.options.compat != 0) settings.compat = context.options.compat;
  if (settings.compat == context.compat) return;
  if (const Given* const given = find_given(attributes, "compat"))
    fail(given->value_span,
         "'compat' decides how a script is read: it must be written as a plain number, 2015 or 0");
}

/// Sets the unit that lengths have from now on. One that they have had already stays.
void settle_unit(Context& context, Span block, const std::vector<Given>& attributes, Unit unit) {
  if (context.unit != unit && context.has_lengths()) {
    const Given* const given = find_given(attributes, "unit");
    fail(given ? given->value_span : block,
         "'unit' decides what lengths such as 10mm are, and there are some before it is known: it "
         "must be written as a plain text, such as \"mm\", in the Settings of the main script");
  }
  context.unit = unit;
}

}  // namespace

const ObjectType& settings_type() {
  static const ObjectType type = make_settings_type();
  return type;
}

void apply_settings(Context& context, Span block, const std::vector<Given>& attributes,
                    Scene& scene) {
  const ObjectSite site = {context, block, attributes};
  SettingsFields fields = assemble(site, initial_fields(context));
  settle_compat(context, attributes, fields);
  settle_unit(context, block, attributes, fields.unit);
  try {
    validate(static_cast<const Settings&>(fields));
  } catch (const Error& error) {
    blame(error, block, attributes);
  }
  scene.camera = fields.camera.value_or(initial<Camera>(site));
  if (fields.projection) scene.camera.projection = *fields.projection;
  if (fields.background) scene.background = std::move(*fields.background);
  scene.lights = std::move(fields.lights);
  scene.settings = std::move(static_cast<Settings&>(fields));
  try {
    validate(scene.camera);
  } catch (const Error& error) {
    // The camera was right by itself, but does not fit the projection.
    const Given* const given = find_given(attributes, "camera");
    throw Failure{.span = given ? given->value_span : block,
                  .message = "only the projection \"spherical\" can have a 'fov' of 180 degrees",
                  .code = error.code()};
  }
}

}  // namespace crt::lang
