#include <algorithm>
#include <cmath>

#include "farm/part.hpp"

namespace crt::farm {

namespace {

constexpr int max_side = 16384;

/// A SheetLayout has a cell for each frame, row by row.
struct SheetLayout {
  int cell_width = 1;
  int cell_height = 1;
  int columns = 1;
  int rows = 1;

  SheetLayout(const Manifest& manifest, int cell) {
    const auto [first, last] = frames_of(manifest);
    const int frames = last - first + 1;
    columns = static_cast<int>(std::ceil(std::sqrt(double{1} * frames)));
    rows = (frames + columns - 1) / columns;
    const int widest = std::max(1, std::min(cell, max_side / columns));
    const int longest = std::max(manifest.width, manifest.height);
    const double scale = std::min(1.0, double{1} * widest / longest);
    cell_width = std::max(1, static_cast<int>(scale * manifest.width));
    cell_height = std::max(1, static_cast<int>(scale * manifest.height));
  }
};

/// A Sheet adds up the pixels that fall on each of its own.
class Sheet {
 public:
  Sheet(const Manifest& manifest, const SheetLayout& layout)
      : manifest_(manifest),
        layout_(layout),
        image_(layout.columns * layout.cell_width, layout.rows * layout.cell_height),
        counts_(image_.pixels().size() / 4) {
    std::fill(image_.pixels().begin(), image_.pixels().end(), 0.0f);
  }

  void add(const RenderedPiece& rendered) {
    image_.set_settings(rendered.image.settings());
    const auto& [frame, region] = rendered.piece;
    const int index = frame - frames_of(manifest_).first;
    const int left = index % layout_.columns * layout_.cell_width;
    const int top = index / layout_.columns * layout_.cell_height;
    const float* pixel = rendered.image.pixels().data();
    for (int y = region.y; y < region.y + region.height; ++y) {
      const auto row = static_cast<int>(std::int64_t{y} * layout_.cell_height / manifest_.height);
      for (int x = region.x; x < region.x + region.width; ++x, pixel += 4) {
        const auto column =
            static_cast<int>(std::int64_t{x} * layout_.cell_width / manifest_.width);
        const std::size_t at =
            static_cast<std::size_t>(top + row) * static_cast<std::size_t>(image_.width()) +
            static_cast<std::size_t>(left + column);
        ++counts_[at];
        for (std::size_t c = 0; c < 4; ++c) image_.pixels()[4 * at + c] += pixel[c];
      }
    }
  }

  Image finish() {
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      if (counts_[i] == 0) continue;
      for (std::size_t c = 0; c < 4; ++c)
        image_.pixels()[4 * i + c] /= static_cast<float>(counts_[i]);
    }
    return std::move(image_);
  }

 private:
  const Manifest& manifest_;
  SheetLayout layout_;
  Image image_;
  std::vector<std::uint32_t> counts_;
};

}  // namespace

}  // namespace crt::farm

namespace crt {

Image farm_sheet(const std::filesystem::path& job, int cell) {
  if (cell < 1) {
    throw Error(ErrorCode::invalid_argument,
                "the cell of a frame on the sheet must be at least one pixel across", "cell");
  }
  const farm::Job opened = farm::open_job(job);
  farm::Sheet sheet(opened.manifest, {opened.manifest, cell});
  const auto tasks = static_cast<int>(opened.manifest.tasks.size());
  for (int task = 0; task < tasks; ++task) {
    if (!farm::has_part(opened, task)) continue;
    try {
      for (const farm::RenderedPiece& rendered : farm::read_part(opened, task)) sheet.add(rendered);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::io) throw;  // what merging would refuse is not there
    }
  }
  return sheet.finish();
}

}  // namespace crt
