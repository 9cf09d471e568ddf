#pragma once

#include <crt/image.hpp>
#include <crt/prepared_scene.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace crt {

/// A rectangle of pixels, from the top left.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// What a render may tell of each pixel beside its colour ("arbitrary output variables"), as
/// Image::channels(). Distance and entity are those of one ray, through the middles of the pixel
/// and of the lens, and never a blend; normal and albedo are means over the same samples as the
/// colour. What is told is what camera rays meet first, be it glass or a mirror.
struct Aovs {
  /// "Z": the way along the ray from the eye (orthographic: from the image plane) to the first
  /// surface, in the scene's units; infinity where there is none.
  bool depth = false;
  /// "N.X", "N.Y", "N.Z": the unit normal in the world, turned to the viewer and tilted by bumps;
  /// samples that meet nothing count as 0.
  bool normal = false;
  /// "id", whole numbers: Entity::with_id, or else the entity's place in Scene::entities;
  /// no_entity_id where there is nothing.
  bool id = false;
  /// "albedo.R", "albedo.G", "albedo.B": the material's colour in linear light, from its pattern if
  /// it has one; samples that meet nothing count as 0.
  bool albedo = false;
  /// "samples", whole numbers: how many samples the pixel has.
  bool samples = false;
  /// "error": half of the width of the interval that holds the pixel's true value in 95 of 100
  /// cases, in what a display shows (1/255 is a step of 8 bits), when it is rendered up to a target
  /// error, a time budget or a number of passes; else 1, as nothing is known.
  bool error = false;

  bool operator==(const Aovs&) const = default;
};

/// What the channel "id" has where nothing is.
inline constexpr std::uint32_t no_entity_id = 0xffffffff;

enum class LogLevel { info, warning };

/// What a render may be asked beyond the scene; the defaults render all of it on all cores.
struct RenderOptions {
  /// Renders only this part of the picture: the image has its size. The pixels are those of the
  /// whole.
  std::optional<Region> region{};
  /// Threads at most; 0 takes what the calling TBB arena has, 1 starts none.
  int threads = 0;
  /// Called now and then, from one thread at a time, with the share done: first 0, never less than
  /// before, last 1. Returning false cancels: render() then throws Error (cancelled).
  std::function<bool(double)> progress{};
  /// Takes the place of Settings::seed.
  std::optional<std::uint64_t> seed{};
  /// Above 0: renders so many passes (RenderStats::passes) and no more, whatever the time budget;
  /// with neither target error nor time budget in the settings as with a time budget. Not negative.
  int passes = 0;
  /// Of a picture that is rendered by passes: the file that keeps what is there of it, from which
  /// the next render with the same checkpoint goes on, be it in another process, to the same
  /// picture as if there had been no break. Written (whole, or left as it was) within the first ten
  /// seconds, then every few seconds, and at the end, also when the render is cancelled or fails,
  /// at whatever time that is; never removed. If writing fails `log` is told, and the render goes
  /// on. A time budget counts from the break on. That the file is of this picture is told by the
  /// settings that must stay (all but time budget and passes) and by the light of up to 1024
  /// samples: what changes none of them is not noticed.
  std::filesystem::path checkpoint{};
  /// The most things that a single ray may be tested against: objects, and primitives of CSG
  /// objects, whose boxes it passes. It is looked at after every 1024 of them; a ray that takes
  /// more ends the render with Error (limit). 0 is 4194304, about a second's work; a ray through an
  /// ordinary scene takes some hundred.
  std::uint64_t max_ray_steps = 0;
  /// What the image gets beside the colours, which stay the same.
  Aovs aovs{};
  /// Gets what there is to tell of the render, a line each without its end. From the thread that
  /// calls render().
  std::function<void(LogLevel, std::string_view)> log{};
};

/// Renders the picture. The pixels depend on the scene alone: not on threads, tiles or regions.
/// Throws Error: cancelled, invalid_argument (a region outside the picture, a checkpoint of another
/// one), io (a checkpoint that cannot be read), limit (max_ray_steps), out_of_memory.
Image render(const PreparedScene& scene, const RenderOptions& options = {});

}  // namespace crt
