#include "farm/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "core/render/accuracy.hpp"
#include "core/render/tiles.hpp"
#include "text/format.hpp"

namespace crt::farm {

namespace {

[[noreturn]] void fail(const Piece& piece) {
  throw Error(ErrorCode::io,
              text::format("pieces of frame {} do not belong together", piece.frame));
}

/// Calls copy(place in the picture, place in the piece, count) for each row of the piece.
template <class Copy>
void for_each_row(const Region& piece, const Region& picture, const Copy& copy) {
  const auto width = static_cast<std::size_t>(piece.width);
  for (int y = 0; y < piece.height; ++y) {
    copy(core::index_in(picture, piece.x, piece.y + y), static_cast<std::size_t>(y) * width, width);
  }
}

}  // namespace

void Assembly::begin(const RenderedPiece& first) {
  std::fill(image_.pixels().begin(), image_.pixels().end(), 0.0f);
  image_.set_settings(first.image.settings());
  image_.stats() = first.image.stats();
  for (const auto count : summed_counts) image_.stats().*count = 0;
  image_.stats().passes = 0;
  image_.stats().cutoff_max = 0;
  brightest_ = first.brightest;
  for (const ImageChannel& channel : first.image.channels()) {
    ImageChannel& added = channels_.emplace_back(channel);
    std::visit([&](auto& values) { values.assign(covered_.size(), {}); }, added.values);
  }
}

void Assembly::add_channels(const RenderedPiece& rendered) {
  const std::vector<ImageChannel>& given = rendered.image.channels();
  const Region picture{0, 0, image_.width(), image_.height()};
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    std::visit(
        [&](auto& values) {
          using Values = std::remove_reference_t<decltype(values)>;
          const Values& from = std::get<Values>(given[i].values);
          for_each_row(rendered.piece.region, picture,
                       [&](std::size_t to, std::size_t at, std::size_t count) {
                         std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(at), count,
                                     values.begin() + static_cast<std::ptrdiff_t>(to));
                       });
        },
        channels_[i].values);
  }
}

void Assembly::add(const RenderedPiece& rendered) {
  if (pixels_ == 0) begin(rendered);
  const std::vector<ImageChannel>& given = rendered.image.channels();
  const bool fits = std::equal(given.begin(), given.end(), channels_.begin(), channels_.end(),
                               [](const ImageChannel& a, const ImageChannel& b) {
                                 return a.name == b.name && a.values.index() == b.values.index();
                               });
  if (!fits || rendered.brightest != brightest_) fail(rendered.piece);
  const Region picture{0, 0, image_.width(), image_.height()};
  for_each_row(
      rendered.piece.region, picture, [&](std::size_t to, std::size_t at, std::size_t count) {
        for (std::size_t i = to; i < to + count; ++i) {
          if (covered_[i]) fail(rendered.piece);
          covered_[i] = true;
        }
        std::copy_n(rendered.image.pixels().begin() + static_cast<std::ptrdiff_t>(4 * at),
                    4 * count, image_.pixels().begin() + static_cast<std::ptrdiff_t>(4 * to));
        pixels_ += count;
      });
  add_channels(rendered);
  const RenderStats& part = rendered.image.stats();
  RenderStats& stats = image_.stats();
  for (const auto count : summed_counts) stats.*count += part.*count;
  stats.passes = std::max(stats.passes, part.passes);
  stats.cutoff_max = std::max(stats.cutoff_max, part.cutoff_max);
  cutoff_units_ += rendered.cutoff_units;
}

Image Assembly::finish() {
  image_.set_channels(std::move(channels_));
  RenderStats& stats = image_.stats();
  if (stats.passes > 0) {
    const std::span<const float> errors = image_.channel("error");
    const std::span<const std::uint32_t> samples = image_.integer_channel("samples");
    const bool are_numbers =
        std::none_of(errors.begin(), errors.end(), [](float error) { return std::isnan(error); });
    if (errors.empty() || samples.empty() || !are_numbers)
      throw Error(ErrorCode::io, "the parts do not say how near to the truth they are");
    core::report_measures({.samples = {samples.begin(), samples.end()},
                           .half_widths = {errors.begin(), errors.end()},
                           .first_hits = {}},
                          stats);
  }
  if (stats.pixels > 0)
    stats.cutoff_mean = core::cutoff_mean(cutoff_units_, brightest_, stats.pixels);
  std::vector<ImageChannel> kept = image_.channels();
  std::erase_if(kept, [&](const ImageChannel& channel) {
    return (channel.name == "samples" && !manifest_.aovs.samples) ||
           (channel.name == "error" && !manifest_.aovs.error);
  });
  image_.set_channels(std::move(kept));
  return std::move(image_);
}

}  // namespace crt::farm
