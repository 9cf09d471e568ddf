#include "images/example_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <crt/error.hpp>
#include <fstream>
#include <span>
#include <sstream>

#include "core/base/sha256.hpp"

namespace crt::tests {

namespace {

namespace fs = std::filesystem;

const fs::path source_dir = CRT_SOURCE_DIR;

/// Says whether a setting's value on the command line is text, which a script puts in quotes.
bool is_text_setting(const std::string& name) {
  return name == "projection" || name == "falloffmodel" || name == "ambientmodel";
}

/// Takes the arguments that a "-- picture:" line gives to `crt render`, as the command does.
ScriptOptions options_from(std::istream& arguments, const std::string& line) {
  ScriptOptions options;
  std::string option;
  std::string value;
  while (arguments >> option) {
    if (option.rfind("--", 0) != 0 || !(arguments >> value)) {
      throw Error(ErrorCode::invalid_argument, "the tests cannot read the line '" + line + "'");
    }
    const std::string name = option.substr(2);
    if (name == "set") {
      const std::size_t equals = value.find('=');
      options.variables.emplace_back(value.substr(0, equals), value.substr(equals + 1));
    } else if (name == "time") {
      options.t = std::stod(value);
    } else {
      options.settings.emplace_back(name, is_text_setting(name) ? '"' + value + '"' : value);
    }
  }
  return options;
}

void add_pictures_of(const fs::path& script, std::vector<ExamplePicture>& pictures) {
  const std::string scene = script.stem().string();
  pictures.push_back({.name = scene, .script = script});

  const std::string mark = "-- picture: ";
  std::ifstream file(script);
  for (std::string line; std::getline(file, line) && line.rfind("--", 0) == 0;) {
    if (line.rfind(mark, 0) != 0) continue;
    std::istringstream words(line.substr(mark.size()));
    std::string name;
    words >> name;
    pictures.push_back(
        {.name = scene + "-" + name, .script = script, .options = options_from(words, line)});
  }
}

}  // namespace

fs::path examples_path() {
  return source_dir / "examples";
}

std::vector<ExamplePicture> example_pictures() {
  std::vector<ExamplePicture> pictures;
  for (const char* folder : {"scenes", "tutorial"}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(examples_path() / folder)) {
      if (entry.path().extension() == ".crt") add_pictures_of(entry.path(), pictures);
    }
  }
  std::sort(pictures.begin(), pictures.end(),
            [](const ExamplePicture& a, const ExamplePicture& b) { return a.name < b.name; });
  return pictures;
}

Scene small_scene(const ExamplePicture& picture) {
  constexpr int largest_width = 160;
  constexpr int max_dof_samples = 9;
  constexpr int least_samples = 4;  // of a picture with a target error
  constexpr int most_samples = 16;

  ScriptResult result = run_script_file(picture.script, picture.options);
  // The sample of the thesis has a parameter that it does not use.
  std::erase_if(result.diagnostics, [](const Diagnostic& diagnostic) {
    return diagnostic.message.starts_with("the parameter 'arg1' is never used");
  });
  if (!result.diagnostics.empty()) {
    std::string messages;
    for (const Diagnostic& diagnostic : result.diagnostics)
      messages += format_diagnostic(diagnostic);
    throw Error(ErrorCode::script, messages);
  }
  Scene scene = std::move(result.scene.value());
  Settings& settings = scene.settings;
  const int width = std::min(settings.width, largest_width);
  settings.height = std::max(1, settings.height * width / settings.width);
  settings.width = width;
  // A picture about supersampling needs it.
  const bool asked_for =
      std::any_of(picture.options.settings.begin(), picture.options.settings.end(),
                  [](const auto& setting) { return setting.first == "supersampling"; });
  if (!asked_for) settings.supersampling = 1;
  settings.dof_samples = std::min(settings.dof_samples, max_dof_samples);
  settings.min_samples = least_samples;
  settings.max_samples = most_samples;
  return scene;
}

std::string pixel_hash(const Image& image) {
  return core::sha256(std::as_bytes(image.pixels()));
}

fs::path reference_path(const ExamplePicture& picture) {
  return source_dir / "tests/images/references" / (picture.name + ".png");
}

fs::path hashes_path() {
  return source_dir / "tests/images/hashes.txt";
}

std::map<std::string, std::string> read_hashes() {
  std::map<std::string, std::string> hashes;
  std::ifstream file(hashes_path());
  std::string hash;
  std::string name;
  while (file >> hash >> name) hashes[name] = hash;
  return hashes;
}

}  // namespace crt::tests
