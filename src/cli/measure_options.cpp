// The options of `crt measure` and `crt ask`.
#include <fmt/format.h>

#include "cli/option_table.hpp"
#include "cli/option_values.hpp"

namespace crt::cli {

namespace {

void add_section_rows(std::vector<OptionRow>& rows, MeasureRequest& request) {
  rows.push_back(
      {.names = "--section",
       .type = "PLANE",
       .help = "the section by x=, y= or z= a number, or by NX,NY,NZ=OFFSET",
       .take = [&request](const std::string& text) { request.section = parse_plane(text); }});
  rows.push_back({.names = "--deviation",
                  .type = "D",
                  .help = "how far the section's contours may be off (1e-4 of the size)",
                  .take = into_positive("--deviation", request.deviation)});
  rows.push_back({.names = "-o,--output",
                  .type = "FILE",
                  .help = "writes the section as .svg or .dxf, in the unit of the scene",
                  .take = into_path(request.output)});
  rows.push_back({.names = "--hatch",
                  .type = "D",
                  .help = "hatches what is written, with lines this far apart",
                  .take = into_positive("--hatch", request.hatch)});
}

}  // namespace

CommandTable measure_table(MeasureRequest& request) {
  CommandTable table{
      .name = "measure",
      .about = "Says how much the entities of a script are, and where.",
      .footer = R"(Numbers are printed with as many digits as are sure, and with bounds that
surely hold the truth. They are in the unit of the script's Settings, metres by default. Of what is
no solid, or has no end, it says why it has no volume. Without any of --volume, --area, --bounds,
--mass, --thickness, --section, --distance and --interference it says volume, area, bounds and
centroid of each entity. docs/measure.md has more.

Examples:
  crt measure part.crt                            bounds, volume, area, centroid
  crt measure part.crt --unit mm --mass --density 7.85e-6
                                                  mass, centroid and inertia, here in kg and mm
  crt measure assembly.crt --mass                 in kg, by the densities of materials
  crt measure part.crt --volume --relative-width 1e-9 --json
  crt measure part.crt --section y=6 -o part.dxf  the area of a section, and its drawing
  crt measure part.crt --distance 0,1             how near two entities are, and where)",
      .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  add_scene_row(rows, request.scene, "the script; - is standard input");
  const auto add_flag = [&rows](const std::string& name, bool& flag, const std::string& help) {
    rows.push_back({.names = name, .type = "", .help = help, .take = into_flag(name, flag)});
  };
  add_flag("--volume", request.volume, "the volume; parts of an entity that overlap count once");
  add_flag("--area", request.area, "the area of the surface");
  add_flag("--bounds", request.bounds, "the box around it");
  add_flag("--mass", request.mass, "volume, mass, centroid, and the inertia about that");
  add_flag("--thickness", request.thickness, "how thin the thinnest wall is, and where");
  rows.push_back({.names = "--density",
                  .type = "D",
                  .help = "the mass of a cubed scene unit (1) of what has a material without a "
                          "density, and asks for --mass",
                  .take = [&request](const std::string& text) {
                    request.density = parse_positive("--density", text);
                    request.mass = true;
                  }});
  rows.push_back(
      {.names = "--distance",
       .type = "A,B",
       .help = "how near two entities are, by their numbers; can be given repeatedly",
       .take =
           [&request](const std::string& text) {
             const std::size_t comma = text.find(',');
             if (comma == std::string::npos || text.find(',', comma + 1) != std::string::npos)
               throw WrongValue("--distance", "two entities, such as 0,1", text);
             request.distances.emplace_back(text.substr(0, comma), text.substr(comma + 1));
           },
       .repeatable = true});
  add_flag("--interference", request.interference, "which entities overlap, and by how much");
  add_section_rows(rows, request);
  rows.push_back({.names = "--relative-width",
                  .type = "W",
                  .help = fmt::format("how wide bounds on a number may be, for its size ({})",
                                      request.relative_width),
                  .take = [&request](const std::string& text) {
                    if (!parse_finite(text, request.relative_width) ||
                        !(request.relative_width > 0 && request.relative_width <= 1))
                      throw WrongValue("--relative-width", "a number above 0, at most 1", text);
                    request.wall_width = request.relative_width;
                  }});
  rows.push_back({.names = "--seconds",
                  .type = "SECONDS",
                  .help = "each number has the bounds that are known by then",
                  .take = into_positive("--seconds", request.seconds)});
  add_flag("--json", request.json, "prints JSON: numbers as [lower, upper]");
  add_threads_row(rows, request.threads);
  add_script_rows(rows, request);
  add_setting_rows(rows, request.script);
  return table;
}

CommandTable ask_table(AskRequest& request) {
  CommandTable table{
      .name = "ask",
      .about = "Says what rays meet, or in what points are.",
      .footer = R"(Standard input has a ray a line, ox,oy,oz,dx,dy,dz: its origin and its
direction. For --contains it has a point a line, x,y,z. A first line of names is skipped, and so are
empty lines. Standard output gets a line of names, and then
  --intersect  a line for each ray: t (inf if it meets nothing), place, normal, u, v, the entity's
               id, the part's, the face, and enter or leave
  --crossings  a line for each crossing, with the ray's number from 0 on before that
  --contains   a line for each point: 1 if it is in a solid, the entity's id and the part's; else 0

Examples:
  crt ask scene.crt <rays.csv >hits.csv
  echo 0,0,-5,0,0,1 | crt ask scene.crt --crossings)",
      .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  add_scene_row(rows, request.scene, "the script");
  const auto add_question = [&](const std::string& name, Question question,
                                const std::string& help) {
    rows.push_back({.names = name,
                    .type = "",
                    .help = help,
                    .take = [&request, name, question](const std::string& text) {
                      bool is_asked = false;
                      into_flag(name, is_asked)(text);
                      if (!is_asked) return;
                      if (request.question && *request.question != question)
                        throw WrongValue(name, "to be the only question", "another one beside it");
                      request.question = question;
                    }});
  };
  add_question("--intersect", Question::intersect, "the nearest hit of each ray (default)");
  add_question("--crossings", Question::crossings, "all crossings of each ray");
  add_question("--contains", Question::contains, "in what points are");
  add_threads_row(rows, request.threads);
  add_script_rows(rows, request);
  add_setting_rows(rows, request.script);
  return table;
}

}  // namespace crt::cli
