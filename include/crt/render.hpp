#pragma once

#include <crt/image.hpp>
#include <crt/prepared_scene.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string_view>

namespace crt {

/// A Region is a rectangle of pixels, from the top left.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

/// Aovs say what a render reports of each pixel beside its colour ("arbitrary output variables"),
/// as Image::channels(). Distance, entity and part are those of one ray, through the middles of the
/// pixel and of the lens, and never a blend. Normal and albedo are means over the same samples as
/// the colour. All describe what camera rays meet first, be it glass or a mirror.
struct Aovs {
  /// "Z" is the distance along the ray from the camera (orthographic: from the image plane) to the
  /// first surface, in scene units. It is infinity where there is none.
  bool depth = false;
  /// "N.X", "N.Y", "N.Z" are the unit normal of shading in the world, turned to the viewer and
  /// tilted by bumps. Samples that meet nothing count as 0.
  bool normal = false;
  /// "id" has whole numbers: Entity::with_id, or else the entity's place in Scene::entities. It is
  /// no_entity_id where there is nothing.
  bool id = false;
  /// "part" has whole numbers: HitPart::part_id, the id that was given to the part of the entity.
  bool part = false;
  /// "albedo.R", "albedo.G", "albedo.B" are the material's colour in linear light, from its pattern
  /// if it has one. Samples that meet nothing count as 0.
  bool albedo = false;
  /// "samples" has whole numbers: how many samples the pixel has.
  bool samples = false;
  /// "error" is half of the width of the interval that holds the pixel's true value in 95 of 100
  /// cases, in what a display shows (1/255 is a step of 8 bits). It is known when the pixel is
  /// rendered up to a target error, a time budget or a number of passes. Else it is 1.
  bool error = false;

  bool operator==(const Aovs&) const = default;
};

/// Says how much a line of the log matters.
enum class LogLevel { info, warning };

/// Says what a render may be asked beyond the scene. The defaults render all of it on all cores.
struct RenderOptions {
  /// Renders only this part of the picture. The image has its size, and the pixels are those of the
  /// whole.
  std::optional<Region> region{};
  /// This is the number of threads at most. 0 takes what the calling TBB arena has, and 1 starts
  /// none.
  int threads = 0;
  /// Is called now and then, from one thread at a time, with the share done: first 0, never less
  /// than before, last 1. Returning false cancels, and render() then throws Error (cancelled).
  std::function<bool(double)> progress{};
  /// Replaces Settings::seed.
  std::optional<std::uint64_t> seed{};
  /// Above 0, renders so many passes (RenderStats::passes) and no more, whatever the time budget.
  /// If the settings have neither target error nor time budget, it renders as with a time budget.
  /// It must not be negative.
  int passes = 0;
  /// This is the file that keeps an unfinished picture which is rendered by passes. The next render
  /// with the same checkpoint continues from it, be it in another process, to the same picture as
  /// if there had been no break. The file is written (whole, or left as it was) within the first
  /// ten seconds, then every few seconds, and at the end, also when the render is cancelled or
  /// fails, at whatever time that is. It is never removed. If writing fails, `log` gets a message
  /// and the render continues. A time budget counts from the break on. Two things show that the
  /// file is of this picture: the settings that must stay (all but time budget and passes), and the
  /// light of up to 1024 samples. What changes none of them is not noticed.
  std::filesystem::path checkpoint{};
  /// This is the most things that a single ray may be tested against: objects, and primitives of
  /// CSG objects, whose boxes it passes. It is checked after every 1024 of them. A ray that takes
  /// more ends the render with Error (limit). 0 is 4194304, about a second's work; a ray through an
  /// ordinary scene takes some hundred.
  std::uint64_t max_ray_steps = 0;
  /// Says what the image gets beside the colours, which stay the same.
  Aovs aovs{};
  /// Shows a picture with a target error evenly while it is rendered (RenderJob::snapshot): passes
  /// go over all of it one by one, as they do with a time budget. Without it each tile gets many
  /// samples at once, which takes less time as a whole. The picture is the same.
  bool evenly = false;
  /// Keeps what a filter needs to know of each pixel, so that RenderJob::denoised() can be asked
  /// for without Settings::denoise. The picture is the same.
  bool denoisable = false;
  /// Gets the messages of the render, a line each without its end. The thread that calls render()
  /// calls it.
  std::function<void(LogLevel, std::string_view)> log{};
};

/// Renders the picture. The pixels depend on the scene alone, not on threads, tiles or regions.
/// Throws Error: cancelled, invalid_argument (a region outside the picture, a checkpoint of another
/// one), io (a checkpoint that cannot be read), limit (max_ray_steps), out_of_memory.
Image render(const PreparedScene& scene, const RenderOptions& options = {});

}  // namespace crt
