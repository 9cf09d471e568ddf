// The options of `crt farm`.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "cli/option_table.hpp"
#include "cli/option_values.hpp"

namespace crt::cli {

namespace {

constexpr std::string_view farm_footer =
    R"(Splits pictures and films into tasks for many machines that see one folder, or get copies.
The merged pictures are those of `crt render --reproducible`, to the byte.

  crt farm plan scene.crt --frames 1-240 -o job    makes a job: the script, its files, the tasks
  crt farm plan scene.crt --film -o job            the same, with the frames of its Settings
  crt farm work job --task 7                       renders a task, and leaves its part
  crt farm work job                                renders all that have no part, one by one
  crt farm merge job -o film_###.png               puts the pictures together
  crt farm merge job --follow                      the same, as parts come in
  crt farm status job --sheet sheet.png            shows what is done
  crt farm submit job --local                      does all of it with processes on this machine
  crt farm submit job --slurm                      with Slurm, as an array job
  crt farm submit job --parallel --hosts a,b       with GNU parallel, over ssh

A task may run any number of times, anywhere, also twice at once: its part has the same bytes. If a
worker ends early, its task has no part and is done again. docs/farm.md has more.)";

int parse_count(const std::string& option, const std::string& text) {
  int count = 0;
  if (!parse_whole(text, count) || count < 1) throw WrongValue(option, "a number from 1 on", text);
  return count;
}

void parse_tiles(const std::string& text, FarmRequest& request) {
  request.tile_width = request.tile_height = 0;
  if (text == "auto") return;
  const std::size_t times = text.find('x');
  const bool has_two = times != std::string::npos &&
                       parse_whole(std::string_view(text).substr(0, times), request.tile_width) &&
                       parse_whole(std::string_view(text).substr(times + 1), request.tile_height);
  if (!has_two || request.tile_width < 1 || request.tile_height < 1)
    throw WrongValue("--tiles", "auto, or a size such as 256x256", text);
}

void add_plan_rows(std::vector<OptionRow>& rows, FarmRequest& request) {
  rows.push_back(
      {.names = "--frames",
       .type = "A-B",
       .help = "plan: a picture for each whole t in the range",
       .take = [&request](const std::string& text) { request.frames = parse_frames(text); },
       .excludes = "--time"});
  rows.push_back({.names = "--film",
                  .type = "",
                  .help = "plan: the frames that the script's Settings have",
                  .take = into_flag("--film", request.film),
                  .excludes = "--frames"});
  rows.push_back({.names = "--tasks",
                  .type = "N",
                  .help = "plan: so many tasks (default: as many as last a minute each)",
                  .take = [&request](const std::string& text) {
                    request.tasks = parse_count("--tasks", text);
                  }});
  rows.push_back({.names = "--least-seconds",
                  .type = "SECONDS",
                  .help = fmt::format("plan: without --tasks, the least time of a task ({:.0f})",
                                      request.least_seconds),
                  .take = into_positive("--least-seconds", request.least_seconds)});
  rows.push_back(
      {.names = "--tiles",
       .type = "auto|WxH",
       .help = "plan: cuts pictures into tiles of this size, or where that makes tasks equal",
       .take = [&request](const std::string& text) { parse_tiles(text, request); }});
  rows.push_back({.names = "--passes",
                  .type = "N",
                  .help = "plan: stops after so many passes",
                  .take = [&request](const std::string& value) {
                    if (!parse_whole(value, request.render.passes) || request.render.passes < 0)
                      throw WrongValue("--passes", "a whole number, 0 for as many as it takes",
                                       value);
                  }});
  rows.push_back(
      {.names = "--aov",
       .type = "LIST",
       .help = fmt::format("plan: channels beside the colours, for .exr files: some of "
                           "{}",
                           all_aov_names()),
       .take = [&request](const std::string& list) { take_aovs(list, request.render.aovs); },
       .repeatable = true});
}

void add_work_rows(std::vector<OptionRow>& rows, FarmRequest& request) {
  rows.push_back({.names = "--task",
                  .type = "N",
                  .help = "work: only this task, from 0 on",
                  .take = [&request](const std::string& text) {
                    int task = 0;
                    if (!parse_whole(text, task) || task < 0)
                      throw WrongValue("--task", "a whole number from 0 on", text);
                    request.task = task;
                  }});
  rows.push_back({.names = "--follow",
                  .type = "",
                  .help = "merge: waits for parts until all pictures are there",
                  .take = into_flag("--follow", request.follow)});
  rows.push_back({.names = "--sheet",
                  .type = "FILE",
                  .help = "status: writes a picture of all frames, as far as they are there",
                  .take = into_path(request.sheet)});
}

void add_submit_rows(std::vector<OptionRow>& rows, FarmRequest& request) {
  rows.push_back({.names = "--local",
                  .type = "",
                  .help = "submit: to processes on this machine",
                  .take = into_flag("--local", request.local)});
  rows.push_back({.names = "--slurm",
                  .type = "",
                  .help = "submit: to Slurm",
                  .take = into_flag("--slurm", request.slurm)});
  rows.push_back({.names = "--parallel",
                  .type = "",
                  .help = "submit: to GNU parallel",
                  .take = into_flag("--parallel", request.parallel)});
  rows.push_back({.names = "--processes",
                  .type = "N",
                  .help = "submit --local: so many at once (default: one for each core)",
                  .take = [&request](const std::string& text) {
                    request.processes = parse_count("--processes", text);
                  }});
  rows.push_back(
      {.names = "--hosts",
       .type = "LIST",
       .help = "submit --parallel: machines as --sshlogin takes them (default: this one)",
       .take = [&request](const std::string& text) { request.hosts = text; }});
  rows.push_back(
      {.names = "--slurm-option",
       .type = "OPTION",
       .help = "submit --slurm: goes to sbatch, such as --partition=short",
       .take = [&request](const std::string& text) { request.slurm_options.push_back(text); },
       .repeatable = true});
  rows.push_back({.names = "--no-wait",
                  .type = "",
                  .help = "submit --slurm: does not follow the job",
                  .take = into_flag("--no-wait", request.no_wait)});
}

}  // namespace

