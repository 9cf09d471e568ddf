#include "import/solid.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "text/format.hpp"

namespace crt::importing {

namespace {

SharedSolid combine(Solid::Kind kind, std::vector<SharedSolid> parts) {
  if (parts.empty()) return nullptr;
  if (parts.size() == 1) return std::move(parts.front());
  return std::make_shared<Solid>(Solid{.kind = kind, .parts = std::move(parts)});
}

void leave_out_empty(std::vector<SharedSolid>& parts) {
  parts.erase(std::remove(parts.begin(), parts.end(), nullptr), parts.end());
}

}  // namespace

SharedSolid make_object(std::string_view type, std::vector<std::string> attributes) {
  return std::make_shared<Solid>(Solid{.type = std::string(type), .texts = std::move(attributes)});
}

SharedSolid make_sum(std::vector<SharedSolid> parts) {
  leave_out_empty(parts);
  return combine(Solid::Kind::sum, std::move(parts));
}

SharedSolid make_difference(std::vector<SharedSolid> parts) {
  if (parts.empty() || !parts.front()) return nullptr;
  leave_out_empty(parts);
  return combine(Solid::Kind::difference, std::move(parts));
}

SharedSolid make_intersection(std::vector<SharedSolid> parts) {
  if (std::find(parts.begin(), parts.end(), nullptr) != parts.end()) return nullptr;
  return combine(Solid::Kind::intersection, std::move(parts));
}

SharedSolid make_changed(SharedSolid solid, const std::vector<std::string>& modifiers) {
  if (!solid || modifiers.empty()) return solid;
  Solid changed{.kind = Solid::Kind::changed};
  if (solid->kind == Solid::Kind::changed && solid->name.empty()) {
    changed.texts = solid->texts;
    changed.parts = solid->parts;
  } else {
    changed.parts.push_back(std::move(solid));
  }
  changed.texts.insert(changed.texts.end(), modifiers.begin(), modifiers.end());
  return std::make_shared<Solid>(std::move(changed));
}

SharedSolid make_named(const SharedSolid& solid, const std::string& name) {
  if (!solid || name.empty() || !solid->name.empty()) return solid;
  Solid named = *solid;
  named.name = name;
  return std::make_shared<Solid>(std::move(named));
}

std::string number_text(double number) {
  return text::format("{}", number == 0 ? 0.0 : number);
}

std::string vector_text(const Vec3& v) {
  return text::format("vec3({}, {}, {})", number_text(v.x), number_text(v.y), number_text(v.z));
}

std::string attribute(std::string_view name, std::string_view value) {
  return text::format("{} -> {}", name, value);
}

std::string attribute(std::string_view name, double value) {
  return attribute(name, std::string_view(number_text(value)));
}

std::string attribute(std::string_view name, const Vec3& value) {
  return attribute(name, std::string_view(vector_text(value)));
}

std::string list_text(const std::vector<std::string>& items) {
  std::string result = "[";
  for (const std::string& item : items) result += (result.size() > 1 ? ", " : "") + item;
  return result + "]";
}

std::string quoted_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (static_cast<unsigned char>(c) < ' ') {
      result += text::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

SharedSolid make_polyhedron(const Faces& faces) {
  if (faces.faces.empty()) return nullptr;
  std::vector<std::string> points;
  points.reserve(faces.points.size());
  for (const Vec3& point : faces.points) points.push_back(vector_text(point));
  std::vector<std::string> sides;
  sides.reserve(faces.faces.size());
  for (const std::vector<std::uint32_t>& face : faces.faces) {
    std::vector<std::string> corners;
    corners.reserve(face.size());
    for (const std::uint32_t corner : face) corners.push_back(text::format("{}", corner));
    sides.push_back(list_text(corners));
  }
  return make_object(
      "Polyhedron", {attribute("points", list_text(points)), attribute("faces", list_text(sides))});
}

}  // namespace crt::importing
