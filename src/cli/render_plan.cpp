#include "cli/render_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <crt/file.hpp>
#include <set>
#include <stdexcept>
#include <string>

#include "cli/files.hpp"
#include "cli/film.hpp"

namespace crt::cli {

namespace {

namespace fs = std::filesystem;

/// Is thrown where options do not go together.
class Senseless : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

bool is_folder(const fs::path& path) {
  std::error_code unreachable;
  return fs::is_directory(path, unreachable);
}

bool makes_film(const RenderRequest& request) {
  return request.film || is_film(request.output);
}

void refuse_senseless(const RenderRequest& request) {
  const bool several = request.scenes.size() > 1;
  const bool to_stream = request.output == standard_stream;
  const auto inputs = std::count(request.scenes.begin(), request.scenes.end(), standard_stream);
  const auto refuse_if = [](bool is_so, const std::string& why) {
    if (is_so) throw Senseless(why);
  };
  refuse_if(inputs > 1, "standard input is one script: name '-' once");
  refuse_if(inputs > 0 && (several || request.output.empty()),
            "a script from standard input has no name to call its picture by: name it with -o, "
            "and render it alone");
  refuse_if(several && !request.render.checkpoint.empty(),
            "--checkpoint is for one picture: render the scripts one by one");
  refuse_if(several && to_stream,
            "standard output takes one picture: render the scripts one by "
            "one");
  refuse_if(several && !request.output.empty() && !is_folder(request.output),
            fmt::format("several scripts need a folder for their pictures, but '{}' is none",
                        request.output.string()));
  refuse_if(to_stream && request.frames, "standard output takes one picture, not --frames");
  refuse_if(to_stream && request.film, "standard output takes one picture, not --film");
  refuse_if(to_stream && request.stats == standard_stream,
            "standard output takes the picture or the statistics: name a file for one of them");
  const bool film = makes_film(request);
  refuse_if(film && request.render.aovs != Aovs{}, "a film has colours alone, and no --aov");
  refuse_if(film && !request.render.checkpoint.empty(), "--checkpoint is for one picture");
  refuse_if(film && request.script.t != 0, "a film has a frame for each time, and no --time");
  refuse_if(
      !film && !request.keep_frames.empty(),
      fmt::format("--keep-frames is for films: name one with -o, ending in {}", film_endings()));
}

fs::path output_for(const fs::path& scene, const RenderRequest& request) {
  fs::path beside = scene;
  beside.replace_extension(request.film ? ".mp4" : usual_ending(request));
  if (request.output.empty()) return beside;
  const bool names_folder = request.scenes.size() > 1 || !request.output.has_filename();
  return names_folder && is_folder(request.output) ? request.output / beside.filename()
                                                   : request.output;
}

void check_files(const PlannedPicture& picture, const RenderRequest& request) {
  if (picture.output == standard_stream) return;
  std::error_code unlike;
  if (fs::equivalent(picture.script.file(), picture.output, unlike)) {
    throw Senseless(
        fmt::format("the picture would overwrite its script '{}': name another file with -o",
                    picture.script.file().string()));
  }
  if (picture.is_film) {
    check_film(picture.output);
  } else {
    check_picture(picture.output, request.render.aovs != Aovs{});
  }
}

std::vector<PlannedPicture> plan(const RenderRequest& request) {
  refuse_senseless(request);
  std::vector<PlannedPicture> pictures;
  std::set<fs::path> outputs;
  for (const fs::path& scene : request.scenes) {
    const fs::path output = output_for(scene, request);
    if (!outputs.insert(output.lexically_normal()).second) {
      throw Senseless(fmt::format("two scripts would have the picture '{}': render them one by one",
                                  output.string()));
    }
    if (request.film && !is_film(output)) {
      throw Senseless(fmt::format("--film makes a film, and '{}' is none: name one ending in {}",
                                  output.string(), film_endings()));
    }
    // Standard input is read last, when the rest of the command line is known to be right.
    pictures.push_back({.script = ScriptSource(scene == standard_stream ? fs::path() : scene),
                        .output = output,
                        .is_film = is_film(output)});
    check_files(pictures.back(), request);
  }
  if (!request.stats.empty() && request.stats != standard_stream) check_writable(request.stats);
  if (!request.render.checkpoint.empty()) check_writable(request.render.checkpoint);
  if (!request.keep_frames.empty()) fs::create_directories(request.keep_frames);
  if (request.scenes.front() == standard_stream)
    pictures.front().script = ScriptSource(standard_stream, request.script.limits);
  return pictures;
}

}  // namespace

const char* usual_ending(const PictureRequest& request) {
  return request.render.aovs == Aovs{} ? ".png" : ".exr";
}

std::optional<std::vector<PlannedPicture>> plan_pictures(const RenderRequest& request,
                                                         Reporter& reporter) {
  try {
    return plan(request);
  } catch (const Senseless& error) {
    reporter.add(ErrorCode::invalid_argument, error.what(), ExitCode::usage);
  } catch (const fs::filesystem_error& error) {
    reporter.add(ErrorCode::io,
                 fmt::format("cannot make the folder '{}': {}", error.path1().string(),
                             error.code().message()),
                 ExitCode::files);
  } catch (const Error& error) {
    const bool unknown_format = error.code() == ErrorCode::unsupported;
    reporter.add(error.code(), error.what(), unknown_format ? ExitCode::usage : ExitCode::files);
  }
  return std::nullopt;
}

}  // namespace crt::cli
