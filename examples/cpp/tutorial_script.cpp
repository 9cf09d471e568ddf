// The fourth program of the tutorial for C++: it runs a script with other values for two of its
// variables and a setting, and renders what came out: `tutorial_script SCRIPT.crt`, script.png.
#include <crt/crt.hpp>
#include <crt/script.hpp>
#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: tutorial_script SCRIPT.crt\n";
    return 2;
  }
  const crt::ScriptOptions options{
      .variables = {{"balls", "9"}, {"holes", "3 + 1"}},
      .settings = {{"width", "240"}, {"height", "160"}, {"supersampling", "2"}},
      .print = [](std::string_view line) { std::cout << line << '\n'; }};
  const crt::ScriptResult result = crt::run_script_file(argv[1], options);
  for (const crt::Diagnostic& diagnostic : result.diagnostics) {
    std::cerr << crt::format_diagnostic(diagnostic);
  }
  if (!result.scene) return 1;
  std::cout << result.scene->entities.size() << " entities\n";
  crt::render(crt::prepare(*result.scene)).write("script.png");
} catch (const crt::Error& error) {
  std::cerr << "tutorial_script: " << error.what() << '\n';
  return 1;
}
