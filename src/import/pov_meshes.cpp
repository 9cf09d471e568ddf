// Meshes and triangles of POV-Ray become polyhedra, or triangles if they are open.
#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <utility>

#include "import/pov_scene.hpp"

namespace crt::importing {

namespace {

/// Makes a solid of triangles if each edge belongs to two of them, and else surfaces.
SharedSolid of_triangles(const std::vector<std::array<Vec3, 3>>& triangles) {
  Faces faces;
  std::map<std::tuple<double, double, double>, std::uint32_t> places;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const std::array<Vec3, 3>& triangle : triangles) {
    std::vector<std::uint32_t> face;
    for (const Vec3& p : triangle) {
      const auto [place, is_new] = places.try_emplace(
          std::tuple(p.x, p.y, p.z), static_cast<std::uint32_t>(faces.points.size()));
      if (is_new) faces.points.push_back(p);
      face.push_back(place->second);
    }
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
    for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(face[i], face[(i + 1) % 3])];
    faces.faces.push_back(std::move(face));
  }
  const bool is_closed = std::all_of(edges.begin(), edges.end(),
                                     [](const auto& edge) { return edge.second % 2 == 0; });
  if (is_closed && !edges.empty()) return make_polyhedron(faces);
  std::vector<SharedSolid> parts;
  for (const std::vector<std::uint32_t>& face : faces.faces) {
    parts.push_back(make_object(
        "Triangle", {attribute("a", faces.points[face[0]]), attribute("b", faces.points[face[1]]),
                     attribute("c", faces.points[face[2]])}));
  }
  return make_sum(std::move(parts));
}

}  // namespace

std::array<Vec3, 3> PovScene::corners(bool is_smooth) {
  std::array<Vec3, 3> corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) comma();
    corners[i] = vec3();
    if (!is_smooth) continue;
    comma();
    vec3();
  }
  return corners;
}

SharedSolid PovScene::triangle(bool is_smooth) {
  return of_triangles({corners(is_smooth)});
}

SharedSolid PovScene::mesh() {
  std::vector<std::array<Vec3, 3>> triangles;
  while (peek().is_word("triangle") || peek().is_word("smooth_triangle")) {
    const bool is_smooth = take().text == "smooth_triangle";
    expect("{", "behind 'triangle'");
    triangles.push_back(corners(is_smooth));
    PovObject ignored;
    modifiers(ignored, {});
  }
  return of_triangles(triangles);
}

SharedSolid PovScene::mesh2(const Place& at) {
  std::vector<Vec3> points;
  std::vector<std::array<Vec3, 3>> triangles;
  for (;;) {
    if (peek().is_word("vertex_vectors")) {
      take();
      expect("{", "behind 'vertex_vectors'");
      for (double left = float_expression(); left >= 1; --left) {
        comma();
        points.push_back(vec3());
      }
      comma();
      expect("}", "behind the vectors");
    } else if (peek().is_word("face_indices")) {
      take();
      expect("{", "behind 'face_indices'");
      for (double left = float_expression(); left >= 1; --left) {
        comma();
        const Vec3 face = vec3();
        std::array<Vec3, 3> corners{};
        for (int i = 0; i < 3; ++i) {
          if (!(face[i] >= 0) || face[i] >= static_cast<double>(points.size()))
            throw Failure(at, "a face of this mesh has a corner that is none of its vectors");
          corners[static_cast<std::size_t>(i)] = points[static_cast<std::size_t>(face[i])];
        }
        triangles.push_back(corners);
        // A face may have textures behind it.
        while (take_sign(",") && !peek().is_sign("<") && !peek().is_sign("}")) float_expression();
      }
      expect("}", "behind the faces");
    } else if (peek().is_word("normal_vectors") || peek().is_word("normal_indices") ||
               peek().is_word("uv_vectors") || peek().is_word("uv_indices") ||
               peek().is_word("texture_list")) {
      take();
      skip_braces();
    } else {
      return of_triangles(triangles);
    }
  }
}

}  // namespace crt::importing
