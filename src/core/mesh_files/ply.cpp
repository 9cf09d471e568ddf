// Reads the rows of PLY files: see ply_header.hpp.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh_files/binary_numbers.hpp"
#include "core/mesh_files/ply_header.hpp"
#include "core/mesh_files/readers.hpp"
#include "core/mesh_files/refused_mesh.hpp"
#include "core/mesh_files/text_cursor.hpp"
#include "text/format.hpp"

namespace crt::core {

namespace {

/// A TextRows gives the numbers of a text. Their types mean nothing: what is written counts.
class TextRows {
 public:
  TextRows(std::string_view content, const PlyHeader& header)
      : cursor_(content.substr(header.size), {}, header.lines + 1) {}

  double next(PlyType) { return cursor_.number("a number"); }
  void skip(PlyType type, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) next(type);
  }
  /// Returns how many numbers may follow at most. Each has a digit and a blank behind it.
  std::uint64_t max_left(PlyType) const { return (cursor_.rest().size() + 1) / 2; }
  bool at_end() { return cursor_.at_end(); }
  [[noreturn]] void refuse(const std::string& reason) const { refuse_line(cursor_.line(), reason); }

 private:
  TextCursor cursor_;
};

/// A BinaryRows gives the numbers of a binary file.
class BinaryRows {
 public:
  BinaryRows(std::string_view content, const PlyHeader& header)
      : content_(content),
        order_(header.binary.value_or(std::endian::native)),
        place_(header.size),
        last_(header.size) {}

  double next(PlyType type) {
    using enum PlyType;
    last_ = place_;
    skip(type, 1);
    switch (type) {
      case int8:
        return get<std::int8_t>();
      case uint8:
        return get<std::uint8_t>();
      case int16:
        return get<std::int16_t>();
      case uint16:
        return get<std::uint16_t>();
      case int32:
        return get<std::int32_t>();
      case uint32:
        return get<std::uint32_t>();
      case float32:
        return static_cast<double>(get<float>());
      case float64:
        break;
    }
    return get<double>();
  }
  void skip(PlyType type, std::uint64_t count) {
    if (count > max_left(type)) refuse_byte(content_.size(), "the file ends within its rows");
    place_ += size_of(type) * count;
  }
  std::uint64_t max_left(PlyType type) const { return (content_.size() - place_) / size_of(type); }
  /// Says whether nothing follows. Some programs end the file like a text.
  bool at_end() const {
    return content_.find_first_not_of(" \r\n", place_) == std::string_view::npos;
  }
  [[noreturn]] void refuse(const std::string& reason) const { refuse_byte(last_, reason); }

 private:
  template <class Number>
  Number get() const {
    return number_at<Number>(content_, last_, order_);
  }

  std::string_view content_;
  std::endian order_;
  std::size_t place_;
  std::size_t last_;  ///< where the last number begins
};

/// Returns the property of one of these names, or nothing.
std::optional<std::size_t> find_property(const PlyElement& element,
                                         std::initializer_list<std::string_view> names) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    for (const std::string_view name : names) {
      if (element.properties[i].name == name) return i;
    }
  }
  return {};
}

/// A PlyReader reads the elements of a file one after the other.
template <class Rows>
class PlyReader {
 public:
  PlyReader(Rows rows, MeshBuilder& mesh) : rows_(std::move(rows)), mesh_(mesh) {}

  void read(const PlyHeader& header) {
    bool has_vertices = false;
    bool has_faces = false;
    for (const PlyElement& element : header.elements) {
      check_count(element);
      if (element.name == "vertex") {
        if (has_faces)
          rows_.refuse("its faces stand before its vertices; CRT reads vertices first");
        read_vertices(element);
        has_vertices = true;
      } else if (element.name == "face" || element.name == "tristrips") {
        read_faces(element);
        has_faces = true;
      } else {
        skip_rows(element);
      }
    }
    if (!has_vertices) throw RefusedMesh("it has no element 'vertex'");
    if (!has_faces) {
      throw RefusedMesh("it has no element 'face' or 'tristrips', so it has points and no surface");
    }
    if (!rows_.at_end()) rows_.refuse("after this there is more than the header says");
  }

