#include "core/mesh_files/model_part.hpp"

#include <string_view>

#include "core/base/text_numbers.hpp"
#include "core/math/vector.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "core/mesh_files/xml_reader.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

constexpr std::string_view core_space = "http://schemas.microsoft.com/3dmanufacturing/core/";
constexpr std::string_view production_space =
    "http://schemas.microsoft.com/3dmanufacturing/production/";

std::string_view needed(const XmlElement& element, std::string_view attribute) {
  const XmlAttribute* const found = element.find(attribute);
  if (found == nullptr)
    throw RefusedMesh(text::format("<{}> has no attribute '{}'", element.name.local, attribute));
  return found->value;
}

double coordinate(const XmlElement& element, std::string_view attribute) {
  const std::string_view text = needed(element, attribute);
  const std::optional<double> value = number_of(text);
  const char* const fault = value ? coordinate_fault(*value) : "is no number";
  if (fault != nullptr)
    throw RefusedMesh(text::format("the coordinate {} {} {}", attribute, in_quotes(text), fault));
  return *value;
}

std::int64_t id(const XmlElement& element, std::string_view attribute) {
  const std::string_view text = needed(element, attribute);
  const std::optional<std::int64_t> value = integer_of(text);
  if (!value || *value < 1) {
    throw RefusedMesh(text::format("{} of <{}> is {}; it should be a whole number from 1",
                                   attribute, element.name.local, in_quotes(text)));
  }
  return *value;
}

std::uint32_t corner(const XmlElement& element, std::string_view attribute, std::size_t vertices) {
  const std::string_view text = needed(element, attribute);
  const std::optional<std::int64_t> value = integer_of(text);
  if (!value || *value < 0 || *value >= static_cast<std::int64_t>(vertices)) {
    throw RefusedMesh(text::format("{} of <triangle> is {}; the object has vertices from 0 to {}",
                                   attribute, in_quotes(text),
                                   static_cast<std::int64_t>(vertices) - 1));
  }
  return static_cast<std::uint32_t>(*value);
}

ModelTransform transform_of(std::string_view text) {
  TextCursor cursor(text);
  ModelTransform transform;
  for (Vec3& row : transform.rows) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view word = cursor.word();
      const std::optional<double> value = number_of(word);
      if (!value || coordinate_fault(*value) != nullptr) {
        throw RefusedMesh(
            text::format("a transform has {}; it should be 12 numbers", in_quotes(word)));
      }
      row[axis] = *value;
    }
  }
  if (!cursor.at_end()) throw RefusedMesh("a transform has more than 12 numbers");
  return transform;
}

PlacedObject placed_object(const XmlElement& element) {
  PlacedObject placed;
  placed.id = id(element, "objectid");
  for (const XmlAttribute& attribute : element.attributes) {
    if (attribute.name.space.starts_with(production_space) && attribute.name.local == "path")
      placed.path = attribute.value;
  }
  if (const XmlAttribute* transform = element.find("transform"))
    placed.transform = transform_of(transform->value);
  return placed;
}

/// Puts together the part whose elements it is given.
class PartBuilder {
 public:
  void take(const XmlElement& element) {
    const std::string_view name = element.name.local;
    if (!has_model_) {
      if (name != "model" || !element.name.space.starts_with(core_space))
        throw RefusedMesh("it is no 3MF model: it should begin with <model>");
      has_model_ = true;
    }
    // Extensions have elements of the same names.
    if (!element.name.space.starts_with(core_space)) return;
    if (name == "vertex") {
      object(element).positions.emplace_back(coordinate(element, "x"), coordinate(element, "y"),
                                             coordinate(element, "z"));
    } else if (name == "triangle") {
      ModelObject& mesh = object(element);
      const std::size_t count = mesh.positions.size();
      mesh.triangles.push_back({corner(element, "v1", count), corner(element, "v2", count),
                                corner(element, "v3", count)});
    } else if (name == "component") {
      object(element).components.push_back(placed_object(element));
    } else if (name == "object") {
      const std::int64_t number = id(element, "id");
      const auto [place, is_new] = part_.objects.try_emplace(number);
      if (!is_new) throw RefusedMesh(text::format("there are two objects with the id {}", number));
      object_ = &place->second;
    } else if (name == "item") {
      part_.build.push_back(placed_object(element));
    }
  }

  ModelPart finish() { return std::move(part_); }

 private:
  ModelObject& object(const XmlElement& element) {
    if (object_ == nullptr)
      throw RefusedMesh(text::format("<{}> stands outside of an <object>", element.name.local));
    return *object_;
  }

  bool has_model_ = false;
  ModelPart part_;
  ModelObject* object_ = nullptr;
};

}  // namespace

Vec3 ModelTransform::operator()(const Vec3& position) const {
  return rows[0] * position.x + rows[1] * position.y + rows[2] * position.z + rows[3];
}

bool ModelTransform::mirrors() const {
  return dot(cross(rows[0], rows[1]), rows[2]) < 0;
}

ModelPart read_model_part(ZipArchive& archive, const ZipEntry& entry) {
  PartBuilder builder;
  XmlReader xml(std::string(entry.name), [&](const XmlElement& element) { builder.take(element); });
  archive.unpack(entry, [&](std::string_view piece) { xml.read(piece); });
  xml.finish();
  return builder.finish();
}

}  // namespace crt::core
