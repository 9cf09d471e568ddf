// The fuzzer plans jobs, and asks about some.
#pragma once

#include <crt/crt.h>

#include <cstdint>
#include <string>

#include "fuzz_input.hpp"

namespace crt::test {

/// Plans jobs where no folder can be, and asks about jobs that are not there.
inline crt_status ask_farm(Input& input, crt_image** out) {
  auto script = scrambled<crt_script_options>(input, crt_script_options_init);
  auto render = scrambled<crt_render_options>(input, crt_render_options_init);
  auto options = scrambled<crt_farm_options>(input, crt_farm_options_init);
  options.has_frames = static_cast<std::int32_t>(input.below(2));
  options.first_frame = input.raw<std::int32_t>();
  options.last_frame = input.raw<std::int32_t>();
  options.tasks = input.raw<std::int32_t>();
  options.tile_width = static_cast<std::int32_t>(input.below(3)) - 1;
  options.tile_height = static_cast<std::int32_t>(input.below(3)) - 1;
  options.least_seconds = input.number();
  render.aovs = input.below(255);
  render.passes = input.raw<std::int32_t>();
  script.t = input.number();
  script.compat = input.raw<std::int16_t>();
  if (input.below(2) == 0) options.script = &script;
  if (input.below(2) == 0) options.render = &render;
  crt_farm_job planned;
  planned.struct_size = input.raw<std::uint16_t>() % (sizeof planned + 1);
  require(crt_farm_plan("fuzz.crt", "/dev/null/job", &options, &planned) != CRT_OK);
  const std::string job = "/dev/null/" + input.text();
  require(crt_farm_read_plan(job.c_str(), &planned) != CRT_OK);
  require(crt_farm_work(job.c_str(), input.raw<std::int32_t>(), nullptr, nullptr) != CRT_OK);
  auto merge = scrambled<crt_farm_merge_options>(input, crt_farm_merge_options_init);
  const std::string output = input.text();
  const std::int32_t skip[] = {1, -1, 1};
  merge.output = output.c_str();
  merge.skip = skip;
  merge.skip_count = input.below(4);
  require(crt_farm_merge(job.c_str(), &merge, nullptr) != CRT_OK);
  crt_farm_progress progress;
  progress.struct_size = input.raw<std::uint16_t>() % (sizeof progress + 1);
  require(crt_farm_status(job.c_str(), &progress) != CRT_OK);
  std::size_t count = 0;
  require(crt_farm_tasks(job.c_str(), nullptr, 0, &count) != CRT_OK);
  return crt_farm_sheet(job.c_str(), input.raw<std::int32_t>(), out);
}

}  // namespace crt::test