 private:
  /// Refuses what the rest of the file cannot hold. So the header's claims cost nothing.
  void check_count(const PlyElement& element) {
    if (element.count == 0 || element.properties.empty()) return;
    // A row has at least a number for each property. One of 8 bytes stands for the others.
    std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    for (const PlyProperty& property : element.properties)
      most = std::min(most, rows_.max_left(property.count_type.value_or(property.type)));
    if (element.count > most) {
      rows_.refuse(
          text::format("the header says that there are {} rows of {}, and the file has "
                       "room for {} at most",
                       element.count, in_quotes(element.name), most));
    }
  }

  void skip_property(const PlyProperty& property) {
    if (property.count_type) {
      rows_.skip(property.type, read_count(property));
    } else {
      rows_.skip(property.type, 1);
    }
  }

  void skip_rows(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (const PlyProperty& property : element.properties) skip_property(property);
    }
  }

  std::uint64_t read_count(const PlyProperty& property) {
    const double count = rows_.next(*property.count_type);
    if (!(count >= 0) || count != std::floor(count))
      rows_.refuse(text::format("a list of {} numbers: it should be a whole number from 0", count));
    const std::uint64_t most = rows_.max_left(property.type);
    if (count > static_cast<double>(most)) {
      rows_.refuse(
          text::format("a list of {} numbers, and the file has room for {} at most", count, most));
    }
    return static_cast<std::uint64_t>(count);
  }

  /// A VertexPlaces says which properties of vertices are read: x, y, z, the normal, u and v.
  using VertexPlaces = std::array<std::optional<std::size_t>, 8>;
  static constexpr std::size_t first_of_normal = 3;
  static constexpr std::size_t first_of_uv = 6;

  VertexPlaces vertex_places(const PlyElement& element) {
    using Names = std::initializer_list<std::string_view>;
    const std::array<Names, 8> names = {Names{"x"},
                                        Names{"y"},
                                        Names{"z"},
                                        Names{"nx"},
                                        Names{"ny"},
                                        Names{"nz"},
                                        Names{"u", "s", "texture_u"},
                                        Names{"v", "t", "texture_v"}};
    VertexPlaces places;
    for (std::size_t i = 0; i < places.size(); ++i) {
      places[i] = find_property(element, names[i]);
      if (places[i] && element.properties[*places[i]].count_type) places[i].reset();
    }
    for (std::size_t axis = 0; axis < first_of_normal; ++axis) {
      if (!places[axis]) {
        throw RefusedMesh(
            text::format("its vertices have no property {}", in_quotes(*names[axis].begin())));
      }
    }
    const auto has_all = [&](std::size_t begin, std::size_t end) {
      return std::all_of(&places[begin], &places[0] + end, [](auto place) { return !!place; });
    };
    has_normals_ = has_all(first_of_normal, first_of_uv);
    has_uv_ = has_all(first_of_uv, places.size());
    if (!has_normals_)
      std::fill_n(&places[first_of_normal], first_of_uv - first_of_normal, std::nullopt);
    if (!has_uv_) std::fill_n(&places[first_of_uv], places.size() - first_of_uv, std::nullopt);
    return places;
  }

  void read_vertices(const PlyElement& element) {
    const VertexPlaces places = vertex_places(element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
      std::array<double, 8> values{};
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        const auto* const place = std::find(places.begin(), places.end(), i);
        if (place == places.end()) {
          skip_property(element.properties[i]);
          continue;
        }
        const auto slot = static_cast<std::size_t>(place - places.begin());
        values[slot] = slot < first_of_normal ? coordinate(element.properties[i])
                                              : attribute(element.properties[i], slot);
      }
      const auto& [x, y, z, nx, ny, nz, u, v] = values;
      mesh_.add_position({x, y, z});
      if (has_normals_) mesh_.add_normal({nx, ny, nz});
      if (has_uv_) mesh_.add_uv(u, v);
    }
    // There may be more vertices, in another table.
    has_normals_ = mesh_.normal_count() == mesh_.position_count();
    has_uv_ = mesh_.uv_count() == mesh_.position_count();
  }

  double attribute(const PlyProperty& property, std::size_t slot) {
    const double value = rows_.next(property.type);
    const double most = slot < first_of_uv ? largest_normal : largest_uv;
    if (!(std::abs(value) <= most)) {
      rows_.refuse(text::format("{} of a vertex is {}; it should be at most {:g} in magnitude",
                                property.name, value, most));
    }
    return value;
  }

  double coordinate(const PlyProperty& property) {
    const double value = rows_.next(property.type);
    if (const char* const fault = coordinate_fault(value))
      rows_.refuse(text::format("the coordinate {} of a vertex {}", property.name, fault));
    return value;
  }

  void read_faces(const PlyElement& element) {
    const std::optional<std::size_t> place =
        find_property(element, {"vertex_indices", "vertex_index"});
    if (!place || !element.properties[*place].count_type) {
      throw RefusedMesh(text::format("its {} have no list 'vertex_indices'",
                                     element.name == "face" ? "faces" : "triangle strips"));
    }
    for (std::uint64_t row = 0; row < element.count; ++row) {
      for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (i == *place && element.name == "face") {
          read_face(element.properties[i]);
        } else if (i == *place) {
          read_strips(element.properties[i]);
        } else {
          skip_property(element.properties[i]);
        }
      }
    }
  }

  void read_face(const PlyProperty& property) {
    const std::uint64_t count = read_count(property);
    if (count < 3)
      rows_.refuse(text::format("a face needs at least three corners, and here are {}", count));
    corners_.clear();
    for (std::uint64_t i = 0; i < count; ++i)
      corners_.push_back(to_vertex(rows_.next(property.type)));
    add_face(corners_);
  }

  /// Reads triangle strips, between which the list has -1. In a strip each vertex makes a triangle
  /// with the two before it, and every second triangle is turned round.
  void read_strips(const PlyProperty& property) {
    const std::uint64_t count = read_count(property);
    std::array<std::uint32_t, 3> last{};
    std::uint64_t length = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const double index = rows_.next(property.type);
      if (index == -1) {
        length = 0;
        continue;
      }
      last = {last[1], last[2], to_vertex(index)};
      ++length;
      if (length < 3) continue;
      const auto [a, b, c] = last;
      add_face(length % 2 != 0 ? std::array{a, b, c} : std::array{b, a, c});
    }
  }

  std::uint32_t to_vertex(double index) const {
    if (!(index >= 0 && index < static_cast<double>(mesh_.position_count())) ||
        index != std::floor(index)) {
      rows_.refuse(
          text::format("a corner is vertex {}; it should be a whole number from 0, less "
                       "than {}",
                       index, mesh_.position_count()));
    }
    return static_cast<std::uint32_t>(index);
  }

  void add_face(std::span<const std::uint32_t> corners) {
    FaceCorners face{.positions = corners};
    if (has_normals_) face.normals = corners;
    if (has_uv_) face.uv = corners;
    mesh_.add_face(face);
  }

  Rows rows_;
  MeshBuilder& mesh_;
  std::vector<std::uint32_t> corners_;
  bool has_normals_ = false;
  bool has_uv_ = false;
};

}  // namespace

void read_ply(std::string_view content, MeshBuilder& mesh) {
  const PlyHeader header = read_ply_header(content);
  if (header.binary) {
    PlyReader(BinaryRows(content, header), mesh).read(header);
  } else {
    PlyReader(TextRows(content, header), mesh).read(header);
  }
}

}  // namespace crt::core
