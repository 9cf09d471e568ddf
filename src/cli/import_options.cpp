// The options of `crt import`.
#include <fmt/format.h>

#include <system_error>

#include "cli/option_table.hpp"
#include "cli/option_values.hpp"

namespace crt::cli {

CommandTable import_table(ImportRequest& request) {
  CommandTable table{.name = "import",
                     .about = "Translates a file of another program to a script.",
                     .footer = R"(These are understood, by the ending of the name:
  .csg   the tree that `openscad -o part.csg part.scad` writes
  .scad  a part of OpenSCAD, which has to be installed: `openscad` makes the tree
  .pov   a scene of POV-Ray, of which a good part is understood

OpenSCAD's spheres, cylinders and circles are round in the script. Those of a $fn up to 8 have that
many sides.

What is not understood is listed with its place. If it is a shape there is no script, as one that
lacks a part is worse than none; --partial writes it all the same. What only looks different is a
warning. docs/import.md says what is understood.

Examples:
  crt import part.scad -o part.crt          then: crt render part.crt, crt measure part.crt
  crt import part.csg --facets              to standard output, with the facets of OpenSCAD
  crt import scene.pov --include /usr/share/povray-3.7/include -o scene.crt)",
                     .rows = {}};
  std::vector<OptionRow>& rows = table.rows;
  rows.push_back({.names = "file",
                  .type = "FILE",
                  .help = "the file, .csg, .scad or .pov",
                  .take = into_path(request.file),
                  .required = true});
  rows.push_back({.names = "-o,--output",
                  .type = "FILE",
                  .help = "the script (default: standard output)",
                  .take = into_path(request.output)});
  rows.push_back({.names = "--facets",
                  .type = "",
                  .help = "makes the facets that OpenSCAD makes of what is round",
                  .take = into_flag("--facets", request.facets)});
  rows.push_back({.names = "--partial",
                  .type = "",
                  .help = "writes a script without the shapes that are not understood",
                  .take = into_flag("--partial", request.partial)});
  rows.push_back({.names = "--include",
                  .type = "FOLDER",
                  .help = "a folder where files that a .pov scene includes are found, too "
                          "(repeatable)",
                  .take =
                      [&request](const std::string& folder) {
                        if (std::error_code unreachable;
                            !std::filesystem::is_directory(folder, unreachable))
                          throw WrongValue("--include", "a folder", folder);
                        request.include_folders.emplace_back(folder);
                      },
                  .repeatable = true});
  rows.push_back({.names = "--seconds",
                  .type = "SECONDS",
                  .help = fmt::format("how long openscad may take ({:.0f})", request.seconds),
                  .take = into_positive("--seconds", request.seconds)});
  add_diagnostics_row(rows, request);
  add_quiet_row(rows, request);
  return table;
}

}  // namespace crt::cli
