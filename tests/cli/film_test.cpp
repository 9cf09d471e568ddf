// These tests check films: how ffmpeg is run, and what it makes, as OpenImageIO's tool reads it.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/scenes.hpp"

using namespace crt::test;

namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

bool contains(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

bool has_ffmpeg() {
  return std::system("command -v ffmpeg >/dev/null") == 0;  // NOLINT(cert-env33-c)
}

/// This ball moves and has a flat background, so that frames differ and colours are many.
const std::string film_script = R"(Settings {
  width -> 60
  height -> 44
  camera -> Camera { position -> vec3(0, 0, -4) pointing -> vec3(0, 0, 0) }
  lights -> [PointLight { origin -> vec3(3, 5, -4) color -> rgb(1, 1, 1) ambient -> 0.1 }]
}
Scene {
  Sphere {
    center -> vec3(0.2 * t, 0, 0)
    radius -> 1
    material -> Material { color -> rgb(0.9, 0.4, 0.1) }
  }
}
)";

struct Fixture {
  TemporaryFolder folder;
  Fixture() { folder.write("ball.crt", film_script); }

  /// Puts a program that is called ffmpeg into a folder, and returns the environment that has it.
  std::vector<std::string> with_ffmpeg(const std::string& script) const {
    folder.write("bin/ffmpeg", "#!/bin/sh\n" + script);
    fs::permissions(folder.path() / "bin/ffmpeg", fs::perms::owner_all);
    return {"PATH=" + (folder.path() / "bin").string() + ":/usr/bin:/bin"};
  }

  /// Makes a film of three frames by a program that writes its words and the number of bytes that
  /// it gets. Returns what it writes.
  std::string film_by_words(const std::string& file, const std::string& rate) const {
    const auto environment =
        with_ffmpeg("for last; do true; done\n{ echo \"$@\"; wc -c; } >\"$last\"\n");
    const Outcome run =
        run_crt_in({.environment = environment}, folder,
                   {"render", "ball.crt", "--frames", "1-3", "-o", file, "--fps", rate});
    CHECK_MESSAGE(run.exit_code == 0, run.err);
    return folder.read(file);
  }
};

}  // namespace

TEST_CASE_FIXTURE(Fixture, "a .gif has all frames, for their time, and each is its picture" *
                               doctest::skip(!has_ffmpeg())) {
  const Outcome run = run_crt(folder, {"render", "ball.crt", "--frames", "1-3", "-o", "film.gif",
                                       "--fps", "10", "--keep-frames", "frames"});
  CHECK_MESSAGE(run.exit_code == 0, run.err);
  CHECK(folder.names() == Names{"ball.crt", "film.gif", "frames"});
  const std::string info = shell(folder, "oiiotool --info -v film.gif");
  CHECK(contains(info, "3 subimages"));
  CHECK(contains(info, "60 x   44"));
  CHECK(contains(info, "FramesPerSecond: 100/10 (10)"));
  for (const char* frame : {"1", "2", "3"}) {
    const std::string kept = std::string("frames/film_000") + frame + ".png";
    REQUIRE(folder.has(kept));
    const std::string compared =
        shell(folder, "oiiotool film.gif --subimage " + std::to_string(frame[0] - '1') +
                          " --ch R,G,B " + kept + " --fail 0.02 --hardfail 0.1 --diff");
    CHECK_MESSAGE(contains(compared, "PASS"), compared);
  }
  const std::string others =
      shell(folder,
            "oiiotool film.gif --subimage 0 --ch R,G,B frames/film_0003.png --fail 0.02 "
            "--hardfail 0.1 --diff || true");
  CHECK_MESSAGE(contains(others, "FAILURE"), others);
}

TEST_CASE_FIXTURE(Fixture, "frames of several sizes are no film") {
  folder.write("grows.crt", "Settings { width -> t < 0.5 ? 8 : 9 height -> 8 }\nScene { }\n");
  const Outcome run = run_crt_in({.environment = with_ffmpeg("cat >/dev/null\n")}, folder,
                                 {"render", "grows.crt", "--frames", "0-2", "-o", "film.gif"});
  CHECK(run.exit_code == 1);
  CHECK(contains(run.err, "frame 1 has 9 x 8 pixels, and the first 8 x 8"));
  CHECK_FALSE(folder.has("film.gif"));
}

