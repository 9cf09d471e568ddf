#include "lang/mesh_object.hpp"

#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "crt/error.hpp"
#include "crt/mesh.hpp"
#include "lang/object_builder.hpp"
#include "text/format.hpp"

namespace crt::lang {

namespace {

/// A MeshOfFile is an entity whose shape is in a file.
struct MeshOfFile {
  FileName file;
  std::optional<double> smooth;
  std::optional<FillRule> fill;
  double weld = 0;
  double stitch = 0;
  std::optional<SharedMaterial> material;
};

Value finish_mesh(MeshOfFile mesh, const ObjectSite& site) {
  if (mesh.smooth && !(*mesh.smooth >= 0 && *mesh.smooth <= std::numbers::pi))
    throw Error(ErrorCode::invalid_argument, "smooth must be from 0 to 180 degrees", "smooth");
  constexpr double largest = 1e100;
  for (const auto& [name, distance] :
       {std::pair{"weld", mesh.weld}, std::pair{"stitch", mesh.stitch}}) {
    if (!(distance >= 0 && distance <= largest)) {
      throw Error(ErrorCode::invalid_argument, text::format("{} must be from 0 to 1e100", name),
                  name);
    }
  }
  Context& context = site.context;
  context.count_made(site.name_span);
  const auto& [name, directory, span] = mesh.file;
  const MeshWay way{mesh.smooth, mesh.fill, mesh.weld, mesh.stitch};
  const auto entity = context.files.mesh(name, directory, span, way, &context.reporter);
  return mesh.material ? entity->with_material(*mesh.material) : *entity;
}

}  // namespace

ObjectType mesh_object() {
  return object<MeshOfFile>(
      "Mesh",
      {required("file", &MeshOfFile::file),
       degrees("smooth", &MeshOfFile::smooth, "as the file has it",
               "must be from 0 to 180 degrees"),
       attribute("fill", &MeshOfFile::fill, "as the shells are turned"),
       attribute("weld", &MeshOfFile::weld, "0"), attribute("stitch", &MeshOfFile::stitch, "0"),
       attribute("material", &MeshOfFile::material, "as the file has it")},
      finish_mesh);
}

}  // namespace crt::lang
