// Finds mesh files for programs as for scripts.
#include "crt/script.hpp"
#include "lang/files.hpp"

namespace crt {

Entity load_mesh(const std::filesystem::path& path, const ScriptOptions& options,
                 std::optional<double> smooth, const MeshOptions& mesh) {
  lang::Files files(options);
  try {
    return *files.mesh(path.string(), {}, {}, {smooth, mesh.fill, mesh.weld, mesh.stitch}, nullptr);
  } catch (const lang::Failure& failure) {
    throw Error(failure.code, failure.message);
  }
}

}  // namespace crt
