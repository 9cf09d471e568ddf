// Writes binary glTF files: Khronos, glTF 2.0 Specification. They have no normals, so programs show
// each triangle flat.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/mesh_files/surface_writers.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

constexpr std::uint32_t glb_magic = 0x46546c67;   // "glTF"
constexpr std::uint32_t json_chunk = 0x4e4f534a;  // "JSON"
constexpr std::uint32_t bin_chunk = 0x004e4942;   // "BIN"

// These are numbers of OpenGL.
constexpr int float_numbers = 5126;
constexpr int unsigned_numbers = 5125;
constexpr int array_buffer = 34962;
constexpr int element_buffer = 34963;

std::string json_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + "\"";
}

/// Puts together what a file says of its parts, and their numbers.
class GlbWriter {
 public:
  explicit GlbWriter(const SurfaceFile& file) : scale_(metres_of(file.unit)) {
    const SurfaceCounts counts = counts_of(file);
    numbers_.reserve(12 * (counts.positions + counts.triangles));
    for (const SurfacePart& part : file.parts) add(part);
    json_ =
        text::format("{{\"asset\":{{\"version\":\"2.0\",\"generator\":\"CRT\"{}}},", extras(file));
    json_ += "\"scene\":0,\"scenes\":[{\"nodes\":[" + scene_ + "]}],\"nodes\":[" + nodes_ +
             "],\"meshes\":[" + meshes_ + "],";
    if (!materials_.empty()) json_ += "\"materials\":[" + materials_ + "],";
    json_ += text::format("\"buffers\":[{{\"byteLength\":{}}}],", numbers_.size());
    json_ += "\"bufferViews\":[" + views_ + "],\"accessors\":[" + accessors_ + "]}";
  }

  std::string bytes() const {
    std::string json = json_;
    json.resize((json.size() + 3) / 4 * 4, ' ');
    constexpr std::uint64_t head = 12;
    constexpr std::uint64_t head_of_chunk = 8;
    const std::uint64_t size = head + 2 * head_of_chunk + json.size() + numbers_.size();
    check_bytes("glTF", size);
    std::string bytes;
    bytes.reserve(size);
    append_bytes(bytes, glb_magic);
    append_bytes(bytes, std::uint32_t{2});
    append_bytes(bytes, static_cast<std::uint32_t>(size));
    append_bytes(bytes, static_cast<std::uint32_t>(json.size()));
    append_bytes(bytes, json_chunk);
    bytes += json;
    append_bytes(bytes, static_cast<std::uint32_t>(numbers_.size()));
    append_bytes(bytes, bin_chunk);
    return bytes + numbers_;
  }

 private:
  /// Returns the deviation in metres, where it is known.
  std::string extras(const SurfaceFile& file) const {
    if (!std::isfinite(file.deviation)) return {};
    return text::format(",\"extras\":{{\"deviation\":{}}}", file.deviation * scale_);
  }

  static void append_item(std::string& list, const std::string& item) {
    if (!list.empty()) list += ',';
    list += item;
  }

  void add(const SurfacePart& part) {
    const std::string name = json_text(part.name);
    const std::size_t positions = add_positions(part.mesh->positions);
    const std::size_t indices = add_triangles(*part.mesh);
    std::string material;
    if (part.color) material = text::format(",\"material\":{}", add_material(name, *part.color));
    append_item(meshes_, text::format("{{\"name\":{},\"primitives\":[{{\"attributes\":"
                                      "{{\"POSITION\":{}}},\"indices\":{}{}}}]}}",
                                      name, positions, indices, material));
    append_item(nodes_, text::format("{{\"name\":{},\"mesh\":{}}}", name, parts_));
    append_item(scene_, text::format("{}", parts_));
    ++parts_;
  }

  std::size_t add_positions(const std::vector<Vec3>& positions) {
    std::array<float, 3> least{};
    std::array<float, 3> most{};
    const std::size_t begin = numbers_.size();
    for (std::size_t i = 0; i < positions.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto number = static_cast<float>(positions[i][axis] * scale_ + 0.0);
        const auto place = static_cast<std::size_t>(axis);
        least[place] = i == 0 ? number : std::min(least[place], number);
        most[place] = i == 0 ? number : std::max(most[place], number);
        append_bytes(numbers_, number);
      }
    }
    return add_accessor(
        begin, array_buffer,
        text::format("\"componentType\":{},\"count\":{},\"type\":\"VEC3\",\"min\":[{},{},{}],"
                     "\"max\":[{},{},{}]",
                     float_numbers, positions.size(), least[0], least[1], least[2], most[0],
                     most[1], most[2]));
  }

  std::size_t add_triangles(const SurfaceMesh& mesh) {
    const std::size_t begin = numbers_.size();
    for (const auto& corners : mesh.triangles)
      for (const std::uint32_t corner : corners) append_bytes(numbers_, corner);
    return add_accessor(begin, element_buffer,
                        text::format("\"componentType\":{},\"count\":{},\"type\":\"SCALAR\"",
                                     unsigned_numbers, 3 * mesh.triangles.size()));
  }

  /// Describes the numbers from `begin` on. Returns the number of the description.
  std::size_t add_accessor(std::size_t begin, int target, const std::string& what) {
    append_item(views_, text::format("{{\"buffer\":0,\"byteOffset\":{},\"byteLength\":{},"
                                     "\"target\":{}}}",
                                     begin, numbers_.size() - begin, target));
    append_item(accessors_, text::format("{{\"bufferView\":{},{}}}", accessor_count_, what));
    return accessor_count_++;
  }

  std::size_t add_material(const std::string& name, const Color& color) {
    append_item(materials_,
                text::format("{{\"name\":{},\"pbrMetallicRoughness\":{{\"baseColorFactor\":"
                             "[{},{},{},{}],\"metallicFactor\":0,\"roughnessFactor\":0.6}}{}}}",
                             name, color.r, color.g, color.b, color.a,
                             color.a < 1 ? ",\"alphaMode\":\"BLEND\"" : ""));
    return material_count_++;
  }

  double scale_;
  std::string numbers_;
  std::string json_;
  std::string scene_, nodes_, meshes_, materials_, views_, accessors_;
  std::size_t parts_ = 0;
  std::size_t accessor_count_ = 0;
  std::size_t material_count_ = 0;
};

}  // namespace

std::string glb_bytes(const SurfaceFile& file) {
  return GlbWriter(file).bytes();
}

}  // namespace crt::core