TEST_CASE_FIXTURE(Fixture, "without ffmpeg a film is an error before anything is rendered") {
  for (const char* film : {"film.mp4", "film.webp", "film.gif"}) {
    const Outcome run = run_crt_in({.environment = {"PATH=" + folder.path().string()}}, folder,
                                   {"render", "ball.crt", "--frames", "1-3", "-o", film});
    CHECK(run.exit_code == 3);
    CHECK(contains(run.err, "ffmpeg, which is not installed; without it, -o film.png writes"));
    CHECK_FALSE(contains(run.err, "%"));
    CHECK(folder.names() == Names{"ball.crt"});
  }
}

TEST_CASE_FIXTURE(Fixture,
                  "ffmpeg gets the frames' size, rate and bytes, and its file is the film") {
  const std::string film = film_by_words("film.mp4", "12.5");
  CHECK(contains(film, "-video_size 60x44"));
  CHECK(contains(film, "-framerate 12.5"));
  CHECK(contains(film, std::to_string(3 * 60 * 44 * 3) + "\n"));
  CHECK(folder.names() == Names{"ball.crt", "bin", "film.mp4"});
}

TEST_CASE_FIXTURE(Fixture, "a film has the frames that the script says, if no others are named") {
  const auto environment =
      with_ffmpeg("for last; do true; done\n{ echo \"$@\"; wc -c; } >\"$last\"\n");
  std::string script = film_script;
  script.insert(script.find("width"), "frames -> 2 * 2\n  ");
  folder.write("film.crt", script);
  const auto bytes_of = [&](const std::vector<std::string>& options, const std::string& file) {
    std::vector<std::string> command = {"render", "film.crt"};
    command.insert(command.end(), options.begin(), options.end());
    const Outcome run = run_crt_in({.environment = environment}, folder, command);
    CHECK_MESSAGE(run.exit_code == 0, run.err);
    const std::string written = folder.read(file);
    return std::stoi(written.substr(written.find('\n') + 1));
  };
  constexpr int bytes_of_frame = 60 * 44 * 3;
  CHECK(bytes_of({"--film"}, "film.mp4") == 4 * bytes_of_frame);
  CHECK(bytes_of({"-o", "other.gif"}, "other.gif") == 4 * bytes_of_frame);
  CHECK(bytes_of({"--film", "--frames", "1-2"}, "film.mp4") == 2 * bytes_of_frame);

  const Outcome run =
      run_crt_in({.environment = environment}, folder, {"render", "ball.crt", "-o", "film.webp"});
  CHECK(run.exit_code == 2);
  CHECK(contains(run.err,
                 "'film.webp' is a film: say of which frames, by frames -> 48 in the "
                 "Settings of 'ball.crt', or such as --frames 1-48"));
  CHECK_FALSE(folder.has("film.webp"));
}

TEST_CASE_FIXTURE(Fixture, "a .gif shows its frames again and again, 50 a second at most") {
  const std::string film = film_by_words("film.GIF", "60");
  CHECK(contains(film, "-framerate 50 "));
  CHECK(contains(film, "-loop 0"));
  CHECK(contains(film, "palettegen"));
}

TEST_CASE_FIXTURE(Fixture, "an ffmpeg that fails leaves the old film and nothing else") {
  for (const char* script :
       {"cat >/dev/null; exit 1\n", "exit 1\n", "echo x >\"$last\"; exit 1\n"}) {
    folder.write("film.webp", "old");
    const Outcome run =
        run_crt_in({.environment = with_ffmpeg(std::string("for last; do true; done\n") + script)},
                   folder, {"render", "ball.crt", "--frames", "1-3", "-o", "film.webp"});
    CHECK(run.exit_code == 3);
    CHECK(contains(run.err, "cannot write 'film.webp': ffmpeg"));
    CHECK(folder.read("film.webp") == "old");
    CHECK(folder.names() == Names{"ball.crt", "bin", "film.webp"});
  }
}
