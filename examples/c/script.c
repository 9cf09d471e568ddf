// Runs a script, with variables set from outside, and renders it to script.png:
//
//   script [FILE [NAME=EXPRESSION]...]
//
// Without a file it runs the text below with more petals than that has. What the script prints goes
// to standard output. What is wrong with it goes to standard error, with places, and the program
// ends with 1.
#include <crt/crt.h>
#include <stdio.h>
#include <string.h>

static const char flower[] =
    "petals = 5\n"
    "gold = Material { color -> rgb(0.8, 0.5, 0.1) specular -> 0.5 shininess -> 30 }\n"
    "pink = Material { color -> rgb(0.8, 0.15, 0.3) specular -> 0.3 shininess -> 20 }\n"
    "petal = Sphere { center -> vec3(0, 0, 0) radius -> 1 material -> pink }\n"
    "print(\"A flower of\", petals, \"petals\")\n"
    "Settings {\n"
    "  width -> 320 height -> 320 supersampling -> 2\n"
    "  camera -> Camera { position -> vec3(0, 3.4, -3.4) pointing -> vec3(0, 0, 0) fov -> 42 }\n"
    "  lights -> [PointLight { origin -> vec3(-3, 6, -3) color -> rgb(1, 1, 1) ambient -> 0.1 }]\n"
    "  background -> Background { color -> rgb(0.05, 0.2, 0.08) }\n"
    "}\n"
    "Scene {\n"
    "  Sphere { center -> vec3(0, 0.1, 0) radius -> 0.4 material -> gold }\n"
    "  for (i in range(petals)) {\n"
    "    petal <scale vec3(0.6, 0.12, 2.6 / petals), rotate vec3(0, 0, 15),\n"
    "           translate vec3(0.9, 0, 0), rotate vec3(0, 360.0 * i / petals, 0)>\n"
    "  }\n"
    "}\n";

enum { most_variables = 16 };

static int print_line(const char* line, size_t length, void* user) {
  (void)user;
  printf("%.*s\n", (int)length, line);
  return 0;  // anything else would stop the script
}

// Splits each NAME=EXPRESSION at its first '='.
static int take_variables(char** arguments, int count, const char** names,
                          const char** expressions) {
  if (count > most_variables) return fprintf(stderr, "script: too many variables\n");
  for (int i = 0; i < count; ++i) {
    char* equals = strchr(arguments[i], '=');
    if (equals == NULL) return fprintf(stderr, "script: %s is not NAME=EXPRESSION\n", arguments[i]);
    *equals = 0;
    names[i] = arguments[i];
    expressions[i] = equals + 1;
  }
  return 0;
}

// Prints the diagnostics. crt_diagnostics_text() would give all of this in one piece.
static void tell(const crt_diagnostics* diagnostics) {
  for (size_t i = 0; i < crt_diagnostics_count(diagnostics); ++i) {
    crt_diagnostic d;
    d.struct_size = sizeof d;
    if (crt_diagnostics_get(diagnostics, i, &d)) continue;
    fprintf(stderr, "%s: ", d.file);
    if (d.line > 0) fprintf(stderr, "line %d, column %d: ", (int)d.line, (int)d.column);
    fprintf(stderr, "%s: %s\n", d.severity == CRT_SEVERITY_ERROR ? "error" : "warning", d.message);
    if (d.line > 0) fprintf(stderr, "    %s\n    %*s^\n", d.source_line, (int)d.column - 1, "");
  }
}

// Runs the script in `path`, or the flower if that is NULL.
static int run(const char* path, const crt_script_options* options, crt_scene** out) {
  crt_diagnostics* diagnostics = NULL;
  const int failed =
      path ? crt_scene_from_script_file(path, options, &diagnostics, out)
           : crt_scene_from_script(flower, strlen(flower), "flower", options, &diagnostics, out);
  tell(diagnostics);
  if (failed && diagnostics == NULL) fprintf(stderr, "script: %s\n", crt_error_message());
  crt_diagnostics_release(diagnostics);
  return failed;
}

static int render(crt_scene* scene, const char* picture) {
  crt_prepared* prepared = NULL;
  crt_image* image = NULL;
  const int failed = crt_scene_prepare(scene, &prepared) || crt_render(prepared, NULL, &image) ||
                     crt_image_write(image, picture);
  if (failed) fprintf(stderr, "script: %s\n", crt_error_message());
  crt_image_release(image);
  crt_prepared_release(prepared);
  return failed;
}

int main(int argc, char** argv) {
  const char *names[most_variables] = {"petals"}, *expressions[most_variables] = {"4 + 4"};
  const char* path = argc > 1 ? argv[1] : NULL;
  crt_script_options options;
  crt_scene* scene = NULL;

  if (crt_script_options_init(&options, sizeof options)) return 1;
  if (path && take_variables(argv + 2, argc - 2, names, expressions)) return 2;
  options.variable_names = names;
  options.variable_values = expressions;
  options.variable_count = path ? (uint64_t)argc - 2 : 1;
  options.print = print_line;

  const int failed = run(path, &options, &scene) || render(scene, "script.png");
  crt_scene_release(scene);
  return failed;
}
