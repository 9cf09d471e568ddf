// The options of `crt render` and `crt watch`.
#include <fmt/format.h>

#include <string_view>

#include "cli/option_table.hpp"
#include "cli/option_values.hpp"

namespace crt::cli {

namespace {

constexpr std::string_view render_footer =
    R"(The ending of the picture's name says its format: .png, .tif, .jpg and others (8 bits, with
exposure, tone map and gamma), .exr and .hdr (linear light). Nothing is left behind under its name
unless it is whole. A link is followed, and what is a device or a pipe is written to as it is.
With .gif, .webp and .mp4 it is a film of all frames, which the program ffmpeg makes: of --frames,
or of those that the script's Settings have.
An .exr file also holds what --aov asks for: depth (channel Z), normal (N.X, N.Y, N.Z), id, albedo,
and of each pixel how many samples it has (samples) and how far it may be from the truth (error).
As a script, - is standard input. As the picture, it is standard output, which gets PNG, or EXR with
--aov; what the script prints then goes to standard error.

Examples:
  crt render scene.crt -o draft.png --width 320 --height 240
  crt render scene.crt -o corner.png --region 0,0,64,64     only that part of the picture
  crt render a.crt b.crt -o pictures                        pictures/a.png and pictures/b.png
  crt render - -o - <scene.crt | chafa                      between programs: shown in a terminal
  crt render film.crt --frames 1-48                         film_0001.png to film_0048.png
  crt render film.crt --frames 1-48 -o film.gif --fps 12    one film of four seconds
  crt render film.crt --film                                film.mp4, as long as the script says
  crt render scene.crt -o scene.exr --aov depth,id          distances and objects beside the colours
  crt render scene.crt --stats -                            what it took, as JSON)";

constexpr std::string_view watch_footer =
    R"(Renders the script, and again whenever it changes or anything that it imports or reads. First
comes a draft with an eighth of the pixels across and down, then the picture: in progress, if it
takes seconds, and whole. The file is replaced at once, so that a viewer that follows it never sees
a part of it. Errors of the script are reported, and the picture stays until they are mended. Ctrl-C
ends it, with code 0.

Examples:
  crt watch scene.crt                       keeps scene.png up to date
  crt watch scene.crt -o /tmp/scene.png --width 640 --height 480)";

void add_limits(std::vector<OptionRow>& rows, PictureRequest& request) {
  rows.push_back(
      {.names = "--max-ray-steps",
       .type = "N",
       .help = "things that one ray may be tested against before the render ends with an error "
               "(4194304)",
       .take = [&request](const std::string& value) {
         if (!parse_whole(value, request.render.max_ray_steps))
           throw WrongValue("--max-ray-steps", "a whole number, 0 for the usual bound", value);
       }});
  rows.push_back(
      {.names = "--max-primitives",
       .type = "N",
       .help = "primitives that the scene may have before it ends with an error (what memory is "
               "enough for)",
       .take = [&request](const std::string& value) {
         if (!parse_whole(value, request.max_primitives)) {
           throw WrongValue("--max-primitives", "a whole number, 0 for what memory is enough for",
                            value);
         }
       }});
}

void add_output(std::vector<OptionRow>& rows, PictureRequest& request, const char* help) {
  rows.push_back(
      {.names = "-o,--output", .type = "FILE", .help = help, .take = into_path(request.output)});
}

void add_reproducible(std::vector<OptionRow>& rows, PictureRequest& request) {
  rows.push_back(
      {.names = "--reproducible",
       .type = "",
       .help = "leaves the render time out of the picture's file: same picture, same bytes",
       .take = into_flag("--reproducible", request.reproducible)});
}

void add_frames(std::vector<OptionRow>& rows, RenderRequest& request) {
  rows.push_back(
      {.names = "--frames",
       .type = "A-B",
       .help = "renders a picture for each whole t in the range; ### in the output's name is the "
               "number",
       .take = [&request](const std::string& text) { request.frames = parse_frames(text); },
       .excludes = "--time"});
  rows.push_back({.names = "--film",
                  .type = "",
                  .help = "renders the frames that the script's Settings have, to a film: without "
                          "-o to an .mp4 beside the script",
                  .take = into_flag("--film", request.film),
                  .excludes = "--time"});
  rows.push_back(
      {.names = "--fps",
       .type = "NUMBER",
       .help = fmt::format("frames a second of a film ({:.0f})", request.frames_per_second),
       .take = into_positive("--fps", request.frames_per_second)});
  rows.push_back({.names = "--keep-frames",
                  .type = "FOLDER",
                  .help = "also writes the frames of a film as PNG files into this folder",
                  .take = into_path(request.keep_frames)});
}

void add_passes(std::vector<OptionRow>& rows, RenderRequest& request) {
  rows.push_back(
      {.names = "--passes",
       .type = "N",
       .help = "stops after so many passes: with the number that --stats gave, the same picture "
               "again",
       .take = [&request](const std::string& value) {
         if (!parse_whole(value, request.render.passes) || request.render.passes < 0) {
           throw WrongValue("--passes", "a whole number, 0 for as many as it takes", value);
         }
       }});
  rows.push_back(
      {.names = "--checkpoint",
       .type = "FILE",
       .help = "with --targeterror, --timebudget or --passes: keeps what is done there, also when "
               "interrupted, and continues from it if it is there",
       .take = into_path(request.render.checkpoint),
       .excludes = "--frames"});
}

}  // namespace

CommandTable render_table(RenderRequest& request) {
  CommandTable table{.name = "render",
                     .about = "Renders scripts to pictures.",
                     .footer = std::string(render_footer),
                     .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  add_scenes_row(rows, request.scenes, "the scripts; - is standard input");
  add_output(rows, request,
             "the picture (default: the script's name, ending in .png, with --aov in .exr); a "
             "folder for those of several scripts; - for standard output");
  add_script_rows(rows, request);
  add_frames(rows, request);
  add_region_row(rows, request.render.region, "renders only this part, as a picture of its size");
  rows.push_back(
      {.names = "--section",
       .type = "PLANE",
       .help = "cuts solids open by x=, y= or z= a number, or by NX,NY,NZ=OFFSET, and hatches cuts",
       .take = [&request](const std::string& text) { request.section = parse_plane(text); }});
  add_threads_row(rows, request.render.threads);
  add_passes(rows, request);
  add_limits(rows, request);
  rows.push_back(
      {.names = "--aov",
       .type = "LIST",
       .help = fmt::format("channels beside the colours, for an .exr file: some of {}",
                           all_aov_names()),
       .take = [&request](const std::string& list) { take_aovs(list, request.render.aovs); },
       .repeatable = true});
  rows.push_back({.names = "--stats",
                  .type = "FILE",
                  .help = "writes what the rendering did as JSON; '-' is standard output",
                  .take = [&request](const std::string& name) { request.stats = name; }});
  add_reproducible(rows, request);
  add_setting_rows(rows, request.script);
  return table;
}

CommandTable watch_table(WatchRequest& request) {
  CommandTable table{.name = "watch",
                     .about = "Renders a script again whenever it or what it reads changes.",
                     .footer = std::string(watch_footer),
                     .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  add_scene_row(rows, request.scene, "the script");
  add_output(rows, request, "the picture (default: the script's name, ending in .png)");
  add_script_rows(rows, request);
  add_threads_row(rows, request.render.threads);
  add_limits(rows, request);
  add_reproducible(rows, request);
  add_setting_rows(rows, request.script);
  return table;
}

}  // namespace crt::cli
