// This fuzzes the readers of manifests and parts of jobs. The first byte of an input says which. A
// manifest is the rest. A part is a whole one in which the rest changes bytes, cuts or appends,
// with a hash that fits.
#include <unistd.h>

#include <crt/error.hpp>
#include <crt/farm.hpp>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/base/state_file.hpp"
#include "core/base/whole_file.hpp"
#include "crt/file.hpp"
#include "farm/assembly.hpp"
#include "farm/part.hpp"

namespace {

using namespace crt;
namespace fs = std::filesystem;

/// A FuzzedJob is a job with one part.
struct FuzzedJob {
  fs::path folder = fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
  farm::Job job;
  std::vector<std::byte> part;

  FuzzedJob() {
    folder /= "crt-fuzz-farm-" + std::to_string(getpid());
    fs::remove_all(folder);
    fs::create_directories(folder);
    write_file(folder / "scene.crt",
               "Settings { width -> 6 height -> 4 targeterror -> 0.1 minsamples -> 4 maxsamples -> "
               "4 }\nScene { Sphere { center -> vec3(0, 0, 0) radius -> 1 } }\n");
    FarmOptions options{.tasks = 1};
    options.render.aovs = {.depth = true, .id = true};
    plan_farm(folder / "scene.crt", folder / "job", options);
    work_farm(folder / "job", 0);
    job = farm::open_job(folder / "job");
    part = core::read_whole_file(job.part_file(0), std::size_t{1} << 20);
    part.resize(part.size() - sizeof(std::uint64_t));  // the hash
  }
  ~FuzzedJob() { fs::remove_all(folder); }
};

void read_manifest(std::string_view text) {
  try {
    const farm::Manifest manifest = farm::parse_manifest(text);
    if (farm::to_text(farm::parse_manifest(farm::to_text(manifest))) != farm::to_text(manifest))
      std::abort();
  } catch (const Error& error) {
    if (error.code() == ErrorCode::internal) std::abort();
  }
}

void read_part(const FuzzedJob& fuzzed, std::span<const std::uint8_t> changes) {
  std::vector<std::byte> part = fuzzed.part;
  for (; changes.size() >= 3; changes = changes.subspan(3)) {
    const std::size_t at = (std::size_t{changes[0]} << 8 | changes[1]) % (part.size() + 2);
    if (at < part.size()) {
      part[at] = std::byte{changes[2]};
    } else if (at == part.size()) {
      part.push_back(std::byte{changes[2]});
    } else {
      part.resize(part.size() - std::min<std::size_t>(part.size() - 1, changes[2]));
    }
  }
  core::write_state_file(fuzzed.job.part_file(0), [&](core::StateWriter& out) {
    out.put_all(std::span<const std::byte>(part));
  });
  try {
    farm::Assembly assembly(fuzzed.job.manifest);
    for (const farm::RenderedPiece& piece : farm::read_part(fuzzed.job, 0)) assembly.add(piece);
    if (assembly.is_complete()) assembly.finish().encode("png");
  } catch (const Error& error) {
    if (error.code() == ErrorCode::internal) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const FuzzedJob fuzzed;
  if (size == 0) return 0;
  if (data[0] % 2 == 0) {
    read_manifest({reinterpret_cast<const char*>(data) + 1, size - 1});
  } else {
    read_part(fuzzed, {data + 1, size - 1});
  }
  return 0;
}
