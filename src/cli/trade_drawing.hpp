// What the plots of `crt trade` are drawn with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace crt::cli {

/// A Place has x to the right and y down.
struct Place {
  double x = 0;
  double y = 0;
};

/// An Ink is a colour as SVG writes it.
using Ink = std::string_view;

inline constexpr Ink frame_ink = "#888888";
inline constexpr Ink grid_ink = "#dddddd";
inline constexpr Ink uncertain_ink = "#d68910";
inline constexpr Ink best_ink = "#1e1e1e";
inline constexpr Ink text_ink = "#1e1e1e";

/// A Drawing is the text of an SVG file.
class Drawing {
 public:
  /// Begins with a white area.
  Drawing(double width, double height);

  void line(const Place& from, const Place& to, Ink ink, double width = 1) {
    curve({from, to}, ink, width);
  }
  void curve(const std::vector<Place>& places, Ink ink, double width);
  void disc(const Place& center, double radius, Ink ink);
  void ring(const Place& center, double radius, Ink ink);
  /// Writes a text. `place` is on the line that it stands on, and at the text's `anchor`: "start",
  /// "middle" or "end".
  void text(const Place& place, const std::string& text, std::string_view anchor = "start",
            bool upwards = false);

  std::string svg() const { return svg_ + "</svg>\n"; }

 private:
  std::string svg_;
};

/// Decades are the powers of ten from `low` to `high`.
struct Decades {
  int low = 0;
  int high = 1;

  /// Returns 0 at the low end and 1 at the high one.
  double share(double value) const;
};

/// Returns the decades that hold all values. A value below `least`, which is too near 0 for a
/// logarithm, is at the low end.
Decades decades_of(const std::vector<double>& values, double least = 1e-4);

/// LogAxes are those of a plot whose axes are logarithmic. They have a frame in the drawing.
struct LogAxes {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;
  Decades across;
  Decades up;

  Place at(double x, double y) const {
    return {left + (right - left) * across.share(x), bottom - (bottom - top) * up.share(y)};
  }
  /// Draws lines at the decades, the frame, and what the axes are; `above` is that of the frame.
  /// The name of the axis upwards has its middle line at `name_x`.
  void draw(Drawing& drawing, const std::string& above, const std::string& name_across,
            const std::string& name_up, double name_x) const;
};

}  // namespace crt::cli
