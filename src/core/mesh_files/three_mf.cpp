// Reads 3MF files: the objects that the build lists, in their places. See model_part.hpp.
//
// Debian has lib3mf 1.8, which keeps coordinates as floats, so they would not be those of the file.
#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "core/mesh_files/model_part.hpp"
#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "core/mesh_files/xml_reader.hpp"
#include "core/mesh_files/zip_archive.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// Returns the transform that does what `first` does and then what `then` does.
ModelTransform both(const ModelTransform& first, const ModelTransform& then) {
  ModelTransform result;
  for (std::size_t row = 0; row < 4; ++row) {
    const Vec3& from = first.rows[row];
    result.rows[row] = then.rows[0] * from.x + then.rows[1] * from.y + then.rows[2] * from.z;
  }
  result.rows[3] += then.rows[3];
  return result;
}

std::string without_slash(const std::string& path) {
  return path.starts_with('/') ? path.substr(1) : path;
}

/// Returns the name of the part that the package says is its model. Without a word about it, it has
/// the usual name.
std::string main_part(ZipArchive& archive) {
  std::string name = "3D/3dmodel.model";
  const ZipEntry* const relations = archive.find("_rels/.rels");
  if (relations == nullptr) return name;
  XmlReader xml("_rels/.rels", [&](const XmlElement& element) {
    const XmlAttribute* const type = element.find("Type");
    const XmlAttribute* const target = element.find("Target");
    if (element.name.local == "Relationship" && type != nullptr && target != nullptr &&
        type->value.ends_with("/3dmodel"))
      name = without_slash(std::string(target->value));
  });
  archive.unpack(*relations, [&](std::string_view piece) { xml.read(piece); });
  xml.finish();
  return name;
}

/// A ModelAssembly puts the objects of all parts in their places.
class ModelAssembly {
 public:
  ModelAssembly(std::string_view content, MeshBuilder& mesh)
      : archive_(content), mesh_(mesh), max_placed_(content.size() + always_allowed) {}

  void build() {
    const std::string name = main_part(archive_);
    const std::vector<PlacedObject>& items = part(name).build;
    if (items.empty()) throw RefusedMesh("its build has no <item>, so it places no object");
    for (const PlacedObject& item : items) place(name, item, std::nullopt, 0);
  }

 private:
  /// An object may be placed often. So that little files do not become large meshes, all vertices,
  /// triangles and components together are at most this many more than the file has bytes.
  static constexpr std::uint64_t always_allowed = 1'000'000;
  static constexpr int deepest = 64;

  const ModelPart& part(const std::string& name) {
    const auto found = parts_.find(name);
    if (found != parts_.end()) return found->second;
    const ZipEntry* const entry = archive_.find(name);
    if (entry == nullptr) throw RefusedMesh(text::format("it has no part {}", in_quotes(name)));
    return parts_.emplace(name, read_model_part(archive_, *entry)).first->second;
  }

  void count(std::uint64_t placed) {
    placed_ += placed;
    if (placed_ > max_placed_) {
      throw RefusedMesh(
          "its components repeat objects so often that the mesh is out of proportion to the file");
    }
  }

  void place(const std::string& here, const PlacedObject& placed,
             const std::optional<ModelTransform>& outer, int depth) {
    const std::string path = placed.path.empty() ? here : without_slash(placed.path);
    const ModelPart& model = part(path);
    const auto found = model.objects.find(placed.id);
    if (found == model.objects.end())
      throw RefusedMesh(
          text::format("{} has no object with the id {}", in_quotes(path), placed.id));
    if (depth > deepest) {
      throw RefusedMesh(text::format("object {} of {} is nested in others {} deep, or in itself",
                                     placed.id, in_quotes(path), deepest));
    }
    std::optional<ModelTransform> transform = placed.transform ? placed.transform : outer;
    if (placed.transform && outer) transform = both(*placed.transform, *outer);
    const ModelObject& object = found->second;
    add(object, transform);
    count(1);
    for (const PlacedObject& component : object.components)
      place(path, component, transform, depth + 1);
  }

  void add(const ModelObject& object, const std::optional<ModelTransform>& transform) {
    count(object.positions.size() + object.triangles.size());
    const auto first = static_cast<std::uint32_t>(mesh_.position_count());
    for (const Vec3& position : object.positions) {
      const Vec3 moved = transform ? (*transform)(position) : position;
      for (int axis = 0; axis < 3; ++axis) {
        if (const char* const fault = coordinate_fault(moved[axis]))
          throw RefusedMesh(text::format("a coordinate of a vertex in its place {}", fault));
      }
      mesh_.add_position(moved);
    }
    const bool mirrors = transform && transform->mirrors();
    for (TriangleIndices corners : object.triangles) {
      for (std::uint32_t& corner : corners) corner += first;
      if (mirrors) std::swap(corners[1], corners[2]);
      mesh_.add_face(corners);
    }
  }

  ZipArchive archive_;
  MeshBuilder& mesh_;
  std::map<std::string, ModelPart> parts_;
  std::uint64_t placed_ = 0;
  std::uint64_t max_placed_;
};

}  // namespace

void read_three_mf(std::string_view content, MeshBuilder& mesh) {
  ModelAssembly(content, mesh).build();
}

}  // namespace crt::core