CommandTable farm_table(FarmRequest& request) {
  CommandTable table{.name = "farm",
                     .about = "Renders on many machines: plan, work, merge, status, submit.",
                     .footer = std::string(farm_footer),
                     .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  constexpr std::array<std::string_view, 5> verbs = {"plan", "work", "merge", "status", "submit"};
  rows.push_back({.names = "verb",
                  .type = "plan|work|merge|status|submit",
                  .help = "what to do",
                  .take =
                      [&request, verbs](const std::string& verb) {
                        if (std::find(verbs.begin(), verbs.end(), verb) == verbs.end())
                          throw WrongValue("crt farm", "plan, work, merge, status or submit", verb);
                        request.verb = verb;
                      },
                  .required = true});
  rows.push_back({.names = "target",
                  .type = "SCENE.crt|JOB",
                  .help = "the script to plan, else the job's folder",
                  .take = into_path(request.target),
                  .required = true});
  rows.push_back({.names = "-o,--output",
                  .type = "FILE",
                  .help = "plan: the job's folder, which is made; merge, submit: the picture, with "
                          "### for a frame's number (default: in the job's folder)",
                  .take = into_path(request.output)});
  const std::size_t first = rows.size();
  add_script_rows(rows, request);
  add_threads_row(rows, request.render.threads);
  add_plan_rows(rows, request);
  add_work_rows(rows, request);
  add_submit_rows(rows, request);
  add_setting_rows(rows, request.script);
  for (std::size_t i = first; i < rows.size(); ++i) {
    // An option that the verb does not take is refused later, so it must be known.
    rows[i].take = [&request, names = rows[i].names,
                    take = std::move(rows[i].take)](const std::string& value) {
      request.given.insert(names);
      take(value);
    };
  }
  return table;
}

}  // namespace crt::cli
